// The one way to read rows of a raster, wherever its samples are: some rows at a time are in memory. Where all samples
// are, they are one band.
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

namespace scarp {

/// Rows that are in memory for now, of samples or of another value for each. For one thread.
class Band {
 public:
  /// Reads a window, row-major.
  using Read = std::function<Result<void>(Point first, std::int32_t cols, std::int32_t rows, float* out)>;
  /// Holds no row yet, and at most so many later. The field stays alive.
  Band(const HeightField& field, std::int32_t most);
  Band(std::int32_t cols, std::int32_t rows, Read read, std::int32_t most);

  /// Holds `count` rows from `first` on, and no others; those that it held are not read again. Fails as the source
  /// does. REQUIRES: count <= most.
  Result<void> load(std::int32_t first, std::int32_t count);
  /// The same; throws SourceFailure.
  void hold(std::int32_t first, std::int32_t count);
  /// Forgets all rows.
  void clear() { count_ = 0; }

  /// `count` samples of row y from column x on, until the next call. If the row is not held they are read for this call
  /// alone. Throws SourceFailure.
  const float* samples(std::int32_t x, std::int32_t y, std::int32_t count) const;

  bool holds(std::int32_t row) const { return row >= first_ && row < first_ + count_; }
  /// REQUIRES: holds(y).
  float* row(std::int32_t y) { return held_.data() + std::ptrdiff_t{y - first_} * cols_; }
  /// The rows that are held.
  Raster raster() const { return {held_.data(), cols_, count_}; }
  std::int32_t first() const { return first_; }
  std::int32_t cols() const { return cols_; }
  std::int32_t rows() const { return rows_; }  ///< rows of the whole

 private:
  std::int32_t cols_, rows_;
  Read read_;
  std::int32_t first_ = 0, count_ = 0;
  std::vector<float> held_;
  mutable std::vector<float> apart_;
};

/// A raster, or a band: both stay alive.
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

/// How a raster is gone through in bands, each at work once in a sweep, with half as much of its neighbours on both
/// sides in memory.
struct Bands {
  std::int32_t rows = 0, side = 1;

  std::size_t count() const { return static_cast<std::size_t>((rows - 1) / side + 1); }
  std::int32_t begin(std::size_t i) const { return static_cast<std::int32_t>(i) * side; }
  std::size_t at(std::int32_t row) const { return static_cast<std::size_t>(row / side); }
  /// A little above a band counts as in it, so that it need not wait for another sweep.
  bool reaches(std::size_t i, std::int32_t row) const { return row >= begin(i) - side / 4 && row < begin(i) + side; }
  void hold(std::size_t i, Band& band) const {
    const std::int32_t first = std::max(begin(i) - side / 2, 0);
    band.hold(first, std::min(begin(i) + side + side / 2, rows) - first);
  }
};

/// Rows [begin, end) of a raster, and up to a given number more above and below.
struct RowRange {
  Raster samples;          ///< NaN is nodata
  std::int32_t first = 0;  ///< first of its rows, in the raster
  std::int32_t begin = 0, end = 0;

  const float* row(std::int32_t y) const { return samples.row(y - first); }
};

/// Calls visit(range) from the top down; each row lies in [begin, end) of one range, which has `reach` rows above and
/// below those, where the raster has them. A raster in memory is one range. Streamed samples are read once; memory: 4
/// bytes a sample of 64 + 2 · reach rows. Fails as the field does, and as visit() does.
Result<void> sweep_rows(const HeightField& field, std::int32_t reach,
                        FunctionRef<Result<void>(const RowRange& range)> visit);

/// Bytes of such a range; 0 where the samples are in memory.
std::uint64_t sweep_bytes(const HeightField& field, std::int32_t reach);

/// Rows that are asked for one by one: from the top down each is read once, some at a time.
class RowReader {
 public:
  explicit RowReader(const HeightField& field);
  RowReader(const RowReader&) = delete;

  /// The samples of a row, nodata as NaN, the caller's to change, until the next call. Fails as the field's source
  /// does.
  Result<float*> read(std::int32_t row);

 private:
  HeightField field_;
  std::int32_t most_;
  Band band_;
};

}  // namespace scarp
