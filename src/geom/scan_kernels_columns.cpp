#include "geom/scan_kernels_columns.h"

namespace scarp::geom::detail {

namespace {

std::array<Point, 3> points_of(const std::array<TilePoint, 3>& corners) {
  return {point_of(corners[0]), point_of(corners[1]), point_of(corners[2])};
}

constexpr std::size_t next(std::size_t i) { return i == 2 ? 0 : i + 1; }

}  // namespace

BlockColumns::BlockColumns(const ScanTask& task, const std::array<TilePoint, 3>& corners)
    : task_(task), corners_(points_of(corners)) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Point from = corners_[i], to = corners_[next(i)];
    slant_[i] = from.y == to.y ? 0 : static_cast<double>(to.x - from.x) / (to.y - from.y);
  }
}

Span BlockColumns::of(std::int32_t block_row) const {
  const std::int32_t top = std::max(task_.top, block_row * kBlock);
  const std::int32_t bottom = std::min(task_.bottom, block_row * kBlock + kBlock - 1);
  double left = task_.right, right = task_.left;
  for (std::size_t i = 0; i < 3; ++i) {
    const Point from = corners_[i], to = corners_[next(i)];
    const std::int32_t low = std::max(top, std::min(from.y, to.y)), high = std::min(bottom, std::max(from.y, to.y));
    if (low > high) continue;
    const double x_low = from.x + slant_[i] * (low - from.y), x_high = from.x + slant_[i] * (high - from.y);
    left = std::min({left, x_low, x_high});
    right = std::max({right, x_low, x_high});
    if (from.y == to.y) {
      left = std::min(left, static_cast<double>(to.x));
      right = std::max(right, static_cast<double>(to.x));
    }
  }
  // One more sample on each side covers the rounding.
  return {std::max(task_.left, static_cast<std::int32_t>(left) - 1) / kBlock,
          std::min(task_.right, static_cast<std::int32_t>(right) + 1) / kBlock};
}

}  // namespace scarp::geom::detail
