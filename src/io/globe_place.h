// Finds the place of a raster on the globe, and the zero of its heights, from its CRS.
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

namespace scarp {

/// `path`: the raster's, for sentences. Fails with kInput without a georeference or a CRS, for heights that are not in
/// metres, where PROJ knows no way to longitude and latitude, and beyond 180° of a cylindrical projection; with kUsage
/// where the zero of the heights is unknown, where PROJ's grid of the zero is not on this machine, and for a zero of
/// another planet's; and as read_geoid() does. Without `datum.ellipsoid` the ellipsoid is that of WGS 84, or the CRS's
/// own if it is another planet's: more than 1 % larger or smaller.
Result<RasterOnGlobe> place_on_globe(const RasterInfo& info, int cols, int rows, const Datum& datum,
                                     const std::string& path);

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
