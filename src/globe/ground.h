// The ground of tiles: an ellipsoid, or the plane of a local grid. Positions are in the grid's degrees; see TileGrid.
#pragma once

#include "globe/globe.h"
#include "scarp/height_field.h"
#include "scarp/tile.h"

namespace scarp::globe {

class Ground {
 public:
  Ground(const TileGrid& grid, const Geodetic& ellipsoid) : grid_(grid), globe_(ellipsoid) {}

  /// In metres: earth-centred, or on the plane east, north and up from the sample at its centre.
  Space position(double longitude, double latitude, double height) const;

  struct Axes {
    Space east{}, north{}, up{};
  };
  Axes axes(double longitude, double latitude) const;
  /// Metres per unit of the ground: a radian on the ellipsoid, a cell on the plane. unit(): units per degree.
  Globe::Radii metres(double latitude) const;
  double unit() const;

  /// The largest depth of a flat circle of this squared radius below the curved ground.
  double sag(double radius2) const { return grid_.is_flat() ? 0 : radius2 / (2 * globe_.least_radius()); }
  /// Globe::horizon_point(); 0, 0, 0 on the plane, which has no horizon.
  Space horizon_point(const Space& centre, std::span<const Space> points) const;

 private:
  TileGrid grid_;
  Globe globe_;
};

}  // namespace scarp::globe
