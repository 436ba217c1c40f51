// Reading raster rows, in memory or streamed, in bands of several rows. Samples in memory are a single band.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/function_ref.h"
#include "base/point.h"
#include "grid/raster.h"
#include "scarp/height_field.h"
#include "scarp/result.h"

namespace scarp::grid {

/// The rows of samples, or of another value per sample, that are currently in memory. For one thread.
class Band {
 public:
  /// Reads a window, row-major.
  using Read = std::function<Result<void>(Point first, std::int32_t cols, std::int32_t rows, float* out)>;
  /// Initially holds no rows, later at most `most`. The field must outlive the band.
  Band(const HeightField& field, std::int32_t most);
  Band(std::int32_t cols, std::int32_t rows, Read read, std::int32_t most);

  /// Loads exactly `count` rows from `first` on. Rows already held are not read again. Fails as the source does.
  /// REQUIRES: count <= most.
  Result<void> load(std::int32_t first, std::int32_t count);
  /// Like load(), but throws SourceFailure.
  void hold(std::int32_t first, std::int32_t count);
  void clear() { count_ = 0; }

  /// `count` samples of row y from column x on, valid until the next call. A row that is not held is read for this call
  /// only. Throws SourceFailure.
  const float* samples(std::int32_t x, std::int32_t y, std::int32_t count) const;

  bool holds(std::int32_t row) const { return row >= first_ && row < first_ + count_; }
  /// REQUIRES: holds(y).
  float* row(std::int32_t y) { return held_.data() + std::ptrdiff_t{y - first_} * cols_; }
  Raster raster() const { return {held_.data(), cols_, count_}; }
  std::int32_t first() const { return first_; }
  std::int32_t cols() const { return cols_; }
  std::int32_t rows() const { return rows_; }  ///< rows of the whole raster

 private:
  std::int32_t cols_, rows_;
  Read read_;
  std::int32_t first_ = 0, count_ = 0;
  std::vector<float> held_;
  mutable std::vector<float> apart_;
};

/// A raster, or a band; both must outlive this view.
class SampleView {
 public:
  SampleView(const Raster& raster) : raster_(raster) {}                                       // NOLINT: either will do
  SampleView(const Band& band) : raster_{nullptr, band.cols(), band.rows()}, band_(&band) {}  // NOLINT

  std::int32_t cols() const { return raster_.cols; }
  std::int32_t rows() const { return raster_.rows; }
  /// Like Band::samples().
  const float* samples(std::int32_t x, std::int32_t y, std::int32_t count) const {
    return band_ == nullptr ? raster_.row(y) + x : band_->samples(x, y, count);
  }
  float at(Point p) const { return *samples(p.x, p.y, 1); }
  bool is_valid(Point p) const { return !std::isnan(at(p)); }

 private:
  Raster raster_;
  const Band* band_ = nullptr;
};

/// The division of a raster into bands. A sweep processes each band once, together with half a band on both sides.
struct Bands {
  std::int32_t rows = 0, side = 1;

  std::size_t count() const { return static_cast<std::size_t>((rows - 1) / side + 1); }
  std::int32_t begin(std::size_t i) const { return static_cast<std::int32_t>(i) * side; }
  std::size_t at(std::int32_t row) const { return static_cast<std::size_t>(row / side); }
  /// True if this band's sweep processes the row: it lies in the band, or slightly above it, which saves another sweep.
  bool reaches(std::size_t i, std::int32_t row) const { return row >= begin(i) - side / 4 && row < begin(i) + side; }
  void hold(std::size_t i, Band& band) const {
    const std::int32_t first = std::max(begin(i) - side / 2, 0);
    band.hold(first, std::min(begin(i) + side + side / 2, rows) - first);
  }
};

/// Rows [begin, end) of a raster, plus a limited number above and below.
struct RowRange {
  Raster samples;          ///< NaN is nodata
  std::int32_t first = 0;  ///< the raster's row that `samples` begins with
  std::int32_t begin = 0, end = 0;

  const float* row(std::int32_t y) const { return samples.row(y - first); }
};

/// Calls visit(range) from the top down. Each row lies in [begin, end) of one range, which also holds up to `reach`
/// rows above and below. A raster in memory is one range. Streamed samples are read once. Memory: 4 bytes per sample of
/// 64 + 2 · reach rows. Fails as the field does, and as visit() does.
Result<void> sweep_rows(const HeightField& field, std::int32_t reach,
                        FunctionRef<Result<void>(const RowRange& range)> visit);

/// Bytes of a range of sweep_rows(); 0 for samples in memory.
std::uint64_t sweep_bytes(const HeightField& field, std::int32_t reach);

/// Returns rows one by one, from the top down. Reads each row once, several rows at a time.
class RowReader {
 public:
  explicit RowReader(const HeightField& field);
  RowReader(const RowReader&) = delete;

  /// The samples of a row, nodata as NaN, valid until the next call; the caller may change them. Fails as the field's
  /// source does.
  Result<float*> read(std::int32_t row);

 private:
  HeightField field_;
  std::int32_t most_;
  Band band_;
};

}  // namespace scarp::grid
