// The queue of vertices to try, the cheapest first. Prices are updated only at the front.
//
// A change makes the prices around it stale. A queued item stays at the position of its old price, and gets a new price
// at the front. A refused item waits outside the queue until the queue is empty, when most changes around it have
// happened. Equal prices are ordered by item, so the order depends on the prices only.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace scarp::fit {

class LazyQueue {
 public:
  using Item = std::uint32_t;

  explicit LazyQueue(std::size_t items) : states_(items) {}

  bool empty() const { return heap_.empty(); }
  bool is_stale(Item item) const { return states_[item].is_stale; }

  void push(Item item, float price) {
    states_[item].is_held = true;
    heap_.push_back({price, item});
    std::push_heap(heap_.begin(), heap_.end(), is_later);
  }
  Item pop() {
    std::pop_heap(heap_.begin(), heap_.end(), is_later);
    const Item item = heap_.back().item;
    heap_.pop_back();
    states_[item].is_held = false;
    return item;
  }
  /// True if the item at this price would precede all queued items.
  bool is_first(Item item, float price) const { return heap_.empty() || !is_later({price, item}, heap_.front()); }

  void refresh(Item item) { states_[item].is_stale = false; }
  /// Call it when something around the item has changed.
  void touch(Item item) {
    states_[item].is_stale = true;
    if (states_[item].is_held) return;
    states_[item].is_held = true;
    waiting_.push_back(item);
  }
  /// Visits the waiting items and clears their list.
  template <class Visit>
  void each_waiting(const Visit& visit) {
    std::swap(waiting_, asked_);
    for (const Item item : asked_) {
      states_[item].is_held = false;
      visit(item);
    }
    asked_.clear();
  }

 private:
  struct Entry {
    float price;
    Item item;
  };
  struct State {
    bool is_held = false;  // queued or waiting
    bool is_stale = false;
  };

  /// The order that heaps expect.
  static bool is_later(const Entry& a, const Entry& b) {
    return a.price != b.price ? a.price > b.price : a.item > b.item;
  }

  std::vector<State> states_;
  std::vector<Entry> heap_;
  std::vector<Item> waiting_, asked_;
};

}  // namespace scarp::fit
