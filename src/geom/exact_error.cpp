#include "geom/exact_error.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace scarp {

namespace {

/// value = mantissa · 2^exponent with an odd mantissa (or zero).
struct Dyadic {
  std::int64_t mantissa = 0;
  int exponent = 0;
};

Dyadic dyadic(double value) {
  if (value == 0) return {};
  int exponent = 0;
  const double fraction = std::frexp(value, &exponent);
  auto mantissa = static_cast<std::int64_t>(std::ldexp(fraction, 53));
  const int zeros = std::countr_zero(static_cast<std::uint64_t>(mantissa));
  return {mantissa >> zeros, exponent - 53 + zeros};
}

int bits(std::int64_t value) { return static_cast<int>(std::bit_width(static_cast<std::uint64_t>(std::abs(value)))); }

}  // namespace

bool exceeds_exactly(const std::array<Point, 3>& corners, const std::array<double, 3>& heights, Point p, double sample,
                     double threshold) {
  for (int k = 0; k < 3; ++k) {
    if (corners[k] == p) return std::abs(heights[k] - sample) > threshold;
  }
  const Dyadic values[5] = {dyadic(heights[0]), dyadic(heights[1]), dyadic(heights[2]), dyadic(sample),
                            dyadic(threshold)};
  int low = 0;
  bool any = false;
  for (const Dyadic& v : values) {
    if (v.mantissa == 0) continue;
    low = any ? std::min(low, v.exponent) : v.exponent;
    any = true;
  }
  const std::int64_t weights[4] = {orient(corners[1], corners[2], p), orient(corners[2], corners[0], p),
                                   orient(corners[0], corners[1], p), orient(corners[0], corners[1], corners[2])};
  const int weight_bits = std::max({bits(weights[0]), bits(weights[1]), bits(weights[2]), bits(weights[3])});
  Int128 scaled[5];
  for (int k = 0; k < 5; ++k) {
    const int shift = values[k].mantissa == 0 ? 0 : values[k].exponent - low;
    // Five products are added below: three bits of head room and the sign.
    if (shift + bits(values[k].mantissa) + weight_bits > 123) return true;
    scaled[k] = Int128{values[k].mantissa} * (Int128{1} << shift);
  }
  const Int128 difference =
      weights[0] * scaled[0] + weights[1] * scaled[1] + weights[2] * scaled[2] - weights[3] * scaled[3];
  return (difference < 0 ? -difference : difference) > weights[3] * scaled[4];
}

}  // namespace scarp
