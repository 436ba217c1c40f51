// Random scattered points for laws and oracles.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "scarp/point_set.h"

namespace scarp::testing {

enum class Scatter {
  kWhole,    ///< few whole numbers: duplicates, collinear runs, cocircular points
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

}  // namespace scarp::testing
