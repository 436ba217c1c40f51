// The norm of several errors, added one by one.
#pragma once

#include <algorithm>
#include <cmath>

#include "scarp/options.h"

namespace scarp {

/// The norm of `so_far` and `error`. REQUIRES: error >= 0.
inline double add_to_norm_of(Norm norm, double so_far, double error) {
  if (norm == Norm::kSum) return so_far + error;
  return norm == Norm::kMax ? std::max(so_far, error) : std::sqrt(so_far * so_far + error * error);
}

}  // namespace scarp
