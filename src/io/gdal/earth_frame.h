// Frames in space: earth-centred coordinates, and the tangent plane at a raster's centre.
#pragma once

#include <string>

#include "io/gdal/crs.h"
#include "io/raster/height_unit.h"
#include "scarp/height_field.h"

namespace scarp::gdal {

struct Georeference;

/// A CRS of three dimensions, x (east, longitude) before y (north, latitude) before heights.
struct SpaceCrs {
  Crs crs;                      ///< null if there is none
  std::string vertical;         ///< zero of its heights, such as "EGM96 height"; empty: unknown
  HeightUnit unit;              ///< unit of its heights; empty name: unknown
  bool is_ellipsoidal = false;  ///< they are above the ellipsoid
  bool is_down = false;         ///< they are depths: the vertical axis points down
};
SpaceCrs space_crs_of(const Crs& declared);

/// The frame in space that `wanted` names. REQUIRES: is_in_space().
/// Warnings go to `info`. kUsage if there is no way from the raster's CRS, and for
/// rasters that reach around a pole or the earth.
Result<Frame> earth_frame(const Georeference& georeference, const std::string& wanted, RasterInfo& info);

}  // namespace scarp::gdal
