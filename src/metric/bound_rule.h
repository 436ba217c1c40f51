// The promised bound of a sample, and the aim of refinement, from the requested bound.
#pragma once

#include <cmath>

#include "base/point.h"
#include "scarp/result.h"

namespace scarp {

/// The largest double that times `weight` is at most `value`, as real numbers, or the one below it.
double divide_down(double value, double weight);

/// goal − reserve, rounded down, at least 0.
double tightened(double goal, double reserve);

struct BoundRule {
  double reserve = 0;  ///< for the rounding of samples
  double aim = 1;      ///< share of each bound

  /// The largest float that is no more than what is left of `asked`; +infinity for none.
  float bound(double asked) const;
  float aim_at(float bound) const;

  /// kPromise: less was asked at a sample than its rounding.
  Error refuse(Point at, double asked) const;
};

/// kUsage: a value of a raster of weights or bounds that is none.
Error refuse_value(const char* what, Point at, float value, const char* rest = "");

}  // namespace scarp
