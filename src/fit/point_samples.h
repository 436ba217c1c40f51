// Points as scattered samples for fitting.
//
// The points are stored in Morton order, so a window consists of few runs. A patch copies these runs into rows of
// buckets, from west to east. A triangle reads the buckets under it, one run per row.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/point.h"
#include "fit/patch.h"
#include "fit/scattered_samples.h"
#include "fit/triangle_error.h"

namespace scarp::fit {

class PointSamples final : public ScatteredSamples {
 public:
  /// Spans of equal size, in Morton order of `at`, in lattice steps; they must outlive this object. `z`: finite, at
  /// most kMaxScanHeight in magnitude, read as float32. `rounding`: largest distance of samples from their lattice
  /// points, in steps.
  PointSamples(std::span<const Point> at, std::span<const double> z, Point last, double rounding);

  const ScatteredErrors& over(const Patch::Window& window, double threshold,
                              std::unique_ptr<ScatteredErrors>& kept) const override;

  std::span<const Point> at() const { return at_; }
  std::span<const double> z() const { return z_; }
  double rounding() const { return rounding_; }

 private:
  std::span<const Point> at_;
  std::span<const double> z_;
  double rounding_;
};

/// The samples under a patch. Reuses its memory for the next patch.
class PointWindow {
 public:
  /// Reads the samples of a window of cells of kLatticeSteps, its last column and row included.
  void read(const PointSamples& samples, const Patch::Window& window);

  std::size_t size() const { return z_.size() - 1; }
  /// A sample, counted in the order of the window; for index size() all coordinates are 0, and the height NaN.
  FitCorner at(std::size_t i) const {
    return {static_cast<std::int32_t>(x_[i]), static_cast<std::int32_t>(y_[i]), z_[i]};
  }
  const float* x() const { return x_.data(); }
  const float* y() const { return y_.data(); }
  const float* z() const { return z_.data(); }

  /// The sample nearest to a place; ties: the first. size() if there are no samples.
  std::size_t nearest(const FitCorner& place) const;

  /// Samples [begin, end) of a row of buckets.
  struct Run {
    std::uint32_t begin, end;
  };
  std::int32_t rows() const { return rows_; }
  std::int32_t row_of(std::int32_t y) const { return y >> shift_; }
  /// The northern end of a row, in steps.
  double top_of(std::int32_t row) const { return static_cast<double>(std::int64_t{row} << shift_); }
  double height_of_row() const { return static_cast<double>(std::int64_t{1} << shift_); }
  /// The run of buckets over [west, east], which is clamped to the window.
  Run run(std::int32_t row, double west, double east) const {
    const std::int32_t first = column_of(west), last = column_of(east);
    const std::uint32_t* const begins = begins_.data() + std::ptrdiff_t{row} * cols_;
    return {begins[first], begins[last + 1]};
  }

 private:
  std::int32_t column_of(double x) const {
    const std::int32_t col = x > 0 ? static_cast<std::int32_t>(x) >> shift_ : 0;
    return col < cols_ ? col : cols_ - 1;
  }
  void sort_into_buckets(std::int64_t width, std::int64_t height);

  std::vector<float> x_, y_, z_;  // steps from the window's first, exact in float32; one sentinel at the end
  std::vector<float> unsorted_x_, unsorted_y_, unsorted_z_;
  std::vector<std::uint32_t> begins_;  // by bucket
  std::int32_t cols_ = 1, rows_ = 1;   // size in buckets
  int shift_ = 0;                      // binary logarithm of a bucket's side in steps
};

}  // namespace scarp::fit
