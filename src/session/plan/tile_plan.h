// What tiles are made of, and how: the options of tile and tile-plan.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scarp/tile_job.h"
#include "session/options/values.h"

namespace CLI {
class App;
}

namespace scarp::cli {

/// A raster that is open, and the job of making its tiles.
struct OpenedJob {
  std::unique_ptr<GlobeRaster> raster;
  TileJob job;
  std::vector<std::string> warnings = {};  ///< sentences about lines
};

/// The job's rasters. Fails as check_rasters() and GlobeRaster::open() do.
Result<OpenedJob> open_job(TileJob job, std::uint64_t memory, int threads);

/// "WEST,SOUTH,EAST,NORTH" in degrees. East of a box across the antimeridian is beyond 180. Fails with kUsage.
Result<std::optional<DegreeBox>> parse_box(const Given& text);

/// "geographic", "mercator", and "local" where that is taken. Fails with kUsage.
Result<GridKind> parse_grid(const std::string& text, bool takes_local);

/// Enclosed voids of at most so many samples a side are filled, unless --nodata-policy says otherwise.
inline constexpr int kVoidSide = 100;

struct TileArguments {
  RasterArguments raster;  ///< the paths are arguments of their own
  Given max_error, quality, zoom, grid, cells, effort, vertical, geoid, ellipsoid, background, nodata_policy,
      fill_distance, format, only;
  Given bound, max_tile_bytes, drape, drape_format, percentile;
  bool has_water_mask = false;
  bool takes_local = true;                             ///< a local grid
  std::vector<std::string> water, rivers, breaklines;  ///< FILE or FILE:LAYER
  Effort default_effort = Effort::kNormal;

  /// What the nodes are: how the raster is read, what its heights are above, and the lattice.
  void add_nodes_to(CLI::App& command);
  /// All that the command's rows name.
  void add_to(CLI::App& command);
  /// Rasters that follow those of an earlier plan, with its settings. Fails as follow_job() and open() do.
  Result<OpenedJob> follow(const TileJob& earlier, const ProgressCallback& progress) const;
  /// `memory`: bytes for the raster, 0 for any. Fails as the options, GlobeRaster::open() and plan_pyramid() do.
  Result<OpenedJob> open(const ProgressCallback& progress, std::uint64_t memory = 0) const;

 private:
  Result<PyramidSettings> parse_settings() const;
  Result<Datum> parse_datum() const;
  /// How the rasters are read.
  Result<ReadOptions> parse_reading() const;
  Result<WaterFiles> parse_waters() const;
  Result<std::optional<TileDrape>> parse_drape() const;
  /// The format of tiles of a grid, or of one that is not known yet. Fails with kUsage where options do not go
  /// together.
  Result<TileFormat> choose_format(std::optional<GridKind> grid_of_tiles) const;
};

}  // namespace scarp::cli
