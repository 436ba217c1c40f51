// The rows of one triangle over several fields, eight samples at a time. Only for norm_error.cpp and norm_pull.cpp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "fit/norm_error.h"
#include "fit/triangle_scan.h"

namespace scarp::fit {

/// The form in which norms are summed and compared: the square if the norm is a root of squares, else the norm itself.
template <Norm kNorm>
Floats measure_of(Floats norm) {
  return kNorm == Norm::kSquares ? norm * norm : norm;
}

/// A field's plane, ready to be scanned.
struct FieldPlane {
  float slope_x, slope_y, height;
  float scale;  // per unit
};

struct NormPlanes;

struct NormScan {
  const FitNorm& norm;
  const NormError::Samples& samples;
  const grid::Raster& bounds;
  double per_unit;

  std::size_t index_of(std::int32_t x, std::int32_t y) const {
    return static_cast<std::size_t>(samples.first.y + y) * static_cast<std::size_t>(samples.heights.cols) +
           static_cast<std::size_t>(samples.first.x + x);
  }
  std::size_t size() const {
    return static_cast<std::size_t>(samples.heights.rows) * static_cast<std::size_t>(samples.heights.cols);
  }
  float value_at(std::size_t field, const FitCorner& corner) const {
    return samples.fields[field][index_of(corner.x / grid::kLatticeSteps, corner.y / grid::kLatticeSteps)];
  }

  template <Norm kNorm, class Visit>
  void each_eight(const NormPlanes& planes, std::int32_t y, std::int32_t first, std::int32_t last,
                  const Visit& visit) const;
};

/// The planes of one triangle. They are not cleared, since most triangles are small and there are few fields.
struct NormPlanes {
  TriangleTask task;
  std::array<FieldPlane, kMostFitFields> fields;
  float guard;
  float widening;  // see norm_error.h
  bool are_finite = true;

  NormPlanes(const NormScan& scan, const NormError::Corners& corners)
      : task(corners[0], corners[1], corners[2], 0, 0),
        widening(0x1p-23f * static_cast<float>(scan.norm.fields.size() + 12)) {
    const auto& [a, b, c] = corners;
    constexpr double kStep = 1.0 / grid::kLatticeSteps;
    // Subnormal scales per unit round by more than their share.
    double sum = 0x1p-40;
    for (std::size_t k = 0; k < scan.norm.fields.size(); ++k) {
      const float za = scan.value_at(k, a), zb = scan.value_at(k, b), zc = scan.value_at(k, c);
      are_finite = are_finite && std::max({std::abs(za), std::abs(zb), std::abs(zc)}) <= geom::kMaxScanHeight;
      if (!are_finite) return;
      const geom::ScanPlane plane =
          geom::ScanPlane::spanned(za,
                                   {(b.x - a.x) * kStep, (b.y - a.y) * kStep, (c.x - a.x) * kStep, (c.y - a.y) * kStep,
                                    double{zb} - double{za}, double{zc} - double{za}},
                                   0);
      const double scale = scan.norm.fields[k].scale * scan.per_unit;
      fields[k] = {plane.slope_x, plane.slope_y, plane.height, static_cast<float>(scale)};
      sum += scale * double{plane.guard};
    }
    guard = static_cast<float>(sum) * (1 + 0x1p-20f);
  }
};

/// The norms of eight samples' errors, in the form of measure_of(); 0 for masked samples.
template <Norm kNorm>
struct NormEight {
  Floats low{}, high{};

  void add(Floats low_error, Floats high_error) {
    if constexpr (kNorm == Norm::kMax) {
      low = larger_of(low, low_error);
      high = larger_of(high, high_error);
    } else {
      low += measure_of<kNorm>(low_error);
      high += measure_of<kNorm>(high_error);
    }
  }
};

inline Floats magnitude(Floats values) {
  constexpr std::int32_t kAllButSign = 0x7fffffff;
  return kept(values, Masks{kAllButSign, kAllButSign, kAllButSign, kAllButSign});
}

/// Eight samples of a row: data shared by all fields.
struct EightPlaces {
  Floats left, right;  // offsets from the base
  Masks low_meant, high_meant;
  Floats low_bound = all(1), high_bound = all(1);  // per unit

  EightPlaces(const NormScan& scan, const TriangleTask& task, std::int32_t x, std::int32_t y, std::int32_t last) {
    const float offset = static_cast<float>(x) - task.base_x;
    left = all(offset) + Floats{0, 1, 2, 3};
    right = all(offset) + Floats{4, 5, 6, 7};
    const float* const heights = scan.samples.heights.samples;
    const RowSamples eight(heights + scan.index_of(x, y), heights + scan.size());
    const std::int32_t count = last - x + 1;
    const Masks counts{count, count, count, count};
    const Floats low = load(eight.from), high = load(eight.from + 4);
    low_meant = (Masks{0, 1, 2, 3} < counts) & (low == low);
    high_meant = (Masks{4, 5, 6, 7} < counts) & (high == high);
    if (scan.bounds.samples == nullptr) return;
    const float* const bounds = scan.bounds.samples;
    const EightBounds by(bounds + scan.index_of(x, y), bounds + scan.size(), low_meant, high_meant);
    low_bound = by.low * all(static_cast<float>(scan.per_unit));
    high_bound = by.high * all(static_cast<float>(scan.per_unit));
  }
};

/// A field's plane less its samples, scaled; unspecified for masked samples.
struct EightErrors {
  Floats low, high;

  EightErrors(const NormScan& scan, const NormPlanes& planes, std::size_t k, const EightPlaces& places,
              std::size_t index, float down) {
    const FieldPlane& plane = planes.fields[k];
    const RowSamples eight(scan.samples.fields[k] + index, scan.samples.fields[k] + scan.size());
    const Floats row = all(plane.slope_y * down), slope = all(plane.slope_x), height = all(plane.height);
    low = ((slope * places.left + row) - (load(eight.from) - height)) * all(plane.scale);
    high = ((slope * places.right + row) - (load(eight.from + 4) - height)) * all(plane.scale);
  }
};

/// The least useful bound: errors counted in smaller bounds are noise.
inline float least_bound(const NormPlanes& planes) { return std::max(kLeastBound, planes.guard); }

/// Calls visit(x, norms, places) for each group of eight samples in a row.
template <Norm kNorm, class Visit>
void NormScan::each_eight(const NormPlanes& planes, std::int32_t y, std::int32_t first, std::int32_t last,
                          const Visit& visit) const {
  const float down = static_cast<float>(y) - planes.task.base_y;
  for (std::int32_t x = first; x <= last; x += kLanes) {
    const std::size_t index = index_of(x, y);
    const EightPlaces places(*this, planes.task, x, y, last);
    NormEight<kNorm> eight;
    for (std::size_t k = 0; k < norm.fields.size(); ++k) {
      const EightErrors errors(*this, planes, k, places, index, down);
      eight.add(magnitude(errors.low), magnitude(errors.high));
    }
    eight.low = kept(eight.low, places.low_meant);
    eight.high = kept(eight.high, places.high_meant);
    visit(x, eight, places);
  }
}

}  // namespace scarp::fit
