// Turns options of tiles into a job: opens rasters and plans the pyramid.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scarp/tile_job.h"
#include "session/options/tile_options.h"

namespace scarp::cli {

/// An open raster and the job of making its tiles.
struct OpenedJob {
  std::unique_ptr<GlobeRaster> raster;
  TileJob job;
  std::vector<std::string> warnings = {};  ///< about lines
};

/// Opens the job's rasters. Fails if check_rasters() or GlobeRaster::open() fails.
Result<OpenedJob> open_job(TileJob job, std::uint64_t memory, int threads);

/// Opens the rasters and plans the settings that the options name. `memory`: bytes for the raster; 0: unlimited. Fails
/// for invalid options, and if GlobeRaster::open() or plan_pyramid() fails.
Result<OpenedJob> open_tiles(const GivenOptions& given, const ProgressCallback& progress, std::uint64_t memory = 0);
/// Opens the rasters of a follow-up plan, with the settings of the earlier plan. Fails if follow_job() or open_tiles()
/// fails.
Result<OpenedJob> follow_tiles(const GivenOptions& given, const TileJob& earlier, const ProgressCallback& progress);

}  // namespace scarp::cli
