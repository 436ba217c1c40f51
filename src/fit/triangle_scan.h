// The rows of one triangle, eight samples at a time, for all functions of its errors. Only for the files triangle_*.cpp
// and norm_scan.h.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "fit/triangle_error.h"
#include "geom/scan_kernels.h"

namespace scarp::fit {

// Rows are scanned eight samples at a time, as two vectors of four, a width that every machine has. The order of the
// sums is part of the result.
using Floats = float __attribute__((vector_size(16)));
using Masks = std::int32_t __attribute__((vector_size(16)));
using Words = std::int64_t __attribute__((vector_size(16)));
inline constexpr std::int32_t kLanes = 8;

inline Floats load(const float* from) {
  Floats four;
  std::memcpy(&four, from, sizeof four);
  return four;
}
inline Floats all(float value) { return Floats{value, value, value, value}; }
inline Floats larger_of(Floats a, Floats b) { return a > b ? a : b; }
inline bool any(Masks mask) {
  const auto words = reinterpret_cast<Words>(mask);
  return (words[0] | words[1]) != 0;
}

/// Four values; 0 where masked.
inline Floats kept(Floats values, Masks meant) {
  return reinterpret_cast<Floats>(reinterpret_cast<Masks>(values) & meant);
}
/// Magnitudes of four errors; 0 where masked or nodata, since NaN is not equal to itself.
inline Floats magnitudes(Floats errors, Masks meant) {
  constexpr std::int32_t kAllButSign = 0x7fffffff;
  return kept(errors, meant & (errors == errors) & Masks{kAllButSign, kAllButSign, kAllButSign, kAllButSign});
}

/// Eight samples of a row, or their bounds, from `samples` on.
struct RowSamples {
  std::array<float, kLanes> copy;
  const float* from;
  RowSamples(const float* samples, const float* end) : from(samples) {
    if (end - samples >= kLanes) return;
    copy.fill(0);
    std::copy(samples, end, copy.begin());
    from = copy.data();
  }
};

/// The computed crossing of an edge with a row has an error of less than 2⁻³⁵. The exact crossing is an integer or at
/// least 2⁻³² away from one: it is a multiple of 1/(256·rows) for fewer than kMaxFitSteps rows of the lattice.
inline constexpr double kOnSample = 0x1p-34;

/// A triangle ready to be scanned: corners from top to bottom in samples, and its plane.
struct TriangleTask {
  struct Place {
    double x, y;
  };
  std::array<FitCorner, 3> corners;
  Place top, middle, bottom;
  float base_x, base_y;
  geom::ScanPlane plane;
  float doubt, certain;  // computed errors up to `doubt` are within the threshold, those above `certain` break it
  float cut;             // computed errors above it break the limit

  [[gnu::always_inline]] TriangleTask(const FitCorner& a, const FitCorner& b, const FitCorner& c, double threshold,
                                      double limit)
      : corners{a, b, c} {
    constexpr double kStep = 1.0 / grid::kLatticeSteps;
    const Place pa{a.x * kStep, a.y * kStep}, pb{b.x * kStep, b.y * kStep}, pc{c.x * kStep, c.y * kStep};
    // Without branches, since those of swaps are unpredictable. Two of the eight outcomes are impossible.
    constexpr std::array<std::array<std::uint8_t, 3>, 8> kOrders{
        {{0, 1, 2}, {1, 0, 2}, {0, 1, 2}, {1, 2, 0}, {0, 2, 1}, {0, 1, 2}, {2, 0, 1}, {2, 1, 0}}};
    const std::array<double, 3> xs{pa.x, pb.x, pc.x}, ys{pa.y, pb.y, pc.y};
    const auto& [first, second, third] =
        kOrders[unsigned{b.y < a.y} | unsigned{c.y < a.y} << 1 | unsigned{c.y < b.y} << 2];
    top = {xs[first], ys[first]};
    middle = {xs[second], ys[second]};
    bottom = {xs[third], ys[third]};
    base_x = static_cast<float>(pa.x);
    base_y = static_cast<float>(pa.y);
    plane = geom::ScanPlane::spanned(
        a.z, {pb.x - pa.x, pb.y - pa.y, pc.x - pa.x, pc.y - pa.y, double{b.z} - double{a.z}, double{c.z} - double{a.z}},
        limit);
    doubt = geom::scan_floor(threshold, plane.guard);
    certain = static_cast<float>(threshold + double{plane.guard});
    cut = static_cast<float>(limit + double{plane.guard});
  }

  float row_height(std::int32_t y) const { return plane.slope_y * (static_cast<float>(y) - base_y); }
  float error(std::int32_t x, float row, float sample) const {
    return std::abs((plane.slope_x * (static_cast<float>(x) - base_x) + row) - (sample - plane.height));
  }
};

/// Calls row(y, first, last) for each row with samples, top down, until row() returns false. True if it never did.
template <class Row>
bool each_row(const TriangleTask& task, const Row& row) {
  const TriangleTask::Place top = task.top, middle = task.middle, bottom = task.bottom;
  const double along = (bottom.x - top.x) / (bottom.y - top.y);
  const double upper = middle.y > top.y ? (middle.x - top.x) / (middle.y - top.y) : 0;
  const double lower = bottom.y > middle.y ? (bottom.x - middle.x) / (bottom.y - middle.y) : 0;
  for (double y = std::ceil(top.y); y <= bottom.y; ++y) {
    const double from = top.x + (y - top.y) * along;
    const double to = y < middle.y ? top.x + (y - top.y) * upper : middle.x + (y - middle.y) * lower;
    const auto first = static_cast<std::int32_t>(std::min(from, to) + (1 - kOnSample));
    const auto last = static_cast<std::int32_t>(std::max(from, to) + kOnSample);
    if (first <= last && !row(static_cast<std::int32_t>(y), first, last)) return false;
  }
  return true;
}

inline constexpr int kRowsPerLook = 4;  ///< rows between checks of the energy

/// The state of a scan through the rows of a triangle.
struct TriangleScan {
  const TriangleTask& task;
  const float* end;
  Floats slope, height;
  int rows = 0;

  TriangleScan(const TriangleTask& of, const float* samples_end)
      : task(of), end(samples_end), slope(all(of.plane.slope_x)), height(all(of.plane.height)) {}

  /// Calls visit(x, left, low, low_meant, high, high_meant) for each group of eight samples. `x`: column of the first.
  /// `left`: offsets of the first four from the base. `low`, `high`: errors, with their masks. `samples`: the row, from
  /// its first sample in the window.
  template <class Visit>
  void each_eight(const float* samples, std::int32_t y, std::int32_t first, std::int32_t last, const Visit& visit) {
    const Floats row = all(task.row_height(y));
    for (std::int32_t x = first; x <= last; x += kLanes) {
      const RowSamples eight(samples + x, end);
      const float offset = static_cast<float>(x) - task.base_x;
      const Floats left = all(offset) + Floats{0, 1, 2, 3}, right = all(offset) + Floats{4, 5, 6, 7};
      const std::int32_t count = last - x + 1;
      const Masks counts{count, count, count, count};
      const Floats low = (slope * left + row) - (load(eight.from) - height);
      const Floats high = (slope * right + row) - (load(eight.from + 4) - height);
      visit(x, left, low, Masks{0, 1, 2, 3} < counts, high, Masks{4, 5, 6, 7} < counts);
    }
    ++rows;
  }
  bool is_time_to_look() const { return rows % kRowsPerLook == 0; }
};

/// Bounds of eight samples; infinite where masked.
struct EightBounds {
  Floats low, high;

  EightBounds(const float* bounds, const float* end, Masks low_meant, Masks high_meant) {
    const RowSamples eight(bounds, end);
    const Floats none = all(std::numeric_limits<float>::infinity());
    low = low_meant ? load(eight.from) : none;
    high = high_meant ? load(eight.from + 4) : none;
  }
};

/// Bounds up to this have no energy; least_bound() is the limit for one triangle.
inline constexpr float kLeastBound = 0x1p-60f;
inline float least_bound(const TriangleTask& task) { return std::max(kLeastBound, task.plane.guard); }

/// Values divided by bounds; 0 where the bounds are too small.
inline Floats per_bound(Floats values, Floats bounds, Floats least) { return kept(values / bounds, bounds > least); }

}  // namespace scarp::fit
