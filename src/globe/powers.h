// Powers of two next to a number.
#pragma once

#include <cmath>

namespace scarp {

/// The largest that is no more. REQUIRES: value > 0.
inline double power_of_two_below(double value) { return std::ldexp(1.0, std::ilogb(value)); }
/// The least that is no less.
inline double power_of_two_above(double value) {
  const double below = power_of_two_below(value);
  return below < value ? 2 * below : below;
}

}  // namespace scarp
