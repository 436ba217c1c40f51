// Where a raster lies on the globe, and what its heights are above.
#pragma once

#include <memory>
#include <string>

#include "scarp/degrees.h"
#include "scarp/frame.h"
#include "scarp/height_field.h"
#include "scarp/result.h"
#include "scarp/tile.h"

#pragma GCC visibility push(default)

namespace scarp {

/// What heights are above.
enum class Vertical {
  kAuto,       ///< what the raster's CRS says
  kEllipsoid,  ///< the ellipsoid, as GPS gives them
  kEgm96,      ///< the geoid EGM96: the sea, as egm96() has it
};

/// Where a raster lies on the globe.
struct RasterOnGlobe {
  RasterPlace place;
  std::shared_ptr<const PointTransform> to_degrees;  ///< null where place.from_degrees is
  Geodetic ellipsoid;
  std::shared_ptr<const HeightZero> zero;  ///< of the heights; null where they are above the ellipsoid
  std::string vertical;                    ///< what the heights are above, in words
};

/// `path`: the raster's, for sentences. Fails with kInput without a georeference or a CRS, for heights that are not in
/// metres, where PROJ knows no way to longitude and latitude, and beyond 180° of a cylindrical projection; with kUsage
/// where nobody says what the heights are above, and where the geoid is not on this machine.
Result<RasterOnGlobe> place_on_globe(const RasterInfo& info, int cols, int rows, Vertical vertical,
                                     const std::string& path);

}  // namespace scarp

#pragma GCC visibility pop
