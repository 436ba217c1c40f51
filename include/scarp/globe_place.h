// The position of a raster on the globe, and the zero of its heights.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scarp/degrees.h"
#include "scarp/frame.h"
#include "scarp/geoid.h"
#include "scarp/height_field.h"
#include "scarp/result.h"
#include "scarp/tile_grid.h"

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
  int epsg = 0;       ///< code for kEpsg: 3855 is EGM2008
  std::string geoid;  ///< file for kGeoid: a raster of the surface's heights above the ellipsoid, in metres (GTX,
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

/// `path`: the raster's, for sentences. Fails with kInput without a georeference or a CRS, for heights that are not in
/// metres, where PROJ knows no way to longitude and latitude, and beyond 180° of a cylindrical projection; with kUsage
/// where the zero of the heights is unknown, where PROJ's grid of the zero is not on this machine, and for a zero of
/// another planet's; and as read_geoid() does. Without `datum.ellipsoid` the ellipsoid is that of WGS 84, or the CRS's
/// own if it is another planet's: more than 1 % larger or smaller.
Result<RasterOnGlobe> place_on_globe(const RasterInfo& info, int cols, int rows, const Datum& datum,
                                     const std::string& path);

/// The position of a local grid's plane on the globe.
struct PlaneOnGlobe {
  /// From metres east, north and up of the sample at the raster's centre, as LocalRaster has it, to the earth's centre:
  /// 4 × 4, by columns. It is exact at the centre, where it has the projection's turn and scale.
  std::array<double, 16> transform{};
  std::string crs;                  ///< CRS of the raster, as RasterInfo::crs
  double convergence = 0;           ///< degrees from true north to the raster's, clockwise
  double scale_x = 1, scale_y = 1;  ///< scale of the projection there: metres of the plane to one on the ground
  /// Largest distance in metres from where the transform puts the raster to where it lies, along the ground and in
  /// height. Its causes are the earth's curve, and scale and turn away from the centre.
  double off_along = 0, off_height = 0;

  friend bool operator==(const PlaneOnGlobe&, const PlaneOnGlobe&) = default;
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

/// Fails with kInput where heights are in another unit than metres (ReadOptions::heights_in).
Result<void> check_metres(const RasterInfo& info, const std::string& path);

/// The grid of tiles that suits a raster: a local one where it has no position, no CRS, or a CRS of its own.
GridKind grid_for(const RasterInfo& info);

/// `cell_size`: metres, of a raster without a position. Heights stay as they are; `datum` gives the height of the whole
/// plane, and kAuto without a word in the CRS is kNone. Fails with kInput for rasters in degrees, and those that are
/// turned or mirrored in their CRS, and for heights that are not in metres where cells are; with kUsage for a datum
/// that does not go with such a raster; and as place_on_globe().
Result<RasterOnPlane> place_on_plane(const RasterInfo& info, int cols, int rows, const std::optional<double>& cell_size,
                                     const Datum& datum);
/// REQUIRES: a raster with a position, in a projected CRS.
Result<PlaneOnGlobe> find_plane_on_globe(const RasterInfo& info, const LocalRaster& raster, const RasterOnGlobe& globe);
/// True if a raster's CRS has no way to the globe, like those of building sites.
bool is_local_crs(const RasterInfo& info);

/// A surface that heights are above.
struct Zero {
  std::shared_ptr<const HeightZero> heights;
  double reach = 0;  ///< metres from the ellipsoid, at most
};
/// The whole raster: 4 bytes a node. Fails with kInput for what cannot be read, with kUsage for one of another globe
/// than `globe`'s, and on the earth for heights that no geoid has.
Result<Zero> read_geoid(const Datum& datum, const RasterOnGlobe& globe);

}  // namespace scarp

#pragma GCC visibility pop
