// Powers of two next to a number.
#pragma once

#include <cmath>

namespace scarp::globe {

/// The largest power of two up to `value`. REQUIRES: value > 0.
inline double power_of_two_below(double value) { return std::ldexp(1.0, std::ilogb(value)); }
/// The smallest power of two that is at least `value`.
inline double power_of_two_above(double value) {
  const double below = power_of_two_below(value);
  return below < value ? 2 * below : below;
}

}  // namespace scarp::globe
