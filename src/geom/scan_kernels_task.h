// One triangle for all scan kernels: plane, box, edge functions. Private to the scan kernels.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "geom/scan_kernels.h"

namespace scarp::geom::detail {

/// The farthest sample so far; it is a hit if its error is above the floor.
struct ScanBest {
  float error = 0;
  TilePoint at = 0;

  /// Among equal errors the first in raster order wins; NaN never wins. The floor has no point, so it wins over an
  /// equal error.
  void offer(float e, TilePoint p) {
    if (e > error || (e == error && p < at)) *this = {e, p};
  }
};

struct ScanTask {
  ScanPlane plane;
  float floor = 0;
  Point base;                                    ///< origin of the plane
  std::int32_t left, right, top, bottom;         ///< box, inclusive
  std::array<std::int32_t, 3> along_x, along_y;  ///< edge functions: steps in x and in y; at most 2¹² each
  std::array<std::int32_t, 3> at_corner;         ///< their values at (left, top), below 2²⁵; negative is outside

  [[gnu::always_inline]] ScanTask(const TileView& tile, const std::array<TilePoint, 3>& corners, double threshold)
      : plane(ScanPlane::through(tile, corners, threshold)),
        floor(scan_floor(threshold, plane.guard)),
        base(point_of(corners[0])) {
    const std::array<Point, 3> p{base, point_of(corners[1]), point_of(corners[2])};
    left = std::min({p[0].x, p[1].x, p[2].x});
    right = std::max({p[0].x, p[1].x, p[2].x});
    top = std::min({p[0].y, p[1].y, p[2].y});
    bottom = std::max({p[0].y, p[1].y, p[2].y});
    for (std::size_t i = 0; i < 3; ++i) {
      const Point from = p[i], to = p[i == 2 ? 0 : i + 1];
      along_x[i] = from.y - to.y;
      along_y[i] = to.x - from.x;
      at_corner[i] = along_y[i] * (top - from.y) + along_x[i] * (left - from.x);
    }
  }
  std::int32_t width() const { return right - left + 1; }
  std::int32_t height() const { return bottom - top + 1; }

  std::int32_t edge(std::size_t i, std::int32_t x, std::int32_t y) const {
    return at_corner[i] + along_x[i] * (x - left) + along_y[i] * (y - top);
  }
  bool covers(Point p) const { return edge(0, p.x, p.y) >= 0 && edge(1, p.x, p.y) >= 0 && edge(2, p.x, p.y) >= 0; }

  /// The formula of scan_kernels.h.
  float error(std::int32_t x, std::int32_t y, float sample) const {
    const float along = plane.slope_x * static_cast<float>(x - base.x);
    const float across = plane.slope_y * static_cast<float>(y - base.y);
    const float surface = along + across;
    return std::abs(surface - (sample - plane.height));
  }

  ScanHit hit(const ScanBest& best) const {
    if (best.error > floor) return {best.error, best.at, plane.guard};
    return {0, 0, plane.guard};
  }
};

const ScanKernels& scalar_scan_kernels();

/// The vector kernels of this machine, best first.
std::span<const ScanKernels> vector_scan_kernels();

}  // namespace scarp::geom::detail
