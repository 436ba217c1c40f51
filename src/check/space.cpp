#include "check/space.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scarp::check {
namespace {

constexpr double kRadiansOfDegree = 0.017453292519943295;

double distance_to_segment(const Place& point, const Place& a, const Place& b) {
  const Place way = b - a;
  const double square = inner(way, way);
  const double t = square > 0 ? std::clamp(inner(point - a, way) / square, 0.0, 1.0) : 0;
  return length(point - (a + t * way));
}

}  // namespace

Place operator+(const Place& a, const Place& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Place operator-(const Place& a, const Place& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Place operator*(double factor, const Place& a) { return {factor * a[0], factor * a[1], factor * a[2]}; }
double inner(const Place& a, const Place& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Place cross(const Place& a, const Place& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double length(const Place& a) { return std::sqrt(inner(a, a)); }

World::World(const TileGrid& grid, const Geodetic& geodetic)
    : raster_(grid.local), is_flat_(grid.is_flat()), a_(geodetic.semi_major) {
  const double flattening = geodetic.inverse_flattening == 0 ? 0 : 1 / geodetic.inverse_flattening;
  b_ = a_ * (1 - flattening);
  e2_ = flattening * (2 - flattening);
}

World::Parallel World::parallel(double latitude) const {
  Parallel parallel;
  if (is_flat_) {
    parallel.north = (latitude - static_cast<double>(raster_.centre_row())) * raster_.cell_y;
    return parallel;
  }
  parallel.sine = std::sin(latitude * kRadiansOfDegree);
  // Exactly 0 at the poles, so that all longitudes are one position.
  parallel.cosine = std::abs(latitude) == 90 ? 0 : std::cos(latitude * kRadiansOfDegree);
  parallel.normal = a_ / std::sqrt(1 - e2_ * parallel.sine * parallel.sine);
  return parallel;
}

World::Meridian World::meridian(double longitude) const {
  if (is_flat_) return {0, 0, (longitude - static_cast<double>(raster_.centre_col())) * raster_.cell_x};
  const double angle = longitude * kRadiansOfDegree;
  return {std::sin(angle), std::cos(angle), 0};
}

Place World::place(const Geographic& at) const {
  return place(parallel(at.latitude), meridian(at.longitude), at.height);
}

double World::least_radius() const { return is_flat_ ? std::numeric_limits<double>::infinity() : a_ * (1 - e2_); }

Geographic World::find(const Place& at) const {
  if (is_flat_)
    return {at[0] / raster_.cell_x + static_cast<double>(raster_.centre_col()),
            at[1] / raster_.cell_y + static_cast<double>(raster_.centre_row()), at[2]};
  constexpr int kRounds = 8;  // each reduces the error to 1/150
  const double out = std::hypot(at[0], at[1]);
  double latitude = std::atan2(at[2], out * (1 - e2_));
  for (int round = 0; round < kRounds; ++round) {
    const double sine = std::sin(latitude);
    latitude = std::atan2(at[2] + e2_ * a_ / std::sqrt(1 - e2_ * sine * sine) * sine, out);
  }
  const double sine = std::sin(latitude);
  const double height = out * std::cos(latitude) + at[2] * sine - a_ * std::sqrt(1 - e2_ * sine * sine);
  return {std::atan2(at[1], at[0]) / kRadiansOfDegree, latitude / kRadiansOfDegree, height};
}

Place World::up(double longitude, double latitude) {
  const double east = longitude * kRadiansOfDegree, north = latitude * kRadiansOfDegree;
  return {std::cos(north) * std::cos(east), std::cos(north) * std::sin(east), std::sin(north)};
}

double distance_to_triangle(const Place& point, const Place& a, const Place& b, const Place& c) {
  const Place ab = b - a, ac = c - a, normal = cross(ab, ac);
  const double square = inner(normal, normal);
  if (square > 0) {
    const Place way = point - a;
    const double to_b = inner(cross(way, ac), normal) / square, to_c = inner(cross(ab, way), normal) / square;
    if (to_b >= 0 && to_c >= 0 && to_b + to_c <= 1) return std::abs(inner(way, normal)) / std::sqrt(square);
  }
  return std::min(
      {distance_to_segment(point, a, b), distance_to_segment(point, b, c), distance_to_segment(point, c, a)});
}

}  // namespace scarp::check
