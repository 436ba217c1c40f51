#include "fit/sample_window.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace scarp::fit {

namespace {

constexpr std::int64_t kMostPerTriangle = 1024;  // samples that are worth copying

/// Floats in a row: an odd number of cache lines.
std::int32_t stride_of(std::int32_t cols) { return ((cols + 31) & ~31) + 16; }

void copy(const grid::Raster& from, const Patch::Window& window, std::int32_t stride, std::vector<float>& to) {
  to.resize(static_cast<std::size_t>(stride) * static_cast<std::size_t>(window.rows));
  for (std::int32_t y = 0; y < window.rows; ++y) {
    const float* const row = from.row(window.first.y + y) + window.first.x;
    std::copy(row, row + window.cols, to.begin() + std::int64_t{stride} * y);
  }
}

/// The range of the bounds of a window's valid samples.
class BoundRange {
 public:
  BoundRange(const grid::Raster& raster, const grid::Raster& bounds, const Patch::Window& window) {
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

TriangleError SampleWindow::errors(const ReadWindow& read, const ReadWindow& read_bounds, const Patch& patch,
                                   double threshold) {
  const Patch::Window& window = patch.window();
  const std::int32_t stride = stride_of(window.cols);
  samples_.resize(static_cast<std::size_t>(stride) * static_cast<std::size_t>(window.rows));
  if (window.rows > 0) read(window, samples_.data(), stride);
  const grid::Raster samples{samples_.data(), stride, window.rows};
  if (!read_bounds) return TriangleError(samples, Point{0, 0}, threshold);
  bounds_.resize(samples_.size());
  if (window.rows > 0) read_bounds(window, bounds_.data(), stride);
  const BoundRange range(samples, {bounds_.data(), stride, window.rows}, {{0, 0}, window.cols, window.rows});
  if (range.is_one()) return TriangleError(samples, Point{0, 0}, range.least());
  return TriangleError(samples, Point{0, 0}, SampleBounds{bounds_.data(), range.unit()});
}

TriangleError SampleWindow::errors(const ScatteredSamples& points, const Patch& patch, double threshold) {
  return TriangleError(points.over(patch.window(), threshold, scattered_));
}

TriangleError SampleWindow::errors(const grid::Raster& raster, std::span<const float> bounds, const FitNorm* norm,
                                   const Patch& patch, double threshold) {
  const Patch::Window& window = patch.window();
  const std::int32_t stride = stride_of(window.cols);
  const std::int64_t size = std::int64_t{stride} * window.rows;
  const bool is_copied = size <= kMostPerTriangle * static_cast<std::int64_t>(patch.face_count());
  const auto beside = [&](const float* values, std::vector<float>& buffer) {
    if (!is_copied) return values;
    copy({values, raster.cols, raster.rows}, window, stride, buffer);
    return static_cast<const float*>(buffer.data());
  };
  grid::Raster samples = raster;
  samples.samples = beside(raster.samples, samples_);
  if (is_copied) samples = {samples.samples, stride, window.rows};
  const Point first = is_copied ? Point{0, 0} : window.first;
  const grid::Raster all{bounds.data(), raster.cols, raster.rows};
  std::optional<BoundRange> range;
  if (!bounds.empty()) range.emplace(raster, all, window);
  const bool is_one = !range || range->is_one();
  if (range && is_one) threshold = range->least();
  const SampleBounds own = is_one ? SampleBounds{} : SampleBounds{beside(bounds.data(), bounds_), range->unit()};
  if (norm == nullptr) return is_one ? TriangleError(samples, first, threshold) : TriangleError(samples, first, own);
  fields_.resize(norm->fields.size());
  NormError::Samples fields{samples, {}, first, window.first};
  for (std::size_t k = 0; k < fields_.size(); ++k) {
    const float* const of = norm->fields[k].samples;
    fields.fields.push_back(of == raster.samples ? samples.samples : beside(of, fields_[k]));
  }
  if (is_one) {
    norm_.emplace(*norm, std::move(fields), threshold);
  } else {
    norm_.emplace(*norm, std::move(fields), own);
  }
  return TriangleError(*norm_);
}

}  // namespace scarp::fit
