// First-touch copies: the earlier elements of an array, stored while a transaction can still be undone.
//
// Repair changes a few dozen triangles and often gives up, so a copy of the whole array would cost more than the work.
// Each element is copied once, before its first change; an undo restores the copies. Elements are neither added nor
// deleted within a transaction: removed ones are marked, and their places are not reused before the patch is packed.
// Outside transactions the cost is one comparison per change.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace scarp::fit {

template <class T>
class Journal {
 public:
  struct Copy {
    std::uint32_t index;
    T before;
  };

  void begin(std::size_t count) {
    stamps_.resize(count, 0);
    copies_.clear();
    is_open_ = true;
    ++now_;
  }
  /// Call it before every change of items[index].
  void touch(const std::vector<T>& items, std::uint32_t index) {
    if (!is_open_ || stamps_[index] == now_) return;
    stamps_[index] = now_;
    copies_.push_back({index, items[index]});
  }
  /// The copies since begin(), in the order of the first touches.
  std::span<const Copy> copies() const { return copies_; }
  void commit() { is_open_ = false; }
  void roll_back(std::vector<T>& items) {
    for (const Copy& copy : copies_) items[copy.index] = copy.before;
    is_open_ = false;
  }

 private:
  std::vector<std::uint32_t> stamps_;  // by element, the transaction that last touched it
  std::vector<Copy> copies_;
  std::uint32_t now_ = 0;
  bool is_open_ = false;
};

}  // namespace scarp::fit
