// The ground of tiles: an ellipsoid, or the plane of a local grid. Places are in the grid's degrees; see TileGrid.
#pragma once

#include "globe/globe.h"
#include "scarp/height_field.h"
#include "scarp/tile.h"

namespace scarp {

class Ground {
 public:
  Ground(const TileGrid& grid, const Geodetic& ellipsoid) : grid_(grid), globe_(ellipsoid) {}

  /// Earth-centred, or on the plane east, north and up of the sample at its centre; metres.
  Space position(double longitude, double latitude, double height) const;

  /// Vectors of unit length each.
  struct Axes {
    Space east{}, north{}, up{};
  };
  Axes axes(double longitude, double latitude) const;
  /// Metres for one unit of the ground, and what a degree is of it: radians of the ellipsoid, cells of the plane.
  Globe::Radii metres(double latitude) const;
  double unit() const;

  /// The most that a flat circle lies below the ground's curve, from the square of its radius.
  double sag(double radius2) const { return grid_.is_flat() ? 0 : radius2 / (2 * globe_.least_radius()); }
  /// Like Globe's; on the plane there is no horizon: 0, 0, 0.
  Space horizon_point(const Space& centre, std::span<const Space> points) const;

 private:
  TileGrid grid_;
  Globe globe_;
};

}  // namespace scarp
