// Frames in space: earth-centred coordinates, and the tangent plane at a raster's centre.
#pragma once

#include <string>

#include "io/gdal/crs.h"
#include "io/raster/height_unit.h"
#include "scarp/height_field.h"

namespace scarp::gdal {

struct Georeference;

/// A three-dimensional CRS with axes in the order x (east, longitude), y (north, latitude), height.
struct SpaceCrs {
  Crs crs;                      ///< null if none
  std::string vertical;         ///< reference of its heights, such as "EGM96 height"; empty: unknown
  io::HeightUnit unit;          ///< unit of its heights; empty name: unknown
  bool is_ellipsoidal = false;  ///< heights are above the ellipsoid
  bool is_down = false;         ///< heights are depths: the vertical axis points down
};
SpaceCrs space_crs_of(const Crs& declared);

/// The frame in space named by `wanted`. REQUIRES: is_in_space().
/// Warnings are added to `info`. Fails with kUsage if the raster's CRS cannot be converted, or if the raster extends
/// around a pole or the earth.
Result<Frame> earth_frame(const Georeference& georeference, const std::string& wanted, RasterInfo& info);

}  // namespace scarp::gdal
