// From degrees to metres: the frame of a raster in longitude and latitude.
#pragma once

#include <array>
#include <memory>

#include "scarp/frame.h"
#include "scarp/result.h"

#pragma GCC visibility push(default)

namespace scarp {

/// The ellipsoid and the unit of longitude and latitude.
struct Geodetic {
  double semi_major = 6378137;                ///< semi-major axis of the ellipsoid, in metres, above 0. DEFAULT: WGS
                                              ///< 84.
  double inverse_flattening = 298.257223563;  ///< inverse flattening of the ellipsoid; 0: a sphere. DEFAULT: WGS 84.
  /// An x or y of 1 in radians. DEFAULT: a degree.
  double radians_per_unit = 0.017453292519943295;
};

/// Metres from the centre to a pole.
inline double semi_minor(const Geodetic& geodetic) {
  return geodetic.inverse_flattening == 0 ? geodetic.semi_major
                                          : geodetic.semi_major * (1 - 1 / geodetic.inverse_flattening);
}

/// Metres along the ground for one unit of x and one of y at a latitude (in units of y); 0, 0 at or beyond a pole.
std::array<double, 2> metres_of_unit(double latitude, const Geodetic& geodetic = {});

/// The local frame of a raster in degrees: metres east and north of its centre sample (cols / 2, rows / 2), which is at
/// 0, 0. `affine` maps samples to longitude and latitude, as Frame::affine does. Degrees become metres by two
/// constants, the ellipsoid's radii of curvature at the centre. So the frame is affine, and a promise on the grid holds
/// in the mesh. Lengths along the centre's parallel and meridian are true; elsewhere lengths from east to west are off
/// by cos φ_centre / cos φ. The cell is rounded so that each sample's x and y is exactly a float32: by less than 0.03 %
/// for 5,000 samples from the centre to the border. Needs no GDAL; read_height_field() makes the same frame from a
/// file's CRS.
///
/// Frame::kind is kLocal, Frame::crs is empty, Frame::description states the centre and the cell.
/// Fails with kUsage for fewer than 1 column or row, an affine map that is not finite, a centre at or beyond a pole,
/// and cells too unequal for float32. Cost: O(1).
Result<Frame> frame_of_degrees(const std::array<double, 6>& affine, int cols, int rows, const Geodetic& geodetic = {});

/// The position of a raster on the globe, and the meaning of its samples.
struct RasterPlace {
  /// From samples to the CRS's x and y, as Frame::affine.
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};
  /// From longitude and latitude in degrees to x and y. Null: x and y are longitude and latitude.
  std::shared_ptr<const PointTransform> from_degrees = nullptr;
  /// The inverse. Null where from_degrees is; without it no samples are shown.
  std::shared_ptr<const PointTransform> to_degrees = nullptr;
};

}  // namespace scarp

#pragma GCC visibility pop
