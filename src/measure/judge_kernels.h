// The judge's inner loops in vectors of doubles: the errors of a triangle's samples, and their sums.
//
// One source is compiled for every instruction set, as for the engine's scan, with which it shares no code. The best
// set that the machine supports is chosen at run time. All sets, and the scalar twin, compute the same bits: a sample's
// error is the same sequence of separately rounded operations everywhere, samples are judged row by row, and sums have
// eight parts by column for any vector width.
//
// The computation for a sample at column c of a row; the side opposite to corner k runs from (x, y) along (dx, dy):
//   weight[k] = dx[k]·(row − y[k]) − dy[k]·(c − x[k])                  at least 0
//   error     = (Σ weight[k]·(z[k] − sample)) · per_area              in the order of k
// The sample belongs to the triangle if no weight is below −slack and, in rows with a span, c is in the span:
//   for dy[k] > 0:  c <= x[k] + dx[k]·(row − y[k])·per_dy[k] + margin     and likewise >= … − margin for dy[k] < 0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "measure/error_summary.h"

namespace scarp::judge {

/// The arrays of a band are readable for this many elements beyond their end, and the array of errors is writable
/// there.
constexpr std::size_t kKernelPadding = 8;

/// Largest number of rows passed to a kernel.
constexpr std::int32_t kMostBandRows = 32;

/// The rows of a band, consecutive in memory.
struct BandRows {
  const float* heights;  ///< NaN: ignored
  double* errors;        ///< NaN: none so far
  std::int32_t cols;     ///< also stride of the heights
  std::int32_t stride;   ///< stride of the errors
  std::int32_t first;    ///< first row of the arrays
  bool is_whole;         ///< no height is NaN
};

/// A counter-clockwise triangle, and its part in a band.
struct FacetTask {
  std::array<double, 3> x, y, dx, dy;  ///< side opposite to corner k
  std::array<double, 3> z;
  double slack, per_area;
  std::int32_t first, last;  ///< rows, in the band
  std::int32_t left, right;  ///< columns, in the raster: all samples of the triangle lie within
  /// Weights are computed without rounding: corners are multiples of 1/256, close to each other and to the origin.
  bool is_exact;
  /// Each row's columns end `margin` outside the triangle's sides. For an exact facet these columns are exactly its
  /// samples, since no sample outside is closer than `margin` to a side.
  bool has_spans;
  double margin;
  std::array<double, 3> per_dy;  ///< 1 / dy, with spans
};

/// Samples whose errors need more than plain arithmetic.
struct Caution {
  double watch;  ///< errors of at least this magnitude, unless the sample equals all corners' heights
  void* judge;
  /// Judges the samples of a row at column + k for each bit k in `lanes`, in ascending order. Returns the new `watch`,
  /// which never decreases.
  double (*look)(void* judge, std::int32_t row, std::int32_t column, std::uint32_t lanes);
};

/// The result of reading a row of samples.
struct RowHeights {
  std::uint32_t valid = 0;
  float least = 0, most = 0;  ///< infinite, with least > most, if no sample is valid
};

struct JudgeKernels {
  const char* name;  ///< Highway's name; "SCALAR": the twin

  /// Stores the errors of the facet's samples in the band if they are larger than those held, or equal in magnitude and
  /// positive. For errors of caution.watch or more, calls caution.look() instead, in raster order.
  void (*judge_facet)(const FacetTask& facet, const BandRows& band, Caution& caution);

  /// Sums up the errors that are not NaN and returns their buckets, with up to kKernelPadding extra buckets. The extra
  /// buckets are 0; Buckets::zeros subtracts them.
  RowSums (*sum_row)(const double* errors, std::int32_t count, Buckets& buckets);

  /// Copies samples; missing samples (NaN, infinities, `nodata`) become NaN. Without a nodata value, `nodata` is NaN.
  /// `from` and `to` may be equal. Copies nothing if `to` is null.
  RowHeights (*take_row)(const float* from, std::int32_t count, float nodata, float* to);
};

/// The kernels in use (see base/instruction_sets.h), chosen at the first call.
const JudgeKernels& judge_kernels();

/// All kernels that run on this machine, best first, the twin last.
std::span<const JudgeKernels> available_judge_kernels();

namespace detail {
const JudgeKernels& scalar_judge_kernels();
std::span<const JudgeKernels> vector_judge_kernels();
}  // namespace detail

}  // namespace scarp::judge
