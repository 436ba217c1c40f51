// The scan of trial triangles in vectors: this file is compiled once for every instruction set, through Highway.
//
// Eight samples are scanned at a time: as one vector, or as two vectors of four, the second one only if it has samples.
// Between HWY_BEFORE_NAMESPACE and HWY_AFTER_NAMESPACE there must be no lambdas and no standard library functions: they
// would be compiled for one instruction set and linked for all.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "fit/triangle_kernels.h"
#include "fit/triangle_scan.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fit/triangle_kernels_vector.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#include "base/wasm_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace scarp::fit::trial::HWY_NAMESPACE {

#if SCARP_HAVE_FLOAT64 && !HWY_HAVE_SCALABLE

namespace hn = hwy::HWY_NAMESPACE;

using Wide = hn::CappedTag<float, 8>;
using WideInt = hn::RebindToSigned<Wide>;
using Four = hn::CappedTag<float, 4>;
using WideVec = hn::Vec<Wide>;
using FourVec = hn::Vec<Four>;
using scarp::HWY_NAMESPACE::larger_of;
using scarp::HWY_NAMESPACE::magnitudes;
using scarp::HWY_NAMESPACE::none_of;
using scarp::HWY_NAMESPACE::whole_parts;
constexpr std::size_t kWidth = hn::MaxLanes(Wide()), kParts = 8 / kWidth;
static_assert(kWidth * kParts == 8 && hn::MaxLanes(Four()) == 4);

/// Four lanes of a vector.
#if HWY_MAX_BYTES > 16
HWY_INLINE FourVec low_of(WideVec v) { return hn::LowerHalf(Four(), v); }
HWY_INLINE FourVec high_of(WideVec v) { return hn::UpperHalf(Four(), v); }
#endif

HWY_INLINE WideVec all(float value) { return hn::Set(Wide(), value); }

/// Eight sums, in as many vectors as needed.
struct EightSums {
  WideVec part[kParts];

  HWY_INLINE EightSums() {
    for (std::size_t p = 0; p < kParts; ++p) part[p] = hn::Zero(Wide());
  }
  template <std::size_t kPart>
  HWY_INLINE void add_to(WideVec terms) {
    part[kPart] = hn::Add(part[kPart], terms);
  }
};

/// The first four of eight sums plus the others. The order is part of the result.
HWY_INLINE FourVec halves_of(const EightSums& sums) {
#if HWY_MAX_BYTES > 16
  return hn::Add(low_of(sums.part[0]), high_of(sums.part[0]));
#else
  return hn::Add(sums.part[0], sums.part[1]);
#endif
}

HWY_INLINE float sum_of(const EightSums& sums) {
  const auto s = halves_of(sums);
  const auto pairs = hn::Add(s, hn::Shuffle1032(s));
  const float sum = hn::GetLane(hn::Add(pairs, hn::Shuffle2301(pairs)));
  return sum > std::numeric_limits<float>::max() ? std::numeric_limits<float>::max() : sum;
}

HWY_INLINE double exact_sum_of(FourVec sums) {
  float s[4];
  hn::StoreU(sums, Four(), s);
  return (double{s[0]} + s[2]) + (double{s[1]} + s[3]);
}

/// Sums in four parts. The first four of eight samples are added before the others.
struct FourSums {
  FourVec sums;

  HWY_INLINE FourSums() : sums(hn::Zero(Four())) {}
  HWY_INLINE void add(WideVec terms) {
#if HWY_MAX_BYTES > 16
    sums = hn::Add(hn::Add(sums, low_of(terms)), high_of(terms));
#else
    sums = hn::Add(sums, terms);
#endif
  }
};

/// Calls take.row(y, first, last) for each row with samples, top down, until it returns false. True if it never did.
/// The arithmetic is that of each_row(), for several rows at once.
template <class Take>
HWY_INLINE bool each_span(const TriangleTask& task, Take& take) {
  using Rows = hn::CappedTag<double, 4>;
  constexpr std::int32_t kAtOnce = 4, kLanesOfRows = static_cast<std::int32_t>(hn::MaxLanes(Rows()));
  const Rows d;
  const hn::Rebind<std::int32_t, Rows> di;
  const TriangleTask::Place top = task.top, middle = task.middle, bottom = task.bottom;
  const auto along = hn::Set(d, (bottom.x - top.x) / (bottom.y - top.y));
  const auto upper = hn::Set(d, middle.y > top.y ? (middle.x - top.x) / (middle.y - top.y) : 0);
  const auto lower = hn::Set(d, bottom.y > middle.y ? (bottom.x - middle.x) / (bottom.y - middle.y) : 0);
  const auto top_x = hn::Set(d, top.x), top_y = hn::Set(d, top.y), middle_x = hn::Set(d, middle.x),
             middle_y = hn::Set(d, middle.y);
  const auto before_sample = hn::Set(d, 1 - kOnSample), on_sample = hn::Set(d, kOnSample);
  const std::int32_t begin = whole_part(__builtin_ceil(top.y)), end = whole_part(bottom.y);
  for (std::int32_t y = begin; y <= end; y += kAtOnce) {
    std::int32_t first[kAtOnce], last[kAtOnce];
    for (std::int32_t i = 0; i < kAtOnce; i += kLanesOfRows) {
      const auto ys = hn::Add(hn::Set(d, static_cast<double>(y + i)), hn::Iota(d, 0));
      const auto down = hn::Sub(ys, top_y);
      const auto from = hn::Add(top_x, hn::Mul(down, along));
      const auto above = hn::Add(top_x, hn::Mul(down, upper));
      const auto below = hn::Add(middle_x, hn::Mul(hn::Sub(ys, middle_y), lower));
      const auto to = hn::IfThenElse(hn::Lt(ys, middle_y), above, below);
      hn::StoreU(whole_parts(di, hn::Add(hn::Min(from, to), before_sample)), di, first + i);
      hn::StoreU(whole_parts(di, hn::Add(hn::Max(from, to), on_sample)), di, last + i);
    }
    const std::int32_t count = end - y + 1 < kAtOnce ? end - y + 1 : kAtOnce;
    for (std::int32_t i = 0; i < count; ++i) {
      if (first[i] <= last[i] && !take.row(y + i, first[i], last[i])) return false;
    }
  }
  return true;
}

/// The values that are the same for all samples of a triangle.
struct RowScan {
  const SampleRows rows;
  const float base_x, base_y, slope_y;
  WideVec slope, height, columns[kParts];
  hn::Vec<WideInt> numbers[kParts];

  HWY_INLINE RowScan(const TriangleTask& task, const SampleRows& of)
      : rows(of),
        base_x(task.base_x),
        base_y(task.base_y),
        slope_y(task.plane.slope_y),
        slope(all(task.plane.slope_x)),
        height(all(task.plane.height)) {
    for (std::size_t p = 0; p < kParts; ++p) {
      columns[p] = hn::Iota(Wide(), static_cast<float>(p * kWidth));
      numbers[p] = hn::Iota(WideInt(), static_cast<std::int32_t>(p * kWidth));
    }
  }

  /// Calls take.samples<part>(down, offsets, errors, meant) for each vector of samples. `part`: its index among the
  /// vectors of eight samples. `meant`: its mask. Errors of nodata are NaN.
  template <class Take>
  HWY_INLINE void each_vector(std::int32_t y, std::int32_t first, std::int32_t last, Take& take) const {
    const float down = static_cast<float>(y) - base_y;
    const auto row_height = all(slope_y * down);
    const float* const samples = rows.first + y * rows.stride;
    for (std::int32_t x = first; x <= last; x += 8) {
      const float* from = samples + x;
      float copy[8] = {};
      if (HWY_UNLIKELY(rows.end - from < 8)) {
        for (std::ptrdiff_t i = 0; i < rows.end - from; ++i) copy[i] = from[i];
        from = copy;
      }
      const auto offset = all(static_cast<float>(x) - base_x);
      const auto count = hn::Set(WideInt(), last - x + 1);
      take_part<0>(down, row_height, offset, from, count, take);
      // Adding zeros changes no sum.
      if constexpr (kParts == 2) {
        if (last - x >= static_cast<std::int32_t>(kWidth)) take_part<1>(down, row_height, offset, from, count, take);
      }
    }
  }

 private:
  template <std::size_t kPart, class Take>
  HWY_INLINE void take_part(float down, WideVec row_height, WideVec offset, const float* from, hn::Vec<WideInt> count,
                            Take& take) const {
    const auto offsets = hn::Add(offset, columns[kPart]);
    const auto sample = hn::LoadU(Wide(), from + kPart * kWidth);
    const auto errors = hn::Sub(hn::Add(hn::Mul(slope, offsets), row_height), hn::Sub(sample, height));
    const auto meant = hn::Lt(numbers[kPart], count);
    take.template samples<kPart>(down, offsets, errors, hn::RebindMask(Wide(), meant));
  }
};

struct SquareSums : EightSums {
  HWY_INLINE SquareSums() {}
  template <std::size_t kPart>
  HWY_INLINE void add(WideVec error, float) {
    add_to<kPart>(hn::Mul(error, error));
  }
  HWY_INLINE float energy(float per_square) const { return sum_of(*this) * per_square; }
};

struct EighthSums : EightSums {
  HWY_INLINE EighthSums() {}
  template <std::size_t kPart>
  HWY_INLINE void add(WideVec error, float per_square) {
    const auto square = hn::Mul(hn::Mul(error, error), all(per_square)), fourth = hn::Mul(square, square);
    add_to<kPart>(hn::Mul(fourth, fourth));
  }
  HWY_INLINE float energy(float) const { return sum_of(*this); }
};

template <class Sums>
struct Assessment {
  RowScan scan;
  ErrorLimits limits;
  Sums sums;
  WideVec worst;
  TriangleSums result;
  int rows = 0;

  HWY_INLINE Assessment(const TriangleTask& task, const SampleRows& samples, const ErrorLimits& wanted)
      : scan(task, samples), limits(wanted), worst(hn::Zero(Wide())) {}

  template <std::size_t kPart>
  HWY_INLINE void samples(float, WideVec, WideVec errors, hn::Mask<Wide> meant) {
    const auto size = magnitudes(errors, meant);
    worst = larger_of(worst, size);
    sums.template add<kPart>(size, limits.per_square);
  }
  HWY_INLINE bool row(std::int32_t y, std::int32_t first, std::int32_t last) {
    scan.each_vector(y, first, last, *this);
    if (!none_of(Wide(), hn::Gt(worst, all(limits.cut)))) {
      result.kind = TriangleError::Verdict::Kind::kBreaks;
      result.y = y;
      result.first = first;
      result.last = last;
      return false;
    }
    if (++rows % kRowsPerLook == 0 && sums.energy(limits.per_square) >= limits.energy) {
      result.kind = TriangleError::Verdict::Kind::kCostly;
      return false;
    }
    return true;
  }
};

template <class Sums>
TriangleSums assess(const TriangleTask& task, const SampleRows& rows, const ErrorLimits& limits) {
  Assessment<Sums> assessment(task, rows, limits);
  if (!each_span(task, assessment)) return assessment.result;
  TriangleSums result;
  result.worst = hn::GetLane(hn::MaxOfLanes(Wide(), assessment.worst));
  result.energy = assessment.sums.energy(limits.per_square);
  if (result.energy >= limits.energy) result.kind = TriangleError::Verdict::Kind::kCostly;
  return result;
}

/// Calls asks.add<part>(t, λ) for each vector of samples: errors in thresholds, and their change per unit rise of the
/// first corner; both are 0 where masked.
template <class Asks>
struct Residuals {
  RowScan scan;
  CornerWeight weight;
  Asks asks;

  HWY_INLINE Residuals(const TriangleTask& task, const SampleRows& samples, const CornerWeight& of, const Asks& begin)
      : scan(task, samples), weight(of), asks(begin) {}

  template <std::size_t kPart>
  HWY_INLINE void samples(float down, WideVec offsets, WideVec errors, hn::Mask<Wide> meant) {
    const auto share = hn::Add(all(1 + weight.slope_y * down), hn::Mul(all(weight.slope_x), offsets));
    const auto counts = hn::And(meant, hn::Eq(errors, errors));
    asks.template add<kPart>(hn::Mul(hn::IfThenElseZero(counts, errors), all(weight.per_threshold)),
                             hn::IfThenElseZero(counts, share));
  }
  HWY_INLINE bool row(std::int32_t y, std::int32_t first, std::int32_t last) {
    scan.each_vector(y, first, last, *this);
    return true;
  }
};

template <class Asks>
HWY_INLINE Asks ask(const TriangleTask& task, const SampleRows& rows, const CornerWeight& weight, const Asks& begin) {
  Residuals<Asks> residuals(task, rows, weight, begin);
  each_span(task, residuals);
  return residuals.asks;
}

struct SquarePull {
  FourSums stiffness, push;

  HWY_INLINE SquarePull() {}
  template <std::size_t>
  HWY_INLINE void add(WideVec t, WideVec share) {
    stiffness.add(hn::Mul(share, share));
    push.add(hn::Mul(share, t));
  }
};

struct EighthPull {
  FourSums stiffness, push;

  HWY_INLINE EighthPull() {}
  template <std::size_t>
  HWY_INLINE void add(WideVec t, WideVec share) {
    const auto t2 = hn::Mul(t, t), weighed = hn::Mul(hn::Mul(hn::Mul(t2, t2), t2), share);
    stiffness.add(hn::Mul(weighed, share));
    push.add(hn::Mul(weighed, t));
  }
};

template <class Asks>
CornerPull pull(const TriangleTask& task, const SampleRows& rows, const CornerWeight& weight) {
  const Asks asked = ask(task, rows, weight, Asks());
  return {exact_sum_of(asked.stiffness.sums), exact_sum_of(asked.push.sums)};
}

struct SquareMoments {
  EightSums sums[3];

  HWY_INLINE SquareMoments() {}
  template <std::size_t kPart>
  HWY_INLINE void add(WideVec t, WideVec share) {
    sums[0].add_to<kPart>(hn::Mul(t, t));
    sums[1].add_to<kPart>(hn::Mul(t, share));
    sums[2].add_to<kPart>(hn::Mul(share, share));
  }
};

struct EighthMoments {
  EightSums sums[9];

  HWY_INLINE EighthMoments() {}
  template <std::size_t kPart>
  HWY_INLINE void add(WideVec t, WideVec share) {
    const auto t2 = hn::Mul(t, t), t4 = hn::Mul(t2, t2), share2 = hn::Mul(share, share),
               share4 = hn::Mul(share2, share2), both = hn::Mul(t, share);
    sums[0].add_to<kPart>(hn::Mul(t4, t4));
    sums[1].add_to<kPart>(hn::Mul(hn::Mul(t4, t2), both));
    sums[2].add_to<kPart>(hn::Mul(hn::Mul(t4, t2), share2));
    sums[3].add_to<kPart>(hn::Mul(hn::Mul(t4, both), share2));
    sums[4].add_to<kPart>(hn::Mul(t4, share4));
    sums[5].add_to<kPart>(hn::Mul(hn::Mul(t2, both), share4));
    sums[6].add_to<kPart>(hn::Mul(hn::Mul(t2, share4), share2));
    sums[7].add_to<kPart>(hn::Mul(hn::Mul(both, share4), share2));
    sums[8].add_to<kPart>(hn::Mul(share4, share4));
  }
};

template <class Asks>
void add_moments(const TriangleTask& task, const SampleRows& rows, const CornerWeight& weight,
                 TriangleError::Moments& moments) {
  const Asks asked = ask(task, rows, weight, Asks());
  for (std::size_t k = 0; k < sizeof asked.sums / sizeof asked.sums[0]; ++k)
    moments[k] += exact_sum_of(halves_of(asked.sums[k]));
}

struct RoomLeft {
  WideVec lowest, highest;

  template <std::size_t>
  HWY_INLINE void add(WideVec t, WideVec share) {
    const auto one = all(1);
    const auto weighs = hn::Gt(share, all(kLeastShare));
    const auto down = hn::Div(hn::Sub(hn::Neg(one), t), share), up = hn::Div(hn::Sub(one, t), share);
    lowest = hn::IfThenElse(hn::And(weighs, hn::Gt(down, lowest)), down, lowest);
    highest = hn::IfThenElse(hn::And(weighs, hn::Lt(up, highest)), up, highest);
  }
};

void narrow(const TriangleTask& task, const SampleRows& rows, const CornerWeight& weight, TriangleError::Room& room) {
  const RoomLeft left = ask(task, rows, weight, RoomLeft{all(room.lowest), all(room.highest)});
  room.lowest = hn::GetLane(hn::MaxOfLanes(Wide(), left.lowest));
  room.highest = hn::GetLane(hn::MinOfLanes(Wide(), left.highest));
}

const TriangleKernels& kernels() {
  static const TriangleKernels table{hwy::TargetName(HWY_TARGET),
                                     {assess<SquareSums>, assess<EighthSums>},
                                     {pull<SquarePull>, pull<EighthPull>},
                                     {add_moments<SquareMoments>, add_moments<EighthMoments>},
                                     narrow};
  return table;
}

#else

const TriangleKernels& kernels() {
  static const TriangleKernels table = [] {
    TriangleKernels plain = plain_triangle_kernels();
    plain.name = hwy::TargetName(HWY_TARGET);
    return plain;
  }();
  return table;
}

#endif

}  // namespace scarp::fit::trial::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace scarp::fit::trial {

std::span<const TriangleKernels> vector_triangle_kernels() {
  static const std::vector<TriangleKernels> found = [] {
    const std::int64_t supported = hwy::SupportedTargets();
    std::vector<TriangleKernels> kernels;
#define SCARP_INSTRUCTION_SET(target, set) \
  if ((supported & target) != 0) kernels.push_back(set::kernels());
#include "base/each_instruction_set.inc"
    return kernels;
  }();
  return found;
}

}  // namespace scarp::fit::trial

#endif
