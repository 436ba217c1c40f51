// A closed triangle seen from above, as the judge represents it, with double-precision corners and no lattice.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/branchless.h"

namespace scarp::judge {

struct Interval {
  double lo = 0, hi = 0;
};

/// Corners in counter-clockwise order (positive area) in their coordinate system.
struct PlanTriangle {
  std::array<double, 3> x{}, y{};

  /// Twice the signed area of the triangle (p, corner k+1, corner k+2): the weight of corner k at p.
  double weight(int k, double px, double py) const {
    const int a = k == 2 ? 0 : k + 1, b = a == 2 ? 0 : a + 1;
    return (x[b] - x[a]) * (py - y[a]) - (y[b] - y[a]) * (px - x[a]);
  }
  double double_area() const { return (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]); }
  double side(int k) const {
    const int a = k == 2 ? 0 : k + 1, b = a == 2 ? 0 : a + 1;
    return std::sqrt((x[b] - x[a]) * (x[b] - x[a]) + (y[b] - y[a]) * (y[b] - y[a]));
  }
  Interval x_extent() const { return {lesser(x[0], x[1], x[2]), greater(x[0], x[1], x[2])}; }
  Interval y_extent() const { return {lesser(y[0], y[1], y[2]), greater(y[0], y[1], y[2])}; }
  /// Weights above −slack() count as zero or positive, because of rounding.
  double slack() const {
    const Interval across = x_extent(), along = y_extent();
    return 1e-12 * (across.hi - across.lo) * (along.hi - along.lo);
  }
  bool contains(double px, double py) const {
    const double least = -slack();
    return weight(0, px, py) >= least && weight(1, px, py) >= least && weight(2, px, py) >= least;
  }
  /// Depth of p in the triangle: distance to the nearest side's line; negative outside.
  double depth(double px, double py) const {
    double least = weight(0, px, py) / side(0);
    least = std::min(least, weight(1, px, py) / side(1));
    return std::min(least, weight(2, px, py) / side(2));
  }

  /// The range of x for the part of the triangle with y in [lo, hi]. If [lo, hi] lies outside the triangle's range of
  /// y, the nearest y of that range is used.
  Interval x_range(double lo, double hi) const {
    const Interval along = y_extent();
    lo = std::clamp(lo, along.lo, along.hi);
    hi = std::clamp(hi, along.lo, along.hi);
    Interval range{INFINITY, -INFINITY};
    const auto include = [&](double at) {
      range.lo = std::min(range.lo, at);
      range.hi = std::max(range.hi, at);
    };
    for (int a = 0; a < 3; ++a) {
      const int b = a == 2 ? 0 : a + 1;
      if (std::max(y[a], y[b]) < lo || std::min(y[a], y[b]) > hi) continue;
      const double rise = y[b] - y[a];
      if (rise == 0) {
        include(x[a]);
        include(x[b]);
        continue;
      }
      const double run = (x[b] - x[a]) / rise;
      const auto cross = [&](double level) {
        if (level <= std::min(y[a], y[b])) return y[a] < y[b] ? x[a] : x[b];
        if (level >= std::max(y[a], y[b])) return y[a] < y[b] ? x[b] : x[a];
        return x[a] + (level - y[a]) * run;
      };
      include(cross(lo));
      if (hi != lo) include(cross(hi));
    }
    return range;
  }

  /// Distance from p to the closed triangle.
  double distance(double px, double py) const {
    if (contains(px, py)) return 0;
    double least = INFINITY;
    for (int a = 0; a < 3; ++a) {
      const int b = a == 2 ? 0 : a + 1;
      const double ux = x[b] - x[a], uy = y[b] - y[a], vx = px - x[a], vy = py - y[a];
      const double t = std::clamp((ux * vx + uy * vy) / (ux * ux + uy * uy), 0.0, 1.0);
      least = std::min(least, (vx - t * ux) * (vx - t * ux) + (vy - t * uy) * (vy - t * uy));
    }
    return std::sqrt(least);
  }
};

/// A triangle with the heights of its corners, counter-clockwise in plan.
struct Facet {
  PlanTriangle plan;
  std::array<double, 3> z{};
};

/// Puts corners into counter-clockwise order. Returns false if the triangle has no area seen from above.
inline bool make_counter_clockwise(Facet& facet) {
  const double area = facet.plan.double_area();
  if (area < 0) {
    std::swap(facet.plan.x[1], facet.plan.x[2]);
    std::swap(facet.plan.y[1], facet.plan.y[2]);
    std::swap(facet.z[1], facet.z[2]);
  }
  return area != 0;
}

}  // namespace scarp::judge
