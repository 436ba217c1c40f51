// The engine's samples.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/point.h"

namespace scarp::grid {

/// Borrowed float32 samples, row-major; nodata samples are NaN (there are no infinities).
struct Raster {
  const float* samples = nullptr;
  std::int32_t cols = 0, rows = 0;

  const float* row(std::int32_t y) const {
    return samples + static_cast<std::size_t>(y) * static_cast<std::size_t>(cols);
  }
  float at(Point p) const { return row(p.y)[p.x]; }
  bool is_valid(Point p) const { return !std::isnan(at(p)); }
};

}  // namespace scarp::grid
