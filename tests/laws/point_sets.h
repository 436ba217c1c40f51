// Random scattered points for laws and oracles.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <utility>

#include "scarp/height_field.h"
#include "scarp/mesh.h"

namespace scarp::testing {

enum class Scatter {
  kWhole,    ///< few distinct integers: duplicates, collinear runs, cocircular points
  kUtm,      ///< far from the origin, two decimals
  kFloats,   ///< arbitrary doubles in the unit square
  kTiny,     ///< arbitrary doubles in a square of 10⁻⁷, far from the origin
  kStreets,  ///< along a few lines
  kCircle,   ///< all on the hull
};
inline constexpr Scatter kScatters[] = {Scatter::kWhole, Scatter::kUtm,     Scatter::kFloats,
                                        Scatter::kTiny,  Scatter::kStreets, Scatter::kCircle};
enum class Heights { kReal, kSteps };

inline PointSet random_points(std::uint32_t seed, int count, Scatter scatter, Heights heights) {
  std::mt19937 random(seed);
  const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
  const auto decimal = [&](double from, double size) { return std::nearbyint((from + size * uniform()) * 100) / 100; };
  PointSet points;
  for (int i = 0; i < count; ++i) {
    double x = 0, y = 0;
    switch (scatter) {
      case Scatter::kWhole:
        x = static_cast<double>(random() % 12);
        y = static_cast<double>(random() % 9);
        break;
      case Scatter::kUtm:
        x = decimal(500000, 1000);
        y = decimal(4649000, 700);
        break;
      case Scatter::kFloats:
        x = uniform();
        y = uniform();
        break;
      case Scatter::kTiny:
        x = 3 + 1e-7 * uniform();
        y = -7 + 1e-7 * uniform();
        break;
      case Scatter::kStreets: {
        const double t = std::floor(uniform() * 50);
        const auto street = static_cast<double>(random() % 4);
        x = street < 2 ? t : 10 * street;
        y = street < 2 ? 20 * street : t;
        break;
      }
      case Scatter::kCircle: {
        const double angle = 2 * std::numbers::pi * uniform();
        x = 1000 * std::cos(angle);
        y = 1000 * std::sin(angle);
        break;
      }
    }
    points.x.push_back(x);
    points.y.push_back(y);
    points.z.push_back(heights == Heights::kReal ? uniform() * 100 - 50 : static_cast<double>(random() % 4));
  }
  return points;
}

/// Number of points that no triangle covers, and the largest error of the other points, by brute force: every point
/// against every triangle, in barycentric coordinates.
inline std::pair<int, double> judge_by_brute_force(const PointSet& points, const Mesh& mesh) {
  int missed = 0;
  double worst = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = points.x[i] - mesh.origin[0], y = points.y[i] - mesh.origin[1];
    double error = -1;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
      const double* p[3];
      for (std::size_t k = 0; k < 3; ++k) p[k] = &mesh.positions[3 * std::size_t{mesh.triangles[3 * t + k]}];
      const auto area = [](double ax, double ay, double bx, double by, double cx, double cy) {
        return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
      };
      const double whole = area(p[0][0], p[0][1], p[1][0], p[1][1], p[2][0], p[2][1]);
      const double u = area(x, y, p[1][0], p[1][1], p[2][0], p[2][1]) / whole,
                   v = area(p[0][0], p[0][1], x, y, p[2][0], p[2][1]) / whole, w = 1 - u - v;
      if (std::min({u, v, w}) < -1e-9) continue;
      error = std::max(error, std::abs(u * p[0][2] + v * p[1][2] + w * p[2][2] - points.z[i]));
    }
    missed += error < 0;
    worst = std::max(worst, error);
  }
  return {missed, worst};
}

}  // namespace scarp::testing
