// Conversion of mesh positions to grid positions, for affine frames.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "scarp/height_field.h"

namespace scarp::judge {

/// The inverse of an affine frame in plain double arithmetic, the same on all machines. A coordinate is snapped to an
/// integer, or to a multiple of 1/256, if rounding may have moved it that far. Rounding is estimated as four units in
/// the last place of the vertex's source coordinates (frame, origin and vertex), converted to samples, plus the
/// rounding of the inverse itself.
class GridMap {
 public:
  static constexpr double kSteps = 256;

  GridMap(const HeightField& field, const std::array<double, 3>& origin) : a_(field.frame.affine), origin_(origin) {
    det_ = a_[1] * a_[5] - a_[2] * a_[4];
    size_x_ =
        std::max({std::abs(a_[0]), std::abs(origin[0]), std::abs(a_[1]) * field.cols, std::abs(a_[2]) * field.rows});
    size_y_ =
        std::max({std::abs(a_[3]), std::abs(origin[1]), std::abs(a_[4]) * field.cols, std::abs(a_[5]) * field.rows});
  }

  static bool is_on_lattice(double place) { return std::nearbyint(place * kSteps) == place * kSteps; }

  /// The column and row of a position relative to the origin.
  std::array<double, 2> operator()(double x, double y) const {
    const double dx = sum_of(origin_[0], -a_[0], x), dy = sum_of(origin_[1], -a_[3], y);
    const double noise_x = 4 * kUlp * std::max(size_x_, std::abs(origin_[0] + x)),
                 noise_y = 4 * kUlp * std::max(size_y_, std::abs(origin_[1] + y));
    return {quotient(a_[5], dx, noise_x, -a_[2], dy, noise_y), quotient(-a_[4], dx, noise_x, a_[1], dy, noise_y)};
  }

 private:
  static constexpr double kUlp = 0x1p-52;

  /// a + b + c, rounded once or twice, so that differences of large coordinates are not lost.
  static double sum_of(double a, double b, double c) {
    const auto lost = [](double p, double q, double sum) {
      const double back = sum - p;
      return (p - (sum - back)) + (q - back);
    };
    const double first = a + b, second = first + c;
    return second + (lost(a, b, first) + lost(first, c, second));
  }

  double quotient(double p, double dx, double noise_x, double q, double dy, double noise_y) const {
    const double value = (p * dx + q * dy) / det_;
    const double near = (std::abs(p) * noise_x + std::abs(q) * noise_y) / std::abs(det_) +
                        4 * kUlp * (std::abs(p * dx) + std::abs(q * dy)) / std::abs(det_);
    for (const double steps : {1.0, kSteps}) {
      const double place = std::nearbyint(value * steps) / steps;
      if (std::abs(value - place) <= std::min(near, kMostNear / steps)) return place;
    }
    return value;
  }
  static constexpr double kMostNear = 1 / kSteps;

  std::array<double, 6> a_;
  std::array<double, 3> origin_;
  double det_ = 1, size_x_ = 0, size_y_ = 0;
};

}  // namespace scarp::judge
