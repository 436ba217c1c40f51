// The sources and settings of tiles: the options of tile, tile plan and serve.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scarp/tile.h"
#include "scarp/tile_job.h"
#include "session/options/raster_options.h"

namespace scarp::cli {

/// The box of --only in degrees. East of a box across the antimeridian is beyond 180. Fails with kUsage.
Result<std::optional<DegreeBox>> parse_box(const GivenOptions& given);

/// Enclosed voids of at most so many samples a side are filled, unless --nodata-policy asks otherwise.
inline constexpr int kVoidSide = 100;

/// One spelling for each datum of --vertical, so that equal sets have equal bytes.
std::string vertical_word(const std::string& text);

Result<PyramidSettings> parse_tile_settings(const GivenOptions& given);
Result<Datum> parse_datum(const GivenOptions& given);
/// How the rasters are read.
Result<ReadOptions> parse_tile_reading(const GivenOptions& given);
Result<WaterFiles> parse_waters(const GivenOptions& given);
Result<std::optional<TileDrape>> parse_tile_drape(const GivenOptions& given);
/// The kind that --grid names; nothing without.
Result<std::optional<GridKind>> parse_grid(const GivenOptions& given);
/// The format that --of names, or that of tiles of the grid, which need not be known yet.
Result<TileFormat> parse_tile_format(const GivenOptions& given, std::optional<GridKind> grid_of_tiles);

}  // namespace scarp::cli
