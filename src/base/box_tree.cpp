#include "base/box_tree.h"

#include <algorithm>
#include <utility>

#include "base/curve.h"
#include "base/radix_sort.h"

namespace scarp {
namespace {

/// The position of a box's centre on the curve.
std::uint64_t curve_place_of(const Box& box) {
  const auto twice = [](std::int32_t a, std::int32_t b) { return static_cast<std::uint64_t>(std::int64_t{a} + b); };
  return curve_place(twice(box.x0, box.x1), twice(box.y0, box.y1));
}

}  // namespace

BoxTree::BoxTree(std::span<const Box> boxes) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(boxes.size());
  for (std::uint32_t k = 0; k < keys.size(); ++k) keys[k] = {curve_place_of(boxes[k]), k};
  radix_sort(keys, [](const auto& key) { return key.first; });
  order_.reserve(keys.size());
  levels_.emplace_back().reserve(keys.size());
  for (const auto& [place, index] : keys) {
    order_.push_back(index);
    levels_[0].push_back(boxes[index]);
  }
  if (boxes.empty()) return;
  do {
    const std::vector<Box>& below = levels_.back();
    std::vector<Box> level((below.size() + kFan - 1) / kFan);
    for (std::size_t k = 0; k < below.size(); ++k)
      level[k / kFan] = k % kFan == 0 ? below[k] : hull_of(level[k / kFan], below[k]);
    levels_.push_back(std::move(level));
  } while (levels_.back().size() > 1);
}

bool BoxTree::gather(const Box& box, std::size_t first, std::size_t most, std::vector<std::size_t>& places) const {
  places.clear();
  visit_places([&](const Box& other) { return places.size() <= most && overlaps(box, other); },
               [&](std::size_t place) { places.push_back(place); }, first);
  return places.size() <= most;
}

}  // namespace scarp
