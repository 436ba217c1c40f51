// The place of a raster on the globe, and the zero of its heights.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scarp/degrees.h"
#include "scarp/frame.h"
#include "scarp/geoid.h"
#include "scarp/tile_set.h"

#pragma GCC visibility push(default)

namespace scarp {

/// The zero of heights.
enum class Vertical {
  kAuto,       ///< the zero that the raster's CRS names
  kEllipsoid,  ///< the ellipsoid, as GPS gives them
  kEgm96,      ///< the geoid EGM96: the sea, as egm96() has it
  kEpsg,       ///< a vertical CRS of EPSG's, by PROJ and its grids
  kGeoid,      ///< a surface that a raster holds
  kNone,       ///< unknown: heights are used as they are, as if above the ellipsoid
};

/// The user's statement about a raster's heights and about its globe.
struct Datum {
  Vertical vertical = Vertical::kAuto;
  int epsg = 0;            ///< code for kEpsg: 3855 is EGM2008
  std::string geoid = {};  ///< file for kGeoid: a raster of the surface's heights above the ellipsoid, in metres (GTX,
                           ///< GeoTIFF, …)
  /// In place of the CRS's: longitude and latitude are the raster's own, on this one.
  std::optional<Geodetic> ellipsoid = std::nullopt;
};

/// The position of a raster on the globe.
struct RasterOnGlobe {
  RasterPlace place;
  std::shared_ptr<const PointTransform> to_degrees;  ///< null where place.from_degrees is
  std::string degrees;                               ///< the CRS of longitude and latitude, as RasterInfo::crs
  Geodetic ellipsoid;
  std::string body;                        ///< whose ellipsoid, in the CRS's words; empty for WGS 84
  std::shared_ptr<const HeightZero> zero;  ///< zero of the heights; null where they are above the ellipsoid
  double zero_reach = 0;                   ///< metres that the zero is from the ellipsoid, at most
  std::string vertical;                    ///< the zero of the heights, in words
};

/// A raster on a plane.
struct RasterOnPlane {
  double cell_x = 1, cell_y = 1;
  std::string units;                  ///< unit of cell_x and cell_y: "metre", "cell", or "unit of the raster's x and y"
  std::string vertical;               ///< the zero of the heights, in words
  std::optional<PlaneOnGlobe> globe;  ///< nothing for a raster that has no place there
  Geodetic ellipsoid;                 ///< ellipsoid that the plane touches, with `globe`
  std::string body;                   ///< whose, as RasterOnGlobe::body
  std::vector<std::string> warnings;  ///< warns if the plane lies far from its place on the globe
  /// Likewise: where each sample lies.
  std::optional<RasterOnGlobe> samples = std::nullopt;
};

}  // namespace scarp

#pragma GCC visibility pop
