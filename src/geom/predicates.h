// The in-circle predicate, evaluated exactly on the integer lattice (orient() is in base/point.h).
//
// Sizes: in_circle() has degree 4. If all differences are at most d, its terms add up to less than 12 d⁴, which is
// below 2⁶³ for d <= 29,609; for larger d, 128-bit integers are used (12·2¹²⁰ < 2¹²⁷).
#pragma once

#include <cstdint>
#include <cstdlib>

#include "base/int128.h"
#include "base/point.h"

namespace scarp::geom {

inline constexpr std::int32_t kMaxInCircle64 = 29609;

namespace detail {

template <class Int>
Int in_circle_determinant(Point a, Point b, Point c, Point d) {
  const Int ax = a.x - d.x, ay = a.y - d.y, bx = b.x - d.x, by = b.y - d.y, cx = c.x - d.x, cy = c.y - d.y;
  const Int a2 = ax * ax + ay * ay, b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
  return ax * (by * c2 - b2 * cy) - ay * (bx * c2 - b2 * cx) + a2 * (bx * cy - by * cx);
}

}  // namespace detail

/// True if 64 bits suffice for in_circle() of these points.
inline bool in_circle_fits_64(Point a, Point b, Point c, Point d) {
  const auto within = [d](Point p) {
    return std::abs(p.x - d.x) <= kMaxInCircle64 && std::abs(p.y - d.y) <= kMaxInCircle64;
  };
  return within(a) && within(b) && within(c);
}

/// Positive if d lies strictly inside the circle through the positively oriented a, b, c; 0 if on it; negative outside.
/// (1) Invariant under rotation of (a, b, c); (2) antisymmetric under a swap of any two of the four points.
inline int in_circle(Point a, Point b, Point c, Point d) {
  if (in_circle_fits_64(a, b, c, d)) return sign_of(detail::in_circle_determinant<std::int64_t>(a, b, c, d));
  return sign_of(detail::in_circle_determinant<Int128>(a, b, c, d));
}

}  // namespace scarp::geom
