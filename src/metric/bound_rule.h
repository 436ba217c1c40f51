// The guaranteed bound of a sample, and the target of refinement, from the requested bound.
#pragma once

#include <cmath>

#include "base/point.h"
#include "scarp/result.h"

namespace scarp::metric {

/// The largest double whose exact product with `weight` is at most `value`, or the double below it.
double divide_down(double value, double weight);

/// The largest float that is at most `value`.
float round_down_to_float(double value);

/// goal − reserve, rounded down, at least 0.
double tightened(double goal, double reserve);

struct BoundRule {
  double reserve = 0;  ///< for the rounding of samples
  double aim = 1;      ///< fraction of each bound

  /// The largest float that is at most `asked` minus the reserve; +infinity: no bound.
  float bound(double asked) const;
  float aim_at(float bound) const;

  /// The kPromise error for a requested bound below the sample's rounding.
  Error refuse(Point at, double asked) const;
};

/// The kUsage error for an invalid value in a raster of weights or bounds.
Error refuse_value(const char* what, Point at, float value, const char* rest = "");

}  // namespace scarp::metric
