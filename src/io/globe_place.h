// The position of a raster on the globe, and the reference of its heights, from its CRS.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "scarp/height_field.h"
#include "scarp/result.h"
#include "scarp/tile.h"
#include "scarp/tile_job.h"
#include "scarp/tile_set.h"

#pragma GCC visibility push(default)

namespace scarp::io {

/// `path`: the raster's, for error messages. Without `datum.ellipsoid`, the ellipsoid is that of WGS 84, or that of the
/// CRS if it belongs to another planet (more than 1 % larger or smaller). Fails with kInput without a georeference or a
/// CRS, for heights not in metres, if PROJ cannot convert to longitude and latitude, and for a raster beyond 180° of a
/// cylindrical projection. Fails with kUsage if the reference of the heights is unknown or belongs to another planet,
/// or if PROJ's grid for it is not on this machine. Also fails as read_geoid() does.
Result<RasterOnGlobe> place_on_globe(const RasterInfo& info, int cols, int rows, const Datum& datum,
                                     const std::string& path);

/// Fails with kInput unless heights are in metres (ReadOptions::heights_in).
Result<void> check_metres(const RasterInfo& info, const std::string& path);

/// The grid of tiles for a raster: local if the raster has no position, no CRS, or a local CRS.
GridKind grid_for(const RasterInfo& info);

/// `cell_size`: metres, for a raster without a position. Heights do not change; `datum` determines the height of the
/// whole plane. kAuto means kNone if the CRS does not declare a reference of heights. Fails with kInput for a raster
/// that is in degrees, rotated or mirrored in its CRS, and if cells are in metres but heights are not. Fails with
/// kUsage for a datum unsuitable for the raster, and as place_on_globe() does.
Result<RasterOnPlane> place_on_plane(const RasterInfo& info, int cols, int rows, const std::optional<double>& cell_size,
                                     const Datum& datum);
/// REQUIRES: the raster has a position in a projected CRS.
Result<PlaneOnGlobe> find_plane_on_globe(const RasterInfo& info, const LocalRaster& raster, const RasterOnGlobe& globe);
/// True if the raster's CRS cannot be converted to the globe, like that of a building site.
bool is_local_crs(const RasterInfo& info);

/// A reference surface of heights.
struct Zero {
  std::shared_ptr<const HeightZero> heights;
  double reach = 0;  ///< largest distance from the ellipsoid, metres
};
/// Reads a whole geoid raster into memory: 4 bytes per node. Fails with kInput if it cannot be read, and with kUsage if
/// it is on another globe than `globe` or, on the earth, has heights impossible for a geoid.
Result<Zero> read_geoid(const Datum& datum, const RasterOnGlobe& globe);

}  // namespace scarp::io

#pragma GCC visibility pop
