// Sources and settings of tiles: the options of tile, tile plan and serve.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scarp/tile.h"
#include "scarp/tile_job.h"
#include "session/options/raster_options.h"

namespace scarp::cli {

/// The box of --only in degrees; its east exceeds 180 if it crosses the antimeridian. Fails with kUsage.
Result<std::optional<DegreeBox>> parse_box(const GivenOptions& given);

/// Enclosed voids of at most this many samples a side are filled, unless --nodata-policy differs.
inline constexpr int kVoidSide = 100;

/// A canonical spelling for each datum of --vertical, so that equal sets have equal bytes.
std::string vertical_word(const std::string& text);

Result<PyramidSettings> parse_tile_settings(const GivenOptions& given);
Result<Datum> parse_datum(const GivenOptions& given);
/// The options for reading rasters.
Result<ReadOptions> parse_tile_reading(const GivenOptions& given);
Result<WaterFiles> parse_waters(const GivenOptions& given);
Result<std::optional<TileDrape>> parse_tile_drape(const GivenOptions& given);
/// The grid of --grid; nothing if not given.
Result<std::optional<GridKind>> parse_grid(const GivenOptions& given);
/// The format of --of, or the default of the grid, which may still be unknown.
Result<TileFormat> parse_tile_format(const GivenOptions& given, std::optional<GridKind> grid_of_tiles);

}  // namespace scarp::cli
