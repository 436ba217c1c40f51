// Bounds of samples that are not in memory as a whole: read in windows, as the samples are.
#pragma once

#include <cstdint>
#include <span>

#include "base/point.h"
#include "refine/bound_rule.h"
#include "scarp/height_field.h"
#include "scarp/result.h"

namespace scarp {

class SourceBounds {
 public:
  /// `tolerances`: what was asked for at each sample, alive. `most`: beside that; +infinity for none.
  SourceBounds(const SampleSource& tolerances, double most, const BoundRule& rule)
      : tolerances_(tolerances), most_(most), rule_(rule) {}

  /// What refinement aims at in a window, row-major. `samples`: those of the window, void as NaN; null: nothing is
  /// refused. Fails with kUsage where a tolerance is negative or NaN, with kPromise where a sample's is less than its
  /// rounding, and as the source does.
  Result<void> read_aims(Point first, std::int32_t cols, std::int32_t rows, const float* samples, float* aims) const;

  /// The tolerances of a row as they are, and what is promised there. Fails as the source does.
  Result<void> read_row(std::int32_t row, std::span<float> tolerances, std::span<float> bounds) const;

  /// Whether every sample has a bound, whatever its tolerance.
  bool has_most() const;

 private:
  float bound(float tolerance) const;

  const SampleSource& tolerances_;
  double most_;
  BoundRule rule_;
};

}  // namespace scarp
