// The judge's inner loops in vectors of doubles: the errors of a triangle's samples, and their sums.
//
// One source is compiled for every instruction set, as that of the engine's scan, with which it shares nothing; the
// best that the machine has is chosen at run time. All of them, and the twin in plain loops, give the same bits: a
// sample's error is the same sequence of separately rounded operations everywhere, samples are judged row by row, and
// sums have eight parts by column whatever the width of a vector.
//
// The computation for a sample at column c of a row, with the side opposite to corner k from (x, y) along (dx, dy):
//   weight[k] = dx[k]·(row − y[k]) − dy[k]·(c − x[k])                  not below 0
//   error     = (Σ weight[k]·(z[k] − sample)) · per_area              in the order of k
// It belongs to the triangle if no weight is below −slack, and where the row has a span, if c lies in it:
//   for dy[k] > 0:  c <= x[k] + dx[k]·(row − y[k])·per_dy[k] + margin     and likewise >= … − margin for dy[k] < 0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "measure/error_summary.h"

namespace scarp::judge {

/// The arrays of a band may be read, and that of errors written, this far beyond their end.
constexpr std::size_t kKernelPadding = 8;

/// Number of rows; the most that a kernel is given at once.
constexpr std::int32_t kMostBandRows = 32;

/// The rows of a band, one after the other.
struct BandRows {
  const float* heights;  ///< NaN: not to be judged
  double* errors;        ///< NaN: none so far
  std::int32_t cols;     ///< also from one row of heights to the next
  std::int32_t stride;   ///< from one row of errors to the next
  std::int32_t first;    ///< the row that the arrays begin with
  bool is_whole;         ///< no height is NaN
};

/// A triangle, counter-clockwise, and the part of it that lies in a band.
struct FacetTask {
  std::array<double, 3> x, y, dx, dy;  ///< side opposite to corner k
  std::array<double, 3> z;
  double slack, per_area;
  std::int32_t first, last;  ///< rows, in the band
  std::int32_t left, right;  ///< columns, in the raster: no sample of the triangle lies outside them
  /// Nothing is rounded in a weight: corners are multiples of 1/256, and not far from each other nor from the origin.
  bool is_exact;
  /// Each row's columns end at the triangle's sides, `margin` farther out. For an exact facet these are its samples, no
  /// more and no less: no side passes a sample that it misses as near as that.
  bool has_spans;
  double margin;
  std::array<double, 3> per_dy;  ///< 1 / dy, with spans
};

/// Samples whose errors must not be left to plain arithmetic.
struct Caution {
  double watch;  ///< errors of this magnitude or more, but for those of samples that lie exactly on all corners' height
  void* judge;
  /// Judges the samples of a row at column + k for each bit k in `lanes`, from the lowest. Returns the new `watch`,
  /// which never falls.
  double (*look)(void* judge, std::int32_t row, std::int32_t column, std::uint32_t lanes);
};

/// The result of reading a row of samples.
struct RowHeights {
  std::uint32_t valid = 0;
  float least = 0, most = 0;  ///< infinite, least above most, without a valid one
};

struct JudgeKernels {
  const char* name;  ///< name in Highway; "SCALAR": the twin in plain loops

  /// The errors of the facet's samples become those of the band where they are larger than what is held, or of equal
  /// magnitude and positive. Calls caution.look() for those from caution.watch on instead, in raster order.
  void (*judge_facet)(const FacetTask& facet, const BandRows& band, Caution& caution);

  /// Sums up the errors that are not NaN and hands out their buckets, up to kKernelPadding more than there are errors:
  /// those too many are 0, and subtracted by Buckets::zeros.
  RowSums (*sum_row)(const double* errors, std::int32_t count, Buckets& buckets);

  /// Copies samples, those that are no heights (NaN, the infinities, `nodata`) as NaN. `nodata` is NaN where there is
  /// none; `from` and `to` may be equal. A null `to`: nothing is copied.
  RowHeights (*take_row)(const float* from, std::int32_t count, float nodata, float* to);
};

/// The kernels in use: see base/instruction_sets.h. Chosen once, at the first call.
const JudgeKernels& judge_kernels();

/// All that run on this machine, best first, the twin last.
std::span<const JudgeKernels> available_judge_kernels();

namespace detail {
const JudgeKernels& scalar_judge_kernels();
std::span<const JudgeKernels> vector_judge_kernels();
}  // namespace detail

}  // namespace scarp::judge
