// Samples, or other per-sample values, with some rows at a time in memory, for passes over a raster from the top down
// that seldom look beyond these rows.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/point.h"
#include "grid/raster.h"
#include "scarp/height_field.h"
#include "scarp/result.h"

namespace scarp {

/// Rows of a field with a source, or of a reader in its place. For one thread.
class SampleRows {
 public:
  /// Reads a window, row-major.
  using Read = std::function<Result<void>(Point first, std::int32_t cols, std::int32_t rows, float* out)>;
  /// Holds none yet, and at most so many later. The field stays alive.
  SampleRows(const HeightField& field, std::int32_t most);
  SampleRows(std::int32_t cols, std::int32_t rows, Read read, std::int32_t most);

  /// Holds `count` rows from `first` on, and no others; those that it held are not read again. Throws SourceFailure.
  /// REQUIRES: count <= most.
  void hold(std::int32_t first, std::int32_t count);

  /// `count` samples of row y from column x on, until the next call. Of a row that is not held they are read for this
  /// call alone. Throws SourceFailure.
  const float* samples(std::int32_t x, std::int32_t y, std::int32_t count) const;

  std::int32_t cols() const { return cols_; }
  std::int32_t rows() const { return rows_; }

 private:
  std::int32_t cols_, rows_;
  Read read_;
  std::int32_t first_ = 0, count_ = 0;
  std::vector<float> held_;
  mutable std::vector<float> apart_;
};

/// A raster, or rows held elsewhere: both stay alive.
class SampleView {
 public:
  SampleView(const Raster& raster) : raster_(raster) {}  // NOLINT: either will do
  SampleView(const SampleRows& rows) : raster_{nullptr, rows.cols(), rows.rows()}, rows_(&rows) {}  // NOLINT

  std::int32_t cols() const { return raster_.cols; }
  std::int32_t rows() const { return raster_.rows; }
  /// As SampleRows::samples().
  const float* samples(std::int32_t x, std::int32_t y, std::int32_t count) const {
    return rows_ == nullptr ? raster_.row(y) + x : rows_->samples(x, y, count);
  }
  float at(Point p) const { return *samples(p.x, p.y, 1); }
  bool is_valid(Point p) const { return !std::isnan(at(p)); }

 private:
  Raster raster_;
  const SampleRows* rows_ = nullptr;
};

}  // namespace scarp
