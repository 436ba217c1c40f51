// A band of rows, with the samples that must be covered and the errors found so far.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/array.h"
#include "base/branchless.h"
#include "measure/cut_region.h"
#include "measure/error_summary.h"
#include "measure/judge_kernels.h"
#include "scarp/height_field.h"
#include "scarp/measure.h"
#include "scarp/result.h"

namespace scarp::judge {

/// Bound of the rounding of an error in double arithmetic, relative to its heights.
constexpr double kRounding = 0x1p-48;

/// The worst sample of one triangle in one band.
struct TriangleOffender {
  std::uint32_t triangle = 0;
  Offender offender;
};

/// Orders by triangle, then by decreasing error; ties by the lowest row, then column.
inline bool is_worse_of_triangle(const TriangleOffender& a, const TriangleOffender& b) {
  if (a.triangle != b.triangle) return a.triangle < b.triangle;
  const double x = std::abs(a.offender.error), y = std::abs(b.offender.error);
  if (x != y) return x > y;
  return a.offender.row != b.offender.row ? a.offender.row < b.offender.row : a.offender.col < b.offender.col;
}

/// The findings of one band about the mesh. They depend only on the band.
struct BandReport {
  std::vector<RowSums> rows;
  double largest = -1;                             ///< |error|; −1 without samples
  std::array<std::int32_t, 2> largest_at{-1, -1};  ///< ties by the lowest row, then column
  HeightRange heights;
  std::uint64_t uncovered = 0, stray = 0, cut_off = 0, nodata_cells_covered = 0;
  std::array<std::int32_t, 2> uncovered_at{-1, -1};  ///< the first uncovered sample
  std::vector<TriangleOffender> offenders;
  std::vector<Offender> uncovered_offenders;
  std::uint64_t over_tolerance = 0;
  std::vector<float> kept;  ///< row-major; only if requested
};

/// The errors that make a sample an offender.
struct Limits {
  double everywhere = HUGE_VAL;
  std::span<const float> by_sample = {};  ///< limits of the whole field; empty: none, or those of `source`
  const SampleSource* source = nullptr;   ///< provides the limits of a band
  bool with_uncovered = false;            ///< samples without a triangle are also offenders
  const CutRegion* region = nullptr;      ///< samples outside it are ignored; null: none
};

/// The value that a band returns for each sample: none, mesh − sample, or the mesh's height.
enum class Keep { kNothing, kErrors, kHeights };

/// The rows [first, first + rows) of a field during judging. Scanners read heights and cells, and write errors.
class Band {
 public:
  static constexpr int kMostRows = kMostBandRows;
  static int rows_per_band(int cols) { return cols <= 4096 ? kMostRows : std::max(8, kMostRows * 4096 / cols); }

  /// Reads the rows; samples that need not be covered (nodata, stray or cut off) become NaN. Finds the cells that must
  /// not be covered. Errors are counted in `histogram`, which must outlive the band. Fails if the source of the field
  /// or of the limits fails.
  static Result<Band> read(const HeightField& field, int first, int rows, const Limits& limits, double guard,
                           Histogram& histogram);

  int first() const { return first_; }
  int end() const { return first_ + rows_; }
  int cols() const { return cols_; }
  const float* heights(int row) const { return all_heights_ + height_at(0, row); }
  double* errors(int row) { return all_errors_ + std::ptrdiff_t{row - first_} * stride_; }
  BandRows rows() { return {heights(first_), all_errors_, cols_, stride_, first_, is_whole_}; }

  /// Replaces the error `held` of a sample if `error` is larger in magnitude, or equal in magnitude and positive.
  void offer(double& held, double error) {
    const double now = std::abs(error), before = std::abs(held);
    if (now < before || (now == before && !(error > held))) return;  // false for the NaN of a sample not covered yet
    held = error;
    if (now > largest_) largest_ = now;
  }
  /// The smallest error that is critical or makes its sample an offender.
  double watch() const {
    const double limit = lesser(largest_, least_limit_);
    return limit - (2 * guard_ + 4 * kRounding * std::abs(limit));
  }
  /// True if an error of about this size may become the band's largest or exceed a bound, so that its last bit matters.
  bool is_critical(int col, int row, double error) const {
    const double magnitude = std::abs(error);
    const double upper = magnitude + (guard_ + kRounding * magnitude);
    return upper >= largest_ || (upper >= least_limit_ && is_close(col, row, magnitude, upper));
  }
  bool is_offender(int col, int row, double error) const {
    const double magnitude = std::abs(error);
    return magnitude > least_limit_ && (magnitude > limits_.everywhere || magnitude > tolerance(col, row));
  }
  /// Records a sample of `triangle` whose error exceeds its bound.
  void add_offender(std::uint32_t triangle, Offender offender) { report_.offenders.push_back({triangle, offender}); }

  /// Sums up the rows that are completely covered. Returns true if a sample that must be covered is uncovered. Also
  /// drops uncovered samples near the edge of the region. Called once.
  bool find_missing();
  /// The same for one row, after find_missing().
  bool row_has_missing(int row) const { return row_missing_[static_cast<std::size_t>(row - first_)] != 0; }
  bool is_missing(int col, int row) const { return nearest_[at(col, row)].distance >= 0; }
  /// Offers a triangle at some distance to a missing sample, which accepts the nearest triangle; for ties, the larger
  /// error.
  void offer_nearest(int col, int row, double distance, std::uint32_t triangle, double error);

  // Cells. Cell (col, row) lies between the samples (col, row) and (col + 1, row + 1).
  bool has_nodata_cells() const { return has_nodata_cells_; }
  bool row_has_nodata_cells(int row) const { return row_nodata_cells_[static_cast<std::size_t>(row - first_)] != 0; }
  /// The point that is tested for coverage of the cell's nodata part; nothing if the cell is whole or already counted.
  std::optional<std::array<double, 2>> nodata_point(int col, int row) const;
  void count_nodata_cell(int col, int row);

  /// Sums up the remaining rows. The band must not be used afterwards.
  BandReport finish(Keep keep);

 private:
  Band(const HeightField& field, int first, int rows, const Limits& limits, double guard, Histogram& histogram);
  Result<void> take_heights(const HeightField& field);
  /// If all samples of the rows [top, bottom) are heights, borrows them from the field's memory and returns true.
  bool borrow_heights(const HeightField& field, int top, int bottom);
  void note_range(const std::vector<RowHeights>& rows, int top);

  struct Nearest {
    double distance = -1;  ///< −1: not missing; infinite: no near triangle yet
    std::uint32_t triangle = 0;
  };
  static constexpr std::uint8_t kWhole = 0, kNodata = 1, kHalf = 2, kCounted = 6;  // kHalf + missing corner
  std::size_t at(int col, int row) const {
    return static_cast<std::size_t>(row - first_) * static_cast<std::size_t>(cols_) + static_cast<std::size_t>(col);
  }
  /// heights_ has one more row above and below, for the cells there; NaN beyond the field.
  std::size_t height_at(int col, int row) const { return at(col, row + 1); }
  bool is_close(int col, int row, double magnitude, double upper) const {
    const double lower = magnitude - (upper - magnitude);
    const auto is_between = [&](double limit) { return upper >= limit && lower <= limit; };
    return is_between(limits_.everywhere) || is_between(tolerance(col, row));
  }
  double tolerance(int col, int row) const {
    if (!tolerances_.empty()) return tolerances_[at(col, row)];
    return limits_.by_sample.empty()
               ? HUGE_VAL
               : double{limits_.by_sample[static_cast<std::size_t>(row) * static_cast<std::size_t>(cols_) +
                                          static_cast<std::size_t>(col)]};
  }
  bool has_tolerances() const { return !limits_.by_sample.empty() || !tolerances_.empty(); }
  /// REQUIRES: there is a region.
  CutRegion::Place place(int col, int row) const { return places_[at(col, row)]; }
  bool is_whole(int row) const { return valid_[static_cast<std::size_t>(row - first_ + 1)] == cols_; }
  void classify();
  void cut();
  /// Removes a height, so that it need not be covered.
  void drop(int col, int row);
  bool find_missing(int row);
  Buckets sum(int row);
  void find_largest();

  int cols_ = 0, stride_ = 0, first_ = 0, rows_ = 0;
  bool has_row_below_ = false;  // in the field
  Limits limits_;
  double least_limit_ = HUGE_VAL;  // the smallest limit of any sample
  double guard_ = 0, largest_ = 0;
  bool is_whole_ = false;  // all of its samples must be covered
  bool has_nodata_cells_ = false;
  Histogram& histogram_;
  Array<float> heights_;                // empty if borrowed from the field
  const float* all_heights_ = nullptr;  // starts at the row above
  std::vector<std::int32_t> valid_;     // number of remaining heights by row, from the row above on
  std::vector<float> tolerances_;       // empty unless a source provides them
  Array<double> errors_;
  double* all_errors_ = nullptr;  // in errors_: rows of stride_, each aligned to a cache line
  Array<std::uint32_t> scratch_;
  std::vector<CutRegion::Place> places_;  // empty without a region
  std::vector<Nearest> nearest_;          // empty if nothing is missing
  std::vector<std::uint8_t> cells_, row_nodata_cells_, row_missing_;
  BandReport report_;
};

}  // namespace scarp::judge
