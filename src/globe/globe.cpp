#include "globe/globe.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "globe/sine.h"

namespace scarp::globe {

double dot(const Space& a, const Space& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Space scaled(const Space& a, double factor) { return {a[0] * factor, a[1] * factor, a[2] * factor}; }
Space sum(const Space& a, const Space& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

Space normalized(const Space& a) {
  const double length = std::sqrt(dot(a, a));
  return length > 0 ? scaled(a, 1 / length) : Space{0, 0, 1};
}

Globe::Globe(const Geodetic& geodetic) : a_(geodetic.semi_major) {
  const double f = geodetic.inverse_flattening == 0 ? 0 : 1 / geodetic.inverse_flattening;
  b_ = a_ * (1 - f);
  e2_ = f * (2 - f);
}

Space Globe::up(double longitude, double latitude) {
  const auto [sin_lon, cos_lon] = sine_of_degrees(longitude);
  const auto [sin_lat, cos_lat] = sine_of_degrees(latitude);
  return {cos_lat * cos_lon, cos_lat * sin_lon, sin_lat};
}

Space Globe::position(double longitude, double latitude, double height) const {
  const Space normal = up(longitude, latitude);
  const double n = a_ / std::sqrt(1 - e2_ * normal[2] * normal[2]);
  return {(n + height) * normal[0], (n + height) * normal[1], (n * (1 - e2_) + height) * normal[2]};
}

Globe::Radii Globe::radii(double latitude) const {
  const auto [sin_lat, cos_lat] = sine_of_degrees(latitude);
  const double w = 1 - e2_ * sin_lat * sin_lat, root = std::sqrt(w);
  return {a_ * (1 - e2_) / (w * root), a_ / root * cos_lat};
}

Globe::Sphere Globe::sphere_around(std::span<const Space> points) {
  Space low = points.front(), high = low;
  for (const Space& p : points) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  }
  Sphere sphere{scaled(sum(low, high), 0.5), 0};
  for (const Space& p : points) {
    const Space way = sum(p, scaled(sphere.centre, -1));
    sphere.radius = std::max(sphere.radius, dot(way, way));
  }
  sphere.radius = std::sqrt(sphere.radius) * (1 + 1e-14) + 1e-6;
  return sphere;
}

Space Globe::horizon_point(const Space& centre, std::span<const Space> points) const {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const Space inverse{1 / a_, 1 / a_, 1 / b_};
  const auto to_unit_sphere = [&](const Space& p) {
    return Space{p[0] * inverse[0], p[1] * inverse[1], p[2] * inverse[2]};
  };
  const Space direction = normalized(to_unit_sphere(centre));
  double farthest = 0;
  for (const Space& point : points) {
    const Space p = to_unit_sphere(point);
    // Points below the ellipsoid count as points on it, so that errors never hide a tile.
    const double length2 = std::max(1.0, dot(p, p)), length = std::sqrt(length2);
    const Space towards = normalized(p);
    const double cos_alpha = dot(towards, direction);
    const double sin_alpha = std::sqrt(std::max(0.0, 1 - cos_alpha * cos_alpha));
    const double cos_beta = 1 / length, sin_beta = std::sqrt(length2 - 1) * cos_beta;
    const double reach = cos_alpha * cos_beta - sin_alpha * sin_beta;
    if (!(reach > 1e-9)) return {kNone, kNone, kNone};
    farthest = std::max(farthest, 1 / reach);
  }
  return scaled(direction, farthest);
}

std::array<std::uint8_t, 2> encode_octahedral(const Space& normal) {
  const double size = std::abs(normal[0]) + std::abs(normal[1]) + std::abs(normal[2]);
  double x = normal[0] / size, y = normal[1] / size;
  if (normal[2] < 0) {
    const double folded = (1 - std::abs(y)) * (x < 0 ? -1 : 1);
    y = (1 - std::abs(x)) * (y < 0 ? -1 : 1);
    x = folded;
  }
  const auto byte = [](double value) {
    return static_cast<std::uint8_t>(std::floor((std::clamp(value, -1.0, 1.0) * 0.5 + 0.5) * 255 + 0.5));
  };
  return {byte(x), byte(y)};
}

Space decode_octahedral(const std::array<std::uint8_t, 2>& normal) {
  double x = normal[0] / 127.5 - 1, y = normal[1] / 127.5 - 1;
  const double z = 1 - std::abs(x) - std::abs(y);
  if (z < 0) {
    const double folded = (1 - std::abs(y)) * (x < 0 ? -1 : 1);
    y = (1 - std::abs(x)) * (y < 0 ? -1 : 1);
    x = folded;
  }
  return normalized({x, y, z});
}

}  // namespace scarp::globe
