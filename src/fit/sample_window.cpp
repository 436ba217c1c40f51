#include "fit/sample_window.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace scarp {

namespace {

constexpr std::int64_t kMostPerTriangle = 1024;  // samples worth copying

/// Floats in a row: an odd number of cache lines.
std::int32_t stride_of(std::int32_t cols) { return ((cols + 31) & ~31) + 16; }

void copy(const Raster& from, const Patch::Window& window, std::int32_t stride, std::vector<float>& to) {
  to.resize(static_cast<std::size_t>(stride) * static_cast<std::size_t>(window.rows));
  for (std::int32_t y = 0; y < window.rows; ++y) {
    const float* const row = from.row(window.first.y + y) + window.first.x;
    std::copy(row, row + window.cols, to.begin() + std::int64_t{stride} * y);
  }
}

/// Bounds of the valid samples of a window that are some.
class BoundRange {
 public:
  BoundRange(const Raster& raster, const Raster& bounds, const Patch::Window& window) {
    for (std::int32_t y = window.first.y; y < window.first.y + window.rows; ++y) {
      for (std::int32_t x = window.first.x; x < window.first.x + window.cols; ++x) {
        if (raster.is_valid({x, y})) add(bounds.at({x, y}));
      }
    }
  }
  bool is_one() const { return least_ == most_ && std::isfinite(most_); }
  float least() const { return least_; }
  /// A power of two near the geometric mean: products with it are exact.
  double unit() const { return count_ == 0 ? 1 : std::ldexp(1.0, static_cast<int>(exponents_ / count_)); }

 private:
  void add(float bound) {
    least_ = std::min(least_, bound);
    most_ = std::max(most_, bound);
    if (bound < kLeast || bound > 1 / kLeast) return;
    ++count_;
    exponents_ += std::ilogb(bound);
  }

  static constexpr float kLeast = 0x1p-60f;
  float least_ = std::numeric_limits<float>::infinity(), most_ = 0;
  std::int64_t count_ = 0, exponents_ = 0;
};

}  // namespace

TriangleError SampleWindow::errors(const Raster& raster, std::span<const float> bounds, const Patch& patch,
                                   double threshold) {
  const Patch::Window& window = patch.window();
  const std::int32_t stride = stride_of(window.cols);
  const std::int64_t size = std::int64_t{stride} * window.rows;
  const bool is_copied = size <= kMostPerTriangle * static_cast<std::int64_t>(patch.face_count());
  if (is_copied) copy(raster, window, stride, samples_);
  const Raster samples = is_copied ? Raster{samples_.data(), stride, window.rows} : raster;
  const Point first = is_copied ? Point{0, 0} : window.first;
  if (bounds.empty()) return {samples, first, threshold};
  const Raster all{bounds.data(), raster.cols, raster.rows};
  const BoundRange range(raster, all, window);
  if (range.is_one()) return {samples, first, range.least()};
  if (is_copied) copy(all, window, stride, bounds_);
  return {samples, first, SampleBounds{is_copied ? bounds_.data() : bounds.data(), range.unit()}};
}

}  // namespace scarp
