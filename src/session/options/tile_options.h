// The sources and settings of tiles: the options of tile, tile plan and serve.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scarp/pyramid.h"
#include "scarp/tile_job.h"
#include "session/options/raster_options.h"
#include "session/options/values.h"

namespace CLI {
class App;
}

namespace scarp::cli {

/// "WEST,SOUTH,EAST,NORTH" in degrees. East of a box across the antimeridian is beyond 180. Fails with kUsage.
Result<std::optional<DegreeBox>> parse_box(const Given& text);

/// "geographic", "mercator", and "local" where that is accepted. Fails with kUsage.
Result<GridKind> parse_grid(const std::string& text, bool takes_local);

/// Enclosed voids of at most so many samples a side are filled, unless --nodata-policy asks otherwise.
inline constexpr int kVoidSide = 100;

/// One spelling for each datum of --vertical, so that equal sets have equal bytes.
std::string vertical_word(const std::string& text);

struct TileArguments {
  RasterArguments raster;  ///< the paths are arguments of their own
  Given max_error, quality, zoom, grid, cells, effort, vertical, geoid, ellipsoid, background, nodata_policy,
      fill_distance, format, only;
  Given bound, max_tile_bytes, drape, drape_format, percentile;
  bool has_water_mask = false;
  bool takes_local = true;                             ///< a local grid
  std::vector<std::string> water, rivers, breaklines;  ///< FILE or FILE:LAYER
  Effort default_effort = Effort::kNormal;

  /// Adds the options for nodes: how the raster is read, the zero of its heights, and the lattice.
  void add_nodes_to(CLI::App& command);
  /// All that the command's rows name.
  void add_to(CLI::App& command);

  Result<PyramidSettings> parse_settings() const;
  Result<Datum> parse_datum() const;
  /// How the rasters are read.
  Result<ReadOptions> parse_reading() const;
  Result<WaterFiles> parse_waters() const;
  Result<std::optional<TileDrape>> parse_drape() const;
  /// The kind that --grid names; nothing without.
  Result<std::optional<GridKind>> parse_kind() const;
  /// The format that --of names, or that of tiles of the grid, which need not be known yet.
  Result<TileFormat> parse_format(std::optional<GridKind> grid_of_tiles) const;
};

}  // namespace scarp::cli
