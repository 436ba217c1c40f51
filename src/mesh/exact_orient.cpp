// A determinant of doubles is a sum of six products. Each product of two doubles is exactly the sum of two doubles
// (Dekker 1971). A sum of doubles can be stored exactly as a list of doubles that do not overlap, whose last non-zero
// member has the sign of the whole (Shewchuk 1997, "Adaptive precision floating-point arithmetic and fast robust
// geometric predicates"). In nearly all cases the rounded determinant and a bound on its error already decide.

#include "mesh/exact_orient.h"

#include <cmath>

#include "base/exact_arithmetic.h"

namespace scarp::mesh {

int exact_orient(const Point2& a, const Point2& b, const Point2& c) {
  const double left = (a[0] - c[0]) * (b[1] - c[1]), right = (a[1] - c[1]) * (b[0] - c[0]);
  const double rounded = left - right;
  constexpr double kEpsilon = 1.1102230246251565e-16;  // 2^-53
  if (std::fabs(rounded) > (3 + 16 * kEpsilon) * kEpsilon * (std::fabs(left) + std::fabs(right))) {
    return rounded > 0 ? 1 : -1;
  }
  const ExactPair products[6] = {exact_product(a[0], b[1]),  exact_product(-a[1], b[0]), exact_product(b[0], c[1]),
                                 exact_product(-b[1], c[0]), exact_product(c[0], a[1]),  exact_product(-c[1], a[0])};
  double expansion[12] = {};  // non-overlapping, increasing in size
  for (int count = 0; count < 12; ++count) {
    double carry = count % 2 == 0 ? products[count / 2].low : products[count / 2].high;
    for (int i = 0; i < count; ++i) {
      const ExactPair sum = exact_sum(carry, expansion[i]);
      expansion[i] = sum.low;
      carry = sum.high;
    }
    expansion[count] = carry;
  }
  for (int i = 11; i >= 0; --i) {
    if (expansion[i] != 0) return expansion[i] > 0 ? 1 : -1;
  }
  return 0;
}

}  // namespace scarp::mesh
