// What tiles are made of, and how: the options of tile and tile-plan.
#pragma once

#include <memory>
#include <string>

#include "options/options.h"
#include "scarp/tile_job.h"

namespace CLI {
class App;
}

namespace scarp::cli {

/// A raster that is open, and the job of making its tiles.
struct OpenedJob {
  std::unique_ptr<GlobeRaster> raster;
  TileJob job;
};

struct TileArguments {
  RasterArguments raster;  ///< the paths are arguments of their own
  Given max_error, quality, zoom, cells, effort, vertical, background, format;

  void add_to(CLI::App& command);
  /// Fails as the options, GlobeRaster::open() and plan_pyramid() do.
  Result<OpenedJob> open(const ProgressCallback& progress) const;

 private:
  Result<PyramidSettings> parse_settings() const;
};

}  // namespace scarp::cli
