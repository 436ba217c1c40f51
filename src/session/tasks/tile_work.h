// scarp tile without its terminal: from rasters to a finished set.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "session/options/tile_options.h"
#include "session/plan/tile_plan.h"
#include "session/tasks/points_raster.h"
#include "session/text/tile_counts.h"

namespace scarp::cli {

struct MadeTiles {
  std::unique_ptr<PointsRaster> points;  ///< set for scattered points
  OpenedJob opened;
  PyramidReport report;
  std::vector<std::string> warnings;
};

/// Fails with kUsage for a set that the container cannot describe.
Result<void> check_container(const TileJob& job, const std::string& output);

/// Makes the set under its final name, or no set. Updates the tile counts meanwhile.
Result<MadeTiles> make_tiles(const GivenOptions& tiles, const std::string& output, bool overwrite, const Run& run,
                             TileCounts& counts);

}  // namespace scarp::cli
