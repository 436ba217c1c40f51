// The queue of triangles that violate shape goals.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "tin/triangulation.h"

namespace scarp::shape {

/// A fault. Order: too large triangles before too sharp ones, then larger excess before smaller, then shorter edges
/// before longer.
struct ShapeFault {
  bool is_long = false;
  double key = 0;  ///< larger first
  tin::Triangle triangle = 0;
  std::array<tin::Vertex, 3> corners{};

  friend bool operator<(const ShapeFault& a, const ShapeFault& b) {
    if (a.is_long != b.is_long) return b.is_long;
    return a.key != b.key ? a.key < b.key : a.triangle > b.triangle;
  }
};

/// A priority queue of faults. A triangle is added again when sizes fall.
class ShapeFaults {
 public:
  bool empty() const { return heap_.empty(); }
  std::size_t size() const { return heap_.size(); }

  void push(const ShapeFault& fault) {
    heap_.push_back(fault);
    std::push_heap(heap_.begin(), heap_.end());
  }

  ShapeFault pop() {
    std::pop_heap(heap_.begin(), heap_.end());
    const ShapeFault first = heap_.back();
    heap_.pop_back();
    return first;
  }

  /// Removes all but the first current fault of each triangle.
  template <class Current>
  void clean(Current&& is_current) {
    heap_.erase(std::remove_if(heap_.begin(), heap_.end(), [&](const ShapeFault& fault) { return !is_current(fault); }),
                heap_.end());
    std::sort(heap_.begin(), heap_.end(), [](const ShapeFault& a, const ShapeFault& b) {
      return a.triangle != b.triangle ? a.triangle < b.triangle : b < a;
    });
    const auto is_same = [](const ShapeFault& a, const ShapeFault& b) { return a.triangle == b.triangle; };
    heap_.erase(std::unique(heap_.begin(), heap_.end(), is_same), heap_.end());
    std::make_heap(heap_.begin(), heap_.end());
  }

 private:
  std::vector<ShapeFault> heap_;
};

/// Triangles to process later, each once or a few times.
class WaitingTriangles {
 public:
  void push(tin::Triangle t) {
    triangles_.push_back(t);
    if (triangles_.size() <= 2 * distinct_ + kFew) return;
    std::sort(triangles_.begin(), triangles_.end());
    triangles_.erase(std::unique(triangles_.begin(), triangles_.end()), triangles_.end());
    distinct_ = triangles_.size();
  }
  std::vector<tin::Triangle> take() { return std::exchange(triangles_, {}); }

 private:
  static constexpr std::size_t kFew = 1024;
  std::vector<tin::Triangle> triangles_;
  std::size_t distinct_ = 0;
};

}  // namespace scarp::shape
