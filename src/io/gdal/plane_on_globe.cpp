// The position of the plane of a local grid on the globe: the tangent plane at the raster's centre.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/gdal/crs.h"
#include "io/gdal/session.h"
#include "io/globe_place.h"
#include "scarp/tile.h"

namespace scarp::io {
namespace {

constexpr double kDegrees = 57.29577951308232;
/// Distance from the centre, in cells, for measuring the projection's rotation and scale there.
constexpr double kReach = 16;
/// Raster positions examined in each direction.
constexpr int kPlaces = 17;

using Point = std::array<double, 3>;

Point operator+(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point operator*(double factor, const Point& a) { return {factor * a[0], factor * a[1], factor * a[2]}; }
double inner(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Earth-centred positions of the raster.
class Places {
 public:
  Places(const RasterOnGlobe& globe, const LocalRaster& raster) : globe_(globe), raster_(raster) {}

  struct At {
    Point place{}, up{}, east{}, north{};
  };
  /// The position `east` and `north` cells from the centre sample, at `height` above the zero. Not finite if there is
  /// none.
  At at(double east, double north, double height) const {
    const std::array<double, 6>& a = globe_.place.affine;
    const double col = static_cast<double>(raster_.centre_col()) + east,
                 row = static_cast<double>(raster_.rows - 1 - raster_.centre_row()) - north;
    double x = a[0] + a[1] * col + a[2] * row, y = a[3] + a[4] * col + a[5] * row;
    globe_.to_degrees->apply({&x, 1}, {&y, 1});
    double zero = 0;
    if (globe_.zero != nullptr) globe_.zero->find({&x, 1}, {&y, 1}, {&zero, 1});
    const double longitude = x / kDegrees, latitude = y / kDegrees;
    At found;
    found.up = {std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude), std::sin(latitude)};
    found.east = {-std::sin(longitude), std::cos(longitude), 0};
    found.north = {-std::sin(latitude) * std::cos(longitude), -std::sin(latitude) * std::sin(longitude),
                   std::cos(latitude)};
    const double a2 = globe_.ellipsoid.semi_major, ratio = semi_minor(globe_.ellipsoid) / a2;
    const double n = a2 / std::sqrt(1 - (1 - ratio * ratio) * found.up[2] * found.up[2]), up = zero + height;
    found.place = {(n + up) * found.up[0], (n + up) * found.up[1], (n * ratio * ratio + up) * found.up[2]};
    return found;
  }

 private:
  const RasterOnGlobe& globe_;
  const LocalRaster& raster_;
};

}  // namespace

bool is_local_crs(const RasterInfo& info) {
  const gdal::Session quiet;
  const gdal::Crs crs = info.crs.empty() ? nullptr : gdal::find_crs(info.crs);
  return crs && OSRIsLocal(crs.get()) != 0;
}

Result<PlaneOnGlobe> find_plane_on_globe(const RasterInfo& info, const LocalRaster& raster,
                                         const RasterOnGlobe& globe) {
  const gdal::Session quiet;
  const Places places(globe, raster);
  const Places::At centre = places.at(0, 0, 0);
  const Point x = (0.5 / (kReach * raster.cell_x)) * (places.at(kReach, 0, 0).place - places.at(-kReach, 0, 0).place);
  const Point y = (0.5 / (kReach * raster.cell_y)) * (places.at(0, kReach, 0).place - places.at(0, -kReach, 0).place);
  // Directions along the ground, so that the slope of the heights' zero does not rotate the plane.
  const auto along = [&](const Point& way) { return way - inner(way, centre.up) * centre.up; };
  const Point east = along(x), north = along(y);
  PlaneOnGlobe plane;
  plane.crs = info.crs;
  plane.scale_x = 1 / std::sqrt(inner(east, east));
  plane.scale_y = 1 / std::sqrt(inner(north, north));
  plane.convergence = kDegrees * std::atan2(inner(north, centre.east), inner(north, centre.north));
  const auto set_column = [&](std::size_t column, const Point& from, double last) {
    std::copy(from.begin(), from.end(), plane.transform.begin() + static_cast<std::ptrdiff_t>(4 * column));
    plane.transform[4 * column + 3] = last;
  };
  set_column(0, east, 0);
  set_column(1, north, 0);
  set_column(2, centre.up, 0);
  set_column(3, centre.place, 1);
  for (int j = 0; j < kPlaces; ++j) {
    for (int i = 0; i < kPlaces; ++i) {
      const double to_east = (raster.cols - 1) * (i / (kPlaces - 1.0)) - static_cast<double>(raster.centre_col());
      const double to_north = (raster.rows - 1) * (j / (kPlaces - 1.0)) - static_cast<double>(raster.centre_row());
      for (const double height : {info.min, info.max}) {
        const Places::At exact = places.at(to_east, to_north, height);
        const Point put =
            centre.place + (to_east * raster.cell_x) * east + (to_north * raster.cell_y) * north + height * centre.up;
        const Point off = put - exact.place;
        if (!std::isfinite(inner(off, off)))
          return fail(ErrorKind::kInput, fmt::format("parts of {} have no place on the globe", info.path));
        const double up = inner(off, exact.up), square = inner(off, off) - up * up;
        plane.off_height = std::max(plane.off_height, std::abs(up));
        plane.off_along = std::max(plane.off_along, std::sqrt(std::max(square, 0.0)));
      }
    }
  }
  return plane;
}

}  // namespace scarp::io
