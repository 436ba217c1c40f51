// The ground of tiles for the judge, independent of the arithmetic that built the tiles.
#pragma once

#include <array>

#include "scarp/height_field.h"
#include "scarp/tile.h"

namespace scarp::check {

/// Earth-centred metres, or metres from the centre of a plane; also a vector.
using Place = std::array<double, 3>;

Place operator+(const Place& a, const Place& b);
Place operator-(const Place& a, const Place& b);
Place operator*(double factor, const Place& a);
double inner(const Place& a, const Place& b);
Place cross(const Place& a, const Place& b);
double length(const Place& a);

/// In degrees, and metres above the ellipsoid; on a local grid, in cells, and metres above its plane.
struct Geographic {
  double longitude = 0, latitude = 0, height = 0;
};

/// The ellipsoid, or the plane of a local grid.
class World {
 public:
  World(const TileGrid& grid, const Geodetic& geodetic);

  bool is_flat() const { return is_flat_; }

  /// Values shared by positions of one latitude.
  struct Parallel {
    double sine = 0, cosine = 0;
    double normal = 0;  ///< metres from the surface to the axis, along the normal
    double north = 0;   ///< metres, on the plane
  };
  Parallel parallel(double latitude) const;
  /// Values shared by positions of one longitude.
  struct Meridian {
    double sine = 0, cosine = 0;
    double east = 0;  ///< metres, on the plane
  };
  Meridian meridian(double longitude) const;
  Place place(const Parallel& parallel, const Meridian& meridian, double height) const {
    if (is_flat_) return {meridian.east, parallel.north, height};
    const double out = (parallel.normal + height) * parallel.cosine;
    return {out * meridian.cosine, out * meridian.sine, (parallel.normal * (1 - e2_) + height) * parallel.sine};
  }
  Place place(const Geographic& at) const;
  /// The inverse of place(), to 10⁻⁸ m; longitudes of −180 … 180.
  Geographic find(const Place& at) const;
  /// The unit vector that points upwards.
  static Place up(double longitude, double latitude);

  /// The position in units of the axes, which make the ellipsoid a sphere of radius 1.
  Place scaled(const Place& at) const { return {at[0] / a_, at[1] / a_, at[2] / b_}; }
  double semi_major() const { return a_; }
  /// The smallest radius of curvature anywhere; infinite on the plane.
  double least_radius() const;

 private:
  LocalRaster raster_;
  bool is_flat_;
  double a_, b_, e2_;
};

double distance_to_triangle(const Place& point, const Place& a, const Place& b, const Place& c);

}  // namespace scarp::check
