// The scan of trial triangles in vectors: this file is compiled once for every instruction set, through Highway.
//
// Eight samples at a time: one vector, or two of four. No lambdas and no functions of the standard library between
// HWY_BEFORE_NAMESPACE and HWY_AFTER_NAMESPACE: they would be compiled for one instruction set and linked for all.

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

HWY_BEFORE_NAMESPACE();
namespace scarp::trial::HWY_NAMESPACE {

#if HWY_HAVE_FLOAT64 && !HWY_HAVE_SCALABLE

namespace hn = hwy::HWY_NAMESPACE;

using Wide = hn::CappedTag<float, 8>;
using WideInt = hn::RebindToSigned<Wide>;
using Four = hn::CappedTag<float, 4>;
using WideVec = hn::Vec<Wide>;
using FourVec = hn::Vec<Four>;
constexpr std::size_t kWidth = hn::MaxLanes(Wide()), kParts = 8 / kWidth;
static_assert(kWidth * kParts == 8 && hn::MaxLanes(Four()) == 4);

/// Eight floats.
struct Eight {
  WideVec part[kParts];
};

HWY_INLINE Eight eight_of(float value) {
  Eight eight;
  for (std::size_t p = 0; p < kParts; ++p) eight.part[p] = hn::Set(Wide(), value);
  return eight;
}
HWY_INLINE Eight operator+(const Eight& a, const Eight& b) {
  Eight eight;
  for (std::size_t p = 0; p < kParts; ++p) eight.part[p] = hn::Add(a.part[p], b.part[p]);
  return eight;
}
HWY_INLINE Eight operator-(const Eight& a, const Eight& b) {
  Eight eight;
  for (std::size_t p = 0; p < kParts; ++p) eight.part[p] = hn::Sub(a.part[p], b.part[p]);
  return eight;
}
HWY_INLINE Eight operator*(const Eight& a, const Eight& b) {
  Eight eight;
  for (std::size_t p = 0; p < kParts; ++p) eight.part[p] = hn::Mul(a.part[p], b.part[p]);
  return eight;
}

/// The first four and the others.
#if HWY_MAX_BYTES > 16
HWY_INLINE FourVec low_of(const Eight& eight) { return hn::LowerHalf(Four(), eight.part[0]); }
HWY_INLINE FourVec high_of(const Eight& eight) { return hn::UpperHalf(Four(), eight.part[0]); }
#else
HWY_INLINE FourVec low_of(const Eight& eight) { return eight.part[0]; }
HWY_INLINE FourVec high_of(const Eight& eight) { return eight.part[1]; }
#endif

/// Adds up eight sums, in an order that is part of the result.
HWY_INLINE float sum_of(const Eight& sums) {
  const auto s = hn::Add(low_of(sums), high_of(sums));
  const auto pairs = hn::Add(s, hn::Shuffle1032(s));
  const float sum = hn::GetLane(hn::Add(pairs, hn::Shuffle2301(pairs)));
  return sum > std::numeric_limits<float>::max() ? std::numeric_limits<float>::max() : sum;
}

/// Sums in four parts, to each of which the first four of eight samples are added before the others.
struct FourSums {
  FourVec sums;

  HWY_INLINE FourSums() : sums(hn::Zero(Four())) {}
  HWY_INLINE void add(const Eight& terms) { sums = hn::Add(hn::Add(sums, low_of(terms)), high_of(terms)); }
  HWY_INLINE double total() const {
    float s[4];
    hn::StoreU(sums, Four(), s);
    return (double{s[0]} + s[2]) + (double{s[1]} + s[3]);
  }
};

/// Calls take.row(y, first, last) for each row with samples, top down, until it answers false; whether it never did.
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
  const auto begin = static_cast<std::int32_t>(__builtin_ceil(top.y)), end = static_cast<std::int32_t>(bottom.y);
  for (std::int32_t y = begin; y <= end; y += kAtOnce) {
    std::int32_t first[kAtOnce], last[kAtOnce];
    for (std::int32_t i = 0; i < kAtOnce; i += kLanesOfRows) {
      const auto ys = hn::Add(hn::Set(d, static_cast<double>(y + i)), hn::Iota(d, 0));
      const auto down = hn::Sub(ys, top_y);
      const auto from = hn::Add(top_x, hn::Mul(down, along));
      const auto above = hn::Add(top_x, hn::Mul(down, upper));
      const auto below = hn::Add(middle_x, hn::Mul(hn::Sub(ys, middle_y), lower));
      const auto to = hn::IfThenElse(hn::Lt(ys, middle_y), above, below);
      hn::StoreU(hn::DemoteTo(di, hn::Add(hn::Min(from, to), before_sample)), di, first + i);
      hn::StoreU(hn::DemoteTo(di, hn::Add(hn::Max(from, to), on_sample)), di, last + i);
    }
    const std::int32_t count = end - y + 1 < kAtOnce ? end - y + 1 : kAtOnce;
    for (std::int32_t i = 0; i < count; ++i) {
      if (first[i] <= last[i] && !take.row(y + i, first[i], last[i])) return false;
    }
  }
  return true;
}

/// What is the same for all samples of a triangle.
struct EightScan {
  const SampleRows rows;
  const float base_x, base_y, slope_y;
  Eight slope, height, columns;
  hn::Vec<WideInt> numbers[kParts];

  HWY_INLINE EightScan(const TriangleTask& task, const SampleRows& of)
      : rows(of),
        base_x(task.base_x),
        base_y(task.base_y),
        slope_y(task.plane.slope_y),
        slope(eight_of(task.plane.slope_x)),
        height(eight_of(task.plane.height)) {
    for (std::size_t p = 0; p < kParts; ++p) {
      columns.part[p] = hn::Iota(Wide(), static_cast<float>(p * kWidth));
      numbers[p] = hn::Iota(WideInt(), static_cast<std::int32_t>(p * kWidth));
    }
  }

  HWY_INLINE const float* row(std::int32_t y) const { return rows.first + y * rows.stride; }
  /// Calls take.eight(row, offsets, errors, meant) for each eight samples: which samples are meant and no nodata.
  template <class Take>
  HWY_INLINE void each_eight(std::int32_t y, std::int32_t first, std::int32_t last, Take& take) const {
    const float down = static_cast<float>(y) - base_y;
    const Eight row_height = eight_of(slope_y * down);
    const float* const samples = row(y);
    for (std::int32_t x = first; x <= last; x += 8) {
      const float* from = samples + x;
      float copy[8] = {};
      if (HWY_UNLIKELY(rows.end - from < 8)) {
        for (std::ptrdiff_t i = 0; i < rows.end - from; ++i) copy[i] = from[i];
        from = copy;
      }
      const Eight offsets = eight_of(static_cast<float>(x) - base_x) + columns;
      Eight sample;
      for (std::size_t p = 0; p < kParts; ++p) sample.part[p] = hn::LoadU(Wide(), from + p * kWidth);
      const Eight errors = (slope * offsets + row_height) - (sample - height);
      const auto count = hn::Set(WideInt(), last - x + 1);
      hn::Mask<Wide> meant[kParts];
      for (std::size_t p = 0; p < kParts; ++p)
        meant[p] = hn::And(hn::RebindMask(Wide(), hn::Lt(numbers[p], count)), hn::Eq(errors.part[p], errors.part[p]));
      take.eight(down, offsets, errors, meant);
    }
  }
};

struct SquareSums {
  Eight sums;

  HWY_INLINE SquareSums() : sums(eight_of(0)) {}
  HWY_INLINE void add(const Eight& error, float) { sums = sums + error * error; }
  HWY_INLINE float energy(float per_square) const { return sum_of(sums) * per_square; }
};

struct EighthSums {
  Eight sums;

  HWY_INLINE EighthSums() : sums(eight_of(0)) {}
  HWY_INLINE void add(const Eight& error, float per_square) {
    const Eight square = error * error * eight_of(per_square), fourth = square * square;
    sums = sums + fourth * fourth;
  }
  HWY_INLINE float energy(float) const { return sum_of(sums); }
};

template <class Sums>
struct Assessment {
  EightScan scan;
  ErrorLimits limits;
  Sums sums;
  WideVec worst;
  TriangleSums result;
  int rows = 0;

  HWY_INLINE Assessment(const TriangleTask& task, const SampleRows& samples, const ErrorLimits& wanted)
      : scan(task, samples), limits(wanted), worst(hn::Zero(Wide())) {}

  HWY_INLINE void eight(float, const Eight&, const Eight& errors, const hn::Mask<Wide>* meant) {
    Eight size;
    for (std::size_t p = 0; p < kParts; ++p) {
      size.part[p] = hn::IfThenElseZero(meant[p], hn::Abs(errors.part[p]));
      worst = hn::Max(worst, size.part[p]);
    }
    sums.add(size, limits.per_square);
  }
  HWY_INLINE bool row(std::int32_t y, std::int32_t first, std::int32_t last) {
    scan.each_eight(y, first, last, *this);
    if (!hn::AllFalse(Wide(), hn::Gt(worst, hn::Set(Wide(), limits.cut)))) {
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

/// Calls asks.add(t, λ) for each eight samples: errors in thresholds, and what a unit's rise of the first corner adds
/// to them; both 0 where none is meant.
template <class Asks>
struct Residuals {
  EightScan scan;
  CornerWeight weight;
  Asks asks;

  HWY_INLINE Residuals(const TriangleTask& task, const SampleRows& samples, const CornerWeight& of, const Asks& begin)
      : scan(task, samples), weight(of), asks(begin) {}

  HWY_INLINE void eight(float down, const Eight& offsets, const Eight& errors, const hn::Mask<Wide>* meant) {
    Eight share = eight_of(1 + weight.slope_y * down) + eight_of(weight.slope_x) * offsets, t;
    for (std::size_t p = 0; p < kParts; ++p) {
      t.part[p] = hn::IfThenElseZero(meant[p], errors.part[p]);
      share.part[p] = hn::IfThenElseZero(meant[p], share.part[p]);
    }
    asks.add(t * eight_of(weight.per_threshold), share);
  }
  HWY_INLINE bool row(std::int32_t y, std::int32_t first, std::int32_t last) {
    scan.each_eight(y, first, last, *this);
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
  HWY_INLINE void add(const Eight& t, const Eight& share) {
    stiffness.add(share * share);
    push.add(share * t);
  }
};

struct EighthPull {
  FourSums stiffness, push;

  HWY_INLINE EighthPull() {}
  HWY_INLINE void add(const Eight& t, const Eight& share) {
    const Eight t2 = t * t, weighed = t2 * t2 * t2 * share;
    stiffness.add(weighed * share);
    push.add(weighed * t);
  }
};

template <class Asks>
CornerPull pull(const TriangleTask& task, const SampleRows& rows, const CornerWeight& weight) {
  const Asks asked = ask(task, rows, weight, Asks());
  return {asked.stiffness.total(), asked.push.total()};
}

struct SquareMoments {
  FourSums sums[3];

  HWY_INLINE SquareMoments() {}
  HWY_INLINE void add(const Eight& t, const Eight& share) {
    sums[0].add(t * t);
    sums[1].add(t * share);
    sums[2].add(share * share);
  }
};

struct EighthMoments {
  FourSums sums[9];

  HWY_INLINE EighthMoments() {}
  HWY_INLINE void add(const Eight& t, const Eight& share) {
    const Eight t2 = t * t, t4 = t2 * t2, share2 = share * share, share4 = share2 * share2, both = t * share;
    sums[0].add(t4 * t4);
    sums[1].add(t4 * t2 * both);
    sums[2].add(t4 * t2 * share2);
    sums[3].add(t4 * both * share2);
    sums[4].add(t4 * share4);
    sums[5].add(t2 * both * share4);
    sums[6].add(t2 * share4 * share2);
    sums[7].add(both * share4 * share2);
    sums[8].add(share4 * share4);
  }
};

template <class Asks>
void add_moments(const TriangleTask& task, const SampleRows& rows, const CornerWeight& weight,
                 TriangleError::Moments& moments) {
  const Asks asked = ask(task, rows, weight, Asks());
  for (std::size_t k = 0; k < sizeof asked.sums / sizeof asked.sums[0]; ++k) moments[k] += asked.sums[k].total();
}

struct RoomLeft {
  WideVec lowest, highest;

  HWY_INLINE void add(const Eight& t, const Eight& share) {
    const Wide d;
    const auto one = hn::Set(d, 1.0f), least = hn::Set(d, kLeastShare);
    for (std::size_t p = 0; p < kParts; ++p) {
      const auto weighs = hn::Gt(share.part[p], least);
      const auto down = hn::Div(hn::Sub(hn::Neg(one), t.part[p]), share.part[p]),
                 up = hn::Div(hn::Sub(one, t.part[p]), share.part[p]);
      lowest = hn::IfThenElse(hn::And(weighs, hn::Gt(down, lowest)), down, lowest);
      highest = hn::IfThenElse(hn::And(weighs, hn::Lt(up, highest)), up, highest);
    }
  }
};

void narrow(const TriangleTask& task, const SampleRows& rows, const CornerWeight& weight, TriangleError::Room& room) {
  const RoomLeft left = ask(task, rows, weight, RoomLeft{hn::Set(Wide(), room.lowest), hn::Set(Wide(), room.highest)});
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

}  // namespace scarp::trial::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace scarp::trial {

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

}  // namespace scarp::trial

#endif
