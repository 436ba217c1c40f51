// The plane of a triangle over the lattice, and the precision of its arithmetic.
//
// Every algorithm of the engine, textbook or fast, measures a sample by height_at(). The plane's corners are in raster
// order, so the result depends only on the triangle and the sample, not on ids or the order of the scan. Doubles are
// used without contraction: each operation rounds once. `guard` bounds the sum of these roundings, so a comparison with
// a threshold is certain outside threshold ± guard. Inside, exact_error.h decides.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "geom/predicates.h"

namespace scarp::geom {

struct Plane {
  Point base;                       ///< first corner in raster order
  double height = 0;                ///< at base
  double slope_x = 0, slope_y = 0;  ///< per sample
  double guard = 0;  ///< bound of the rounding error of height_at(p) − sample, for p in the triangle; 0 for a level
                     ///< triangle, in which only the subtraction rounds

  /// REQUIRES: orient(corners) != 0; heights finite and far from overflow.
  static Plane through_double(std::array<Point, 3> corners, std::array<double, 3> heights) {
    const auto order = [&](int i, int j) {
      if (before(corners[j], corners[i])) {
        std::swap(corners[i], corners[j]);
        std::swap(heights[i], heights[j]);
      }
    };
    order(0, 1);
    order(1, 2);
    order(0, 1);
    const auto [p, q, r] = corners;
    const double qx = q.x - p.x, qy = q.y - p.y, rx = r.x - p.x, ry = r.y - p.y;
    const double qz = heights[1] - heights[0], rz = heights[2] - heights[0];
    Plane plane;
    plane.base = p;
    plane.height = heights[0];
    if (qz == 0 && rz == 0) return plane;
    const auto area = static_cast<double>(orient(p, q, r));
    plane.slope_x = (qz * ry - rz * qy) / area;
    plane.slope_y = (rz * qx - qz * rx) / area;
    const double width = std::max({p.x, q.x, r.x}) - std::min({p.x, q.x, r.x});
    const double reach_x = (std::abs(qz * ry) + std::abs(rz * qy)) / std::abs(area) * width;
    const double reach_y = (std::abs(rz * qx) + std::abs(qz * rx)) / std::abs(area) * (r.y - p.y);
    const double size = std::max({std::abs(heights[0]), std::abs(heights[1]), std::abs(heights[2])});
    plane.guard = 0x1p-49 * (size + reach_x + reach_y);
    return plane;
  }
  static Plane through(const std::array<Point, 3>& corners, const std::array<float, 3>& heights) {
    return through_double(corners, {heights[0], heights[1], heights[2]});
  }

  /// The part of the height common to a row; height_at() = row_height(y) + slope_x · (x − base.x).
  double row_height(std::int32_t y) const { return height + slope_y * static_cast<double>(y - base.y); }
  double height_at(Point p) const { return row_height(p.y) + slope_x * static_cast<double>(p.x - base.x); }
};

/// |n − m|² of the planes' unit normals n and m; grows with the angle between them.
inline double bend_of(const Plane& a, const Plane& b) {
  const double la = std::sqrt(1 + a.slope_x * a.slope_x + a.slope_y * a.slope_y);
  const double lb = std::sqrt(1 + b.slope_x * b.slope_x + b.slope_y * b.slope_y);
  const double x = a.slope_x / la - b.slope_x / lb, y = a.slope_y / la - b.slope_y / lb, z = 1 / la - 1 / lb;
  return x * x + y * y + z * z;
}

}  // namespace scarp::geom
