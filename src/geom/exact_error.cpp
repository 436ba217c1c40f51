#include "geom/exact_error.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace scarp::geom {

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

/// |Σ weights[i]·values[i]| > last weight · last value, where the last pair is the threshold's. All values are scaled
/// to integers by one power of two. Also true if the comparison does not fit 128 bits.
template <std::size_t N>
bool sum_exceeds(const std::array<std::int64_t, N>& weights, const std::array<double, N>& values) {
  std::array<Dyadic, N> terms;
  int low = 0, weight_bits = 0;
  bool any = false;
  for (std::size_t k = 0; k < N; ++k) {
    terms[k] = weights[k] == 0 ? Dyadic{} : dyadic(values[k]);
    weight_bits = std::max(weight_bits, bits(weights[k]));
    if (terms[k].mantissa == 0) continue;
    low = any ? std::min(low, terms[k].exponent) : terms[k].exponent;
    any = true;
  }
  Int128 sum = 0, limit = 0;
  for (std::size_t k = 0; k < N; ++k) {
    const int shift = terms[k].mantissa == 0 ? 0 : terms[k].exponent - low;
    // Up to five products are added: three bits of headroom and the sign.
    if (shift + bits(terms[k].mantissa) + weight_bits > 123) return true;
    const Int128 product = weights[k] * (Int128{terms[k].mantissa} * (Int128{1} << shift));
    (k + 1 < N ? sum : limit) += product;
  }
  return (sum < 0 ? -sum : sum) > limit;
}

}  // namespace

bool exceeds_exactly(const std::array<Point, 3>& corners, const std::array<double, 3>& heights, Point p, double sample,
                     double threshold) {
  for (int k = 0; k < 3; ++k) {
    if (corners[k] == p) return heights[k] != sample && sum_exceeds<3>({1, -1, 1}, {heights[k], sample, threshold});
  }
  const std::int64_t area = orient(corners[0], corners[1], corners[2]);
  return sum_exceeds<5>({orient(corners[1], corners[2], p), orient(corners[2], corners[0], p),
                         orient(corners[0], corners[1], p), -area, area},
                        {heights[0], heights[1], heights[2], sample, threshold});
}

bool exceeds_exactly_between(float from, float to, std::int64_t k, std::int64_t n, float sample, double threshold) {
  return sum_exceeds<4>({n - k, k, -n, n}, {from, to, sample, threshold});
}

}  // namespace scarp::geom
