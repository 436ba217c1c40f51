#include "geom/box_tree.h"

#include <algorithm>
#include <utility>

namespace scarp {
namespace {

/// A zero before each of the 32 bits.
std::uint64_t spread(std::uint64_t bits) {
  bits = (bits | bits << 16) & 0x0000ffff0000ffff;
  bits = (bits | bits << 8) & 0x00ff00ff00ff00ff;
  bits = (bits | bits << 4) & 0x0f0f0f0f0f0f0f0f;
  bits = (bits | bits << 2) & 0x3333333333333333;
  return (bits | bits << 1) & 0x5555555555555555;
}

/// The place of the box' middle on Morton's curve.
std::uint64_t curve_place(const Box& box) {
  const auto twice = [](std::int32_t a, std::int32_t b) { return static_cast<std::uint64_t>(std::int64_t{a} + b); };
  return spread(twice(box.x0, box.x1)) | spread(twice(box.y0, box.y1)) << 1;
}

Box hull(const Box& a, const Box& b) {
  return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

}  // namespace

BoxTree::BoxTree(std::span<const Box> boxes) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(boxes.size());
  for (std::uint32_t k = 0; k < keys.size(); ++k) keys[k] = {curve_place(boxes[k]), k};
  std::sort(keys.begin(), keys.end());
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
      level[k / kFan] = k % kFan == 0 ? below[k] : hull(level[k / kFan], below[k]);
    levels_.push_back(std::move(level));
  } while (levels_.back().size() > 1);
}

}  // namespace scarp
