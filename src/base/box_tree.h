// A search tree for intersecting boxes, packed in the order of a space-filling curve (Kamel and Faloutsos 1993, with
// Morton's curve instead of Hilbert's). Neither clusters nor boxes of very different lengths add cost.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace scarp {

/// Lattice points from (x0, y0) to (x1, y1), both included.
struct Box {
  std::int32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

inline bool overlaps(const Box& a, const Box& b) {
  return a.x0 <= b.x1 && b.x0 <= a.x1 && a.y0 <= b.y1 && b.y0 <= a.y1;
}

inline Box hull_of(const Box& a, const Box& b) {
  return {a.x0 < b.x0 ? a.x0 : b.x0, a.y0 < b.y0 ? a.y0 : b.y0, a.x1 > b.x1 ? a.x1 : b.x1, a.y1 > b.y1 ? a.y1 : b.y1};
}

class BoxTree {
 public:
  /// REQUIRES: coordinates in [0, kMaxCoordinate]. Cost: O(n log n).
  explicit BoxTree(std::span<const Box> boxes);

  /// The boxes in the tree's order, in which neighbours are near each other. order()[k] is an index into the given
  /// boxes.
  std::span<const std::uint32_t> order() const { return order_; }
  const Box& box_at(std::size_t place) const { return levels_[0][place]; }

  /// Size of the groups of neighbours in order(); the last group may be smaller. A box near one member is near the
  /// whole group.
  static constexpr std::size_t kGroup = 8;
  std::size_t group_count() const { return (order_.size() + kGroup - 1) / kGroup; }
  const Box& hull_of_group(std::size_t group) const { return levels_[1][group]; }

  /// Collects the positions in the tree's order, from `first` on, of the boxes that overlap `box`. Returns false if
  /// there are more than `most`.
  bool gather(const Box& box, std::size_t first, std::size_t most, std::vector<std::size_t>& places) const;

  /// Calls visit(index) for each box for which `meets` returns true, from `first` on in the tree's order. REQUIRES: if
  /// meets() is true for a box, it is true for each box that contains this box.
  template <class Meets, class Visit>
  void visit(Meets&& meets, Visit&& visit, std::size_t first = 0) const {
    visit_places(
        meets, [&](std::size_t place) { visit(order_[place]); }, first);
  }

 private:
  static constexpr std::size_t kFanBits = 3, kFan = std::size_t{1} << kFanBits;
  static constexpr std::size_t kMostPending = kFan * (64 / kFanBits);
  static_assert(kFan == kGroup);

  template <class Meets, class Visit>
  void visit_places(const Meets& meets, const Visit& visit, std::size_t first) const {
    struct Node {
      std::size_t level, place;
    };
    std::array<Node, kMostPending> pending;
    std::size_t count = 0;
    if (!order_.empty()) pending[count++] = {levels_.size() - 1, 0};
    while (count > 0) {
      const Node node = pending[--count];
      const std::size_t level = node.level - 1;
      const std::vector<Box>& boxes = levels_[level];
      const std::size_t end = node.place * kFan + kFan < boxes.size() ? node.place * kFan + kFan : boxes.size();
      for (std::size_t k = node.place * kFan; k < end; ++k) {
        if (((k + 1) << (kFanBits * level)) <= first || !meets(boxes[k])) continue;
        if (level == 0) {
          visit(k);
        } else {
          pending[count++] = {level, k};
        }
      }
    }
  }

  std::vector<std::uint32_t> order_;
  std::vector<std::vector<Box>> levels_;  ///< level 0: the boxes; each next level: hulls of kFan boxes each; the last
                                          ///< is one box
};

}  // namespace scarp
