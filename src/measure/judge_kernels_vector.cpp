// The judge's kernels in vectors, compiled once for every instruction set through Highway.
//
// Vectors have at most eight lanes. Between HWY_BEFORE_NAMESPACE and HWY_AFTER_NAMESPACE, use no lambdas or standard
// library functions: they would be compiled for one instruction set and linked for all.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "measure/judge_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "measure/judge_kernels_vector.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#include "base/wasm_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace scarp::judge::HWY_NAMESPACE {

#if SCARP_HAVE_FLOAT64 && !HWY_HAVE_SCALABLE

namespace hn = hwy::HWY_NAMESPACE;

using Wide = hn::CappedTag<double, 8>;
using WideVec = hn::Vec<Wide>;

/// Constants of a facet, in registers, since the compiler must assume that stores of errors change memory.
struct FacetHeights {
  WideVec z0, z1, z2, per_area, watch;

  HWY_INLINE FacetHeights(const FacetTask& facet, const Caution& caution)
      : z0(hn::Set(Wide(), facet.z[0])),
        z1(hn::Set(Wide(), facet.z[1])),
        z2(hn::Set(Wide(), facet.z[2])),
        per_area(hn::Set(Wide(), facet.per_area)),
        watch(hn::Set(Wide(), caution.watch)) {}
};

/// Offers the errors of the samples at `heights` (row `row` from column `col` on) to `errors`. `w0` … `w2`: their
/// weights, at least 0 for those `inside`.
template <bool kIsWhole, class Mask>
HWY_INLINE void judge_samples(FacetHeights& facet, WideVec w0, WideVec w1, WideVec w2, Mask inside,
                              const float* heights, double* errors, std::int32_t row, std::int32_t col,
                              Caution& caution) {
  const Wide d;
  const hn::Rebind<float, Wide> df;
  const auto sample = hn::PromoteTo(d, hn::LoadU(df, heights));
  const auto t0 = hn::Mul(w0, hn::Sub(facet.z0, sample));
  const auto t1 = hn::Mul(w1, hn::Sub(facet.z1, sample));
  const auto t2 = hn::Mul(w2, hn::Sub(facet.z2, sample));
  const auto error = hn::Mul(hn::Add(hn::Add(t0, t1), t2), facet.per_area);
  const auto size = hn::Abs(error);
  auto held = hn::LoadU(d, errors);
  const auto held_size = hn::Abs(held);
  auto judged = inside;
  if (!kIsWhole) judged = hn::And(judged, hn::Eq(sample, sample));
  auto taken = hn::And(judged, hn::Or(hn::Not(hn::Le(size, held_size)), hn::Eq(error, held_size)));
  auto risky = hn::And(judged, hn::Ge(size, facet.watch));
  if (HWY_UNLIKELY(!scarp::HWY_NAMESPACE::none_of(d, risky))) {
    const auto zero = hn::Zero(d);
    risky = hn::And(risky, hn::Or(hn::Or(hn::Ne(t0, zero), hn::Ne(t1, zero)), hn::Ne(t2, zero)));
    if (!hn::AllFalse(d, risky)) {
      std::uint8_t lanes[8] = {};
      hn::StoreMaskBits(d, risky, lanes);
      caution.watch = caution.look(caution.judge, row, col, lanes[0]);
      facet.watch = hn::Set(d, caution.watch);
      taken = hn::AndNot(risky, taken);
      held = hn::LoadU(d, errors);
    }
  }
  hn::StoreU(hn::IfThenElse(taken, error, held), d, errors);
}

/// Weights of the given columns in a row.
HWY_INLINE WideVec weights_at(const FacetTask& facet, std::size_t k, WideVec columns, std::int32_t row) {
  const Wide d;
  const double across = facet.dx[k] * (row - facet.y[k]);
  const auto along = hn::Mul(hn::Set(d, facet.dy[k]), hn::Sub(columns, hn::Set(d, facet.x[k])));
  return hn::Sub(hn::Set(d, across), along);
}

HWY_INLINE WideVec columns_from(std::int32_t col) {
  const Wide d;
  return hn::Add(hn::Iota(d, 0), hn::Set(d, static_cast<double>(col)));
}

/// For an exact facet that is at most as wide as a vector, so that a row is one step.
template <bool kIsWhole>
HWY_INLINE void judge_narrow(const FacetTask& facet, const BandRows& band, Caution& caution) {
  const Wide d;
  FacetHeights heights_of(facet, caution);
  const std::int32_t col = facet.left;
  const auto columns = columns_from(col);
  const auto zero = hn::Zero(d);
  const auto in_raster = hn::Le(columns, hn::Set(d, static_cast<double>(facet.right)));
  auto w0 = weights_at(facet, 0, columns, facet.first), w1 = weights_at(facet, 1, columns, facet.first),
       w2 = weights_at(facet, 2, columns, facet.first);
  const auto down_0 = hn::Set(d, facet.dx[0]), down_1 = hn::Set(d, facet.dx[1]), down_2 = hn::Set(d, facet.dx[2]);
  const float* heights = band.heights + std::ptrdiff_t{facet.first - band.first} * band.cols + col;
  double* errors = band.errors + std::ptrdiff_t{facet.first - band.first} * band.stride + col;
  for (std::int32_t row = facet.first; row <= facet.last; ++row) {
    const auto inside = hn::And(in_raster, hn::Ge(hn::Min(hn::Min(w0, w1), w2), zero));
    judge_samples<kIsWhole>(heights_of, w0, w1, w2, inside, heights, errors, row, col, caution);
    w0 = hn::Add(w0, down_0);
    w1 = hn::Add(w1, down_1);
    w2 = hn::Add(w2, down_2);
    heights += band.cols;
    errors += band.stride;
  }
}

/// For an exact facet, whose spans contain exactly its samples. Weights advance by steps. Steps begin at multiples of
/// the number of lanes, so that values just stored by a neighbour can be reloaded at once.
template <bool kIsWhole, bool kHasSpans>
HWY_INLINE void judge_exact_row(const FacetTask& facet, const BandRows& band, std::int32_t row, std::int32_t left,
                                std::int32_t right, FacetHeights& heights_of, Caution& caution) {
  const Wide d;
  const auto lanes = static_cast<std::int32_t>(hn::Lanes(d));
  const std::int32_t start = left & -lanes;
  const auto first = hn::Set(d, static_cast<double>(left)), last = hn::Set(d, static_cast<double>(right));
  const auto step = hn::Set(d, static_cast<double>(lanes));
  auto columns = columns_from(start);
  auto w0 = weights_at(facet, 0, columns, row), w1 = weights_at(facet, 1, columns, row),
       w2 = weights_at(facet, 2, columns, row);
  const auto along_0 = hn::Mul(hn::Set(d, facet.dy[0]), step), along_1 = hn::Mul(hn::Set(d, facet.dy[1]), step),
             along_2 = hn::Mul(hn::Set(d, facet.dy[2]), step);
  const float* heights = band.heights + std::ptrdiff_t{row - band.first} * band.cols;
  double* errors = band.errors + std::ptrdiff_t{row - band.first} * band.stride;
  for (std::int32_t col = start; col <= right; col += lanes) {
    auto inside = hn::And(hn::Ge(columns, first), hn::Le(columns, last));
    if (!kHasSpans) inside = hn::And(inside, hn::Ge(hn::Min(hn::Min(w0, w1), w2), hn::Zero(d)));
    judge_samples<kIsWhole>(heights_of, w0, w1, w2, inside, heights + col, errors + col, row, col, caution);
    columns = hn::Add(columns, step);
    w0 = hn::Sub(w0, along_0);
    w1 = hn::Sub(w1, along_1);
    w2 = hn::Sub(w2, along_2);
  }
}

template <bool kIsWhole>
HWY_INLINE void judge_row(const FacetTask& facet, const BandRows& band, std::int32_t row, std::int32_t left,
                          std::int32_t right, FacetHeights& heights_of, Caution& caution) {
  const Wide d;
  const auto lanes = static_cast<std::int32_t>(hn::Lanes(d));
  const auto last = hn::Set(d, static_cast<double>(right)), least = hn::Set(d, -facet.slack), zero = hn::Zero(d);
  const float* heights = band.heights + std::ptrdiff_t{row - band.first} * band.cols;
  double* errors = band.errors + std::ptrdiff_t{row - band.first} * band.stride;
  for (std::int32_t col = left; col <= right; col += lanes) {
    const auto columns = columns_from(col);
    auto w0 = weights_at(facet, 0, columns, row), w1 = weights_at(facet, 1, columns, row),
         w2 = weights_at(facet, 2, columns, row);
    const auto inside = hn::And(hn::Le(columns, last), hn::Ge(hn::Min(hn::Min(w0, w1), w2), least));
    w0 = hn::IfThenElseZero(hn::Gt(w0, zero), w0);
    w1 = hn::IfThenElseZero(hn::Gt(w1, zero), w1);
    w2 = hn::IfThenElseZero(hn::Gt(w2, zero), w2);
    judge_samples<kIsWhole>(heights_of, w0, w1, w2, inside, heights + col, errors + col, row, col, caution);
  }
}

/// The columns of the rows from facet.first on, in steps of as many rows as a vector has lanes.
HWY_INLINE void find_spans(const FacetTask& facet, std::int32_t* left, std::int32_t* right) {
  const Wide d;
  const hn::Rebind<std::int32_t, Wide> di;
  const auto lanes = static_cast<std::int32_t>(hn::Lanes(d));
  const auto most_left = hn::Set(d, static_cast<double>(facet.left)),
             most_right = hn::Set(d, static_cast<double>(facet.right)), one = hn::Set(d, 1.0);
  const auto margin = hn::Set(d, facet.margin);
  for (std::int32_t row = facet.first; row <= facet.last; row += lanes) {
    const auto rows = columns_from(row);
    auto lo = most_left, hi = most_right;
    for (std::size_t k = 0; k < 3; ++k) {
      if (facet.dy[k] == 0) continue;
      const auto across = hn::Mul(hn::Set(d, facet.dx[k]), hn::Sub(rows, hn::Set(d, facet.y[k])));
      const auto side = hn::Add(hn::Set(d, facet.x[k]), hn::Mul(across, hn::Set(d, facet.per_dy[k])));
      if (facet.dy[k] > 0)
        hi = hn::Min(hi, hn::Add(side, margin));
      else
        lo = hn::Max(lo, hn::Sub(side, margin));
    }
    const auto first = hn::Min(hn::Ceil(lo), hn::Add(most_right, one)),
               last = hn::Max(hn::Floor(hi), hn::Sub(most_left, one));
    hn::StoreU(scarp::HWY_NAMESPACE::whole_parts(di, first), di, left + (row - facet.first));
    hn::StoreU(scarp::HWY_NAMESPACE::whole_parts(di, last), di, right + (row - facet.first));
  }
}

template <bool kIsWhole>
HWY_INLINE void judge_facet_of(const FacetTask& facet, const BandRows& band, Caution& caution) {
  const auto lanes = static_cast<std::int32_t>(hn::Lanes(Wide()));
  if (!facet.has_spans && facet.is_exact && facet.right - facet.left < lanes)
    return judge_narrow<kIsWhole>(facet, band, caution);
  std::int32_t left[kMostBandRows + kKernelPadding], right[kMostBandRows + kKernelPadding];
  if (facet.has_spans) find_spans(facet, left, right);
  FacetHeights heights_of(facet, caution);
  for (std::int32_t row = facet.first; row <= facet.last; ++row) {
    const std::int32_t at = row - facet.first;
    const std::int32_t from = facet.has_spans ? left[at] : facet.left, to = facet.has_spans ? right[at] : facet.right;
    if (facet.is_exact && facet.has_spans)
      judge_exact_row<kIsWhole, true>(facet, band, row, from, to, heights_of, caution);
    else if (facet.is_exact)
      judge_exact_row<kIsWhole, false>(facet, band, row, from, to, heights_of, caution);
    else
      judge_row<kIsWhole>(facet, band, row, from, to, heights_of, caution);
  }
}

void judge_facet(const FacetTask& facet, const BandRows& band, Caution& caution) {
  if (band.is_whole)
    judge_facet_of<true>(facet, band, caution);
  else
    judge_facet_of<false>(facet, band, caution);
}

RowSums sum_row(const double* errors, std::int32_t count, Buckets& buckets) {
  constexpr auto kParts = static_cast<std::int32_t>(kSumParts);
  const Wide d;
  const hn::Rebind<float, Wide> df;
  const hn::RebindToUnsigned<decltype(df)> du;
  constexpr std::int32_t kLanes = static_cast<std::int32_t>(hn::MaxLanes(Wide()));
  constexpr std::int32_t kSteps = kParts / kLanes;
  static_assert(kSteps * kLanes == kParts);
  WideVec error[kSteps], magnitude[kSteps], square[kSteps];
  for (std::int32_t step = 0; step < kSteps; ++step) error[step] = magnitude[step] = square[step] = hn::Zero(d);
  auto largest = hn::Zero(d);
  std::size_t samples = 0;
  std::uint32_t* next = buckets.values;
  for (std::int32_t first = 0; first < count; first += kParts) {
    const std::int32_t rest = count - first;
    for (std::int32_t step = 0; step < kSteps && step * kLanes < rest; ++step) {
      const std::int32_t left = rest - step * kLanes;
      const double* from = errors + first + step * kLanes;
      double tail[kParts];
      if (HWY_UNLIKELY(left < kLanes)) {
        for (std::int32_t i = 0; i < kLanes; ++i)
          tail[i] = i < left ? from[i] : std::numeric_limits<double>::quiet_NaN();
        from = tail;
      }
      const auto all = hn::LoadU(d, from);
      const auto valid = hn::Eq(all, all);
      const auto value = hn::IfThenElseZero(valid, all);
      const auto size = hn::Abs(value);
      samples += hn::CountTrue(d, valid);
      error[step] = hn::Add(error[step], value);
      magnitude[step] = hn::Add(magnitude[step], size);
      square[step] = hn::Add(square[step], hn::Mul(value, value));
      largest = hn::Max(largest, size);
      if (hn::AllFalse(d, hn::Gt(size, hn::Zero(d)))) continue;
      const auto bits = hn::BitCast(du, hn::DemoteTo(df, size));
      hn::StoreU(hn::ShiftRight<kBucketShift>(bits), du, next);
      next += kLanes;
    }
  }
  // Lanes without samples and omitted lanes counted as zeros in the buckets.
  buckets.count = static_cast<std::size_t>(next - buckets.values);
  buckets.zeros = static_cast<std::int64_t>(samples) - static_cast<std::int64_t>(buckets.count);
  RowSums sums;
  sums.samples = samples;
  if (samples == 0) return sums;
  double parts[kParts];
  for (std::int32_t step = 0; step < kSteps; ++step) hn::StoreU(error[step], d, parts + step * kLanes);
  sums.error = sum_of_parts(parts);
  for (std::int32_t step = 0; step < kSteps; ++step) hn::StoreU(magnitude[step], d, parts + step * kLanes);
  sums.magnitude = sum_of_parts(parts);
  for (std::int32_t step = 0; step < kSteps; ++step) hn::StoreU(square[step], d, parts + step * kLanes);
  sums.square = sum_of_parts(parts);
  sums.largest = hn::GetLane(hn::MaxOfLanes(d, largest));
  return sums;
}

RowHeights take_row(const float* from, std::int32_t count, float nodata, float* to) {
  const hn::CappedTag<float, 16> d;
  const auto lanes = static_cast<std::int32_t>(hn::Lanes(d));
  const float infinity = std::numeric_limits<float>::infinity();
  const auto most_finite = hn::Set(d, std::numeric_limits<float>::max()), none = hn::Set(d, nodata),
             missing = hn::Set(d, std::numeric_limits<float>::quiet_NaN());
  auto least = hn::Set(d, infinity), most = hn::Set(d, -infinity);
  std::size_t valid = 0;
  std::int32_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    const auto height = hn::LoadU(d, from + i);
    // A NaN `nodata` equals nothing, and Ne() may also return false for NaN.
    const auto is_height = hn::AndNot(hn::Eq(height, none), hn::Le(hn::Abs(height), most_finite));
    valid += hn::CountTrue(d, is_height);
    if (to != nullptr) hn::StoreU(hn::IfThenElse(is_height, height, missing), d, to + i);
    least = hn::IfThenElse(hn::And(is_height, hn::Lt(height, least)), height, least);
    most = hn::IfThenElse(hn::And(is_height, hn::Gt(height, most)), height, most);
  }
  RowHeights taken{0, hn::GetLane(hn::MinOfLanes(d, least)), hn::GetLane(hn::MaxOfLanes(d, most))};
  for (; i < count; ++i) {
    const float height = from[i], size = height < 0 ? -height : height;
    const bool is_height = size <= std::numeric_limits<float>::max() && height != nodata;
    if (to != nullptr) to[i] = is_height ? height : std::numeric_limits<float>::quiet_NaN();
    if (!is_height) continue;
    ++valid;
    if (height < taken.least) taken.least = height;
    if (height > taken.most) taken.most = height;
  }
  taken.valid = static_cast<std::uint32_t>(valid);
  return taken;
}

const JudgeKernels& kernels() {
  static const JudgeKernels table{hwy::TargetName(HWY_TARGET), judge_facet, sum_row, take_row};
  return table;
}

#else

const JudgeKernels& kernels() {
  static const JudgeKernels table{hwy::TargetName(HWY_TARGET), detail::scalar_judge_kernels().judge_facet,
                                  detail::scalar_judge_kernels().sum_row, detail::scalar_judge_kernels().take_row};
  return table;
}

#endif

}  // namespace scarp::judge::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace scarp::judge::detail {

std::span<const JudgeKernels> vector_judge_kernels() {
  static const std::vector<JudgeKernels> found = [] {
    const std::int64_t supported = hwy::SupportedTargets();
    std::vector<JudgeKernels> kernels;
#define SCARP_INSTRUCTION_SET(target, set) \
  if ((supported & target) != 0) kernels.push_back(set::kernels());
#include "base/each_instruction_set.inc"
    return kernels;
  }();
  return found;
}

}  // namespace scarp::judge::detail

#endif
