// Sine and cosine with the same bits on every machine, unlike those of mathematics libraries.
#pragma once

#include <cmath>

namespace scarp::globe {

struct SineCosine {
  double sine = 0, cosine = 1;
};

/// Sine and cosine of an angle in degrees, |degrees| <= 720; error at most 3 units of the last place of 1. The results
/// for multiples of 90 are exact.
inline SineCosine sine_of_degrees(double degrees) {
  const double quarter = std::floor(degrees / 90 + 0.5);
  const double x = (degrees - 90 * quarter) * 0.017453292519943295, xx = x * x;
  // Taylor's series for |x| <= π/4; the omitted terms are below 2⁻⁵⁶.
  double sine = 0, cosine = 0;
  for (int k = 17; k >= 3; k -= 2) sine = (1 - sine) * xx / (k * (k - 1));
  for (int k = 18; k >= 2; k -= 2) cosine = (1 - cosine) * xx / (k * (k - 1));
  sine = x * (1 - sine);
  cosine = 1 - cosine;
  switch (static_cast<int>(quarter) & 3) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

}  // namespace scarp::globe
