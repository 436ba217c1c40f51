// Sums and products of doubles without rounding.
#pragma once

namespace scarp {

/// high + low is the exact result, |low| <= ulp(high) / 2, without overflow and underflow.
struct ExactPair {
  double high, low;
};

/// Knuth's sum.
inline ExactPair exact_sum(double a, double b) {
  const double high = a + b, virtual_b = high - a;
  return {high, (a - (high - virtual_b)) + (b - virtual_b)};
}

/// Dekker's product (1971).
inline ExactPair exact_product(double a, double b) {
  constexpr double kSplitter = 134217729;  // 2^27 + 1
  const double a_big = kSplitter * a, a_high = a_big - (a_big - a), a_low = a - a_high;
  const double b_big = kSplitter * b, b_high = b_big - (b_big - b), b_low = b - b_high;
  const double high = a * b;
  return {high, ((a_high * b_high - high) + a_high * b_low + a_low * b_high) + a_low * b_low};
}

}  // namespace scarp
