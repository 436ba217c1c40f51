// A round earth without GDAL: x and y are degrees of longitude and latitude on a sphere.
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <span>

#include "scarp/height_field.h"

namespace scarp::testing {

inline constexpr double kBallRadius = 6371000;

class Ball : public SpaceTransform {
 public:
  /// Earth-centred; `longitude` and `latitude` are those of the raster's centre.
  Ball(double longitude, double latitude) {
    std::array<double, 1> x{longitude}, y{latitude}, z{0};
    to_space(x, y, z);
    origin_ = {x[0], y[0], z[0]};
    for (std::size_t k = 0; k < 3; ++k) up_[k] = origin_[k] / kBallRadius;
  }
  bool to_space(std::span<double> x, std::span<double> y, std::span<double> z) const override {
    for (std::size_t k = 0; k < x.size(); ++k) {
      const double a = x[k] * kDegree, b = y[k] * kDegree, r = kBallRadius + z[k];
      x[k] = r * std::cos(b) * std::cos(a);
      y[k] = r * std::cos(b) * std::sin(a);
      z[k] = r * std::sin(b);
    }
    return true;
  }
  bool from_space(std::span<double> x, std::span<double> y, std::span<double> z) const override {
    for (std::size_t k = 0; k < x.size(); ++k) {
      const double across = std::hypot(x[k], y[k]), r = std::hypot(across, z[k]);
      x[k] = std::atan2(y[k], x[k]) / kDegree;
      y[k] = std::atan2(z[k], across) / kDegree;
      z[k] = r - kBallRadius;
    }
    return true;
  }
  std::array<double, 3> origin() const override { return origin_; }
  std::array<double, 3> up() const override { return up_; }
  std::array<double, 12> to_earth() const override { return {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}; }

 private:
  static constexpr double kDegree = std::numbers::pi / 180;
  std::array<double, 3> origin_{}, up_{};
};

/// Samples `cell` degrees apart, the first one at (longitude, latitude); rows advance to the south.
inline Frame ball_frame(double longitude, double latitude, double cell, int cols, int rows) {
  Frame frame;
  frame.kind = Frame::Kind::kGeocentric;
  frame.affine = {longitude, cell, 0, latitude, 0, -cell};
  const auto [x, y] = frame.apply_affine(cols / 2, rows / 2);
  frame.space = std::make_shared<Ball>(x, y);
  return frame;
}

}  // namespace scarp::testing
