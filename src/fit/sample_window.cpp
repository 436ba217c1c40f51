#include "fit/sample_window.h"

#include <algorithm>
#include <cstddef>

namespace scarp {

namespace {

constexpr std::int64_t kMostPerTriangle = 1024;  // samples worth copying

/// Floats in a row: an odd number of cache lines.
std::int32_t stride_of(std::int32_t cols) { return ((cols + 31) & ~31) + 16; }

}  // namespace

TriangleError SampleWindow::errors(const Raster& raster, const Patch& patch, double threshold) {
  const auto [first, cols, rows] = patch.window();
  const std::int32_t stride = stride_of(cols);
  const std::int64_t size = std::int64_t{stride} * rows;
  if (size > kMostPerTriangle * static_cast<std::int64_t>(patch.face_count())) return {raster, first, threshold};
  samples_.resize(static_cast<std::size_t>(size));
  for (std::int32_t y = 0; y < rows; ++y) {
    const float* const from = raster.row(first.y + y) + first.x;
    std::copy(from, from + cols, samples_.begin() + std::int64_t{stride} * y);
  }
  return {Raster{samples_.data(), stride, rows}, {0, 0}, threshold};
}

}  // namespace scarp
