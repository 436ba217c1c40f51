#include "refine/tile_order.h"

#include <algorithm>
#include <cmath>

namespace scarp::refine {

namespace {

// Measured on 45 rasters with 0.4 to 12 % of the samples as vertices (bench/performance.md, "Order").
constexpr double kRough = 1.75;       // growth of bends below which only areas decide the order
constexpr double kModerate = 2;       // growth below which square roots of areas decide
constexpr double kDense = 0.13;       // vertices per sample; beyond it, triangles have few samples and varied errors
constexpr double kFewVertices = 500;  // in a tile: too few to gain anything

constexpr std::int32_t kLooks = 48;  // per side

/// The growth of bends from `distance` to twice that; infinite if unknown.
double growth_of_bends(const geom::TileView& tile, std::int32_t distance) {
  const std::int32_t far = 2 * distance;
  const std::int32_t cols = tile.cols - 2 * far, rows = tile.rows - 2 * far;
  if (std::min(cols, rows) < 1) return HUGE_VAL;
  const std::int32_t across = (cols + kLooks - 1) / kLooks, down = (rows + kLooks - 1) / kLooks;
  double near_bends = 0, far_bends = 0;
  for (std::int32_t y = far; y < far + rows; y += down) {
    for (std::int32_t x = far; x < far + cols; x += across) {
      const float* at = tile.row(y) + x;
      const auto bend = [at](std::ptrdiff_t step) { return std::abs(double{at[-step]} + at[step] - 2.0 * at[0]); };
      const double nearer = bend(distance) + bend(distance * tile.stride);
      const double farther = bend(far) + bend(far * tile.stride);
      if (std::isnan(nearer) || std::isnan(farther)) continue;  // nodata
      near_bends += nearer;
      far_bends += farther;
    }
  }
  return near_bends > 0 ? far_bends / near_bends : HUGE_VAL;
}

}  // namespace

TileOrder choose_order(const geom::TileView& tile, double density) {
  if (density >= kDense || density * tile.cols * tile.rows < kFewVertices) return TileOrder::kDominant;
  const double growth = growth_of_bends(tile, std::max(1, static_cast<std::int32_t>(1 / std::sqrt(density) + 0.5)));
  if (growth < kRough) return TileOrder::kLazyOne;
  return growth < kModerate ? TileOrder::kLazyHalf : TileOrder::kDominant;
}

}  // namespace scarp::refine
