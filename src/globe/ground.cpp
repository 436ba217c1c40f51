#include "globe/ground.h"

#include "globe/sine.h"

namespace scarp::globe {
namespace {

constexpr double kRadians = 0.017453292519943295;

}  // namespace

Space Ground::position(double longitude, double latitude, double height) const {
  if (!grid_.is_flat()) return globe_.position(longitude, latitude, height);
  const LocalRaster& raster = grid_.local;
  return {(longitude - static_cast<double>(raster.centre_col())) * raster.cell_x,
          (latitude - static_cast<double>(raster.centre_row())) * raster.cell_y, height};
}

Ground::Axes Ground::axes(double longitude, double latitude) const {
  if (grid_.is_flat()) return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto [sin_lon, cos_lon] = sine_of_degrees(longitude);
  const auto [sin_lat, cos_lat] = sine_of_degrees(latitude);
  return {{-sin_lon, cos_lon, 0},
          {-sin_lat * cos_lon, -sin_lat * sin_lon, cos_lat},
          {cos_lat * cos_lon, cos_lat * sin_lon, sin_lat}};
}

Globe::Radii Ground::metres(double latitude) const {
  return grid_.is_flat() ? Globe::Radii{grid_.local.cell_y, grid_.local.cell_x} : globe_.radii(latitude);
}

double Ground::unit() const { return grid_.is_flat() ? 1 : kRadians; }

Space Ground::horizon_point(const Space& centre, std::span<const Space> points) const {
  return grid_.is_flat() ? Space{0, 0, 0} : globe_.horizon_point(centre, points);
}

}  // namespace scarp::globe
