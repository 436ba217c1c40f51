// The options of `scarp measure`, as they were given.
#pragma once

#include <string>

#include "session/options/channel_options.h"
#include "session/options/companion_options.h"
#include "session/options/cutline_options.h"
#include "session/options/memory_options.h"
#include "session/options/points_options.h"
#include "session/options/raster_options.h"
#include "session/options/values.h"

namespace CLI {
class App;
}

namespace scarp::cli {

struct MeasureArguments {
  RasterArguments raster;  ///< or points
  PointsArguments points;
  std::string mesh;
  CompanionArguments companions;
  CutlineArguments cut;
  ChannelArguments channels;
  MemoryArguments memory;
  Given up, map, error_raster, fail_above, threads;
  bool json = false, overwrite = false, quiet = false, json_progress = false;

  void add_to(CLI::App& command);
  /// True if the input is points.
  bool are_points() const { return points.are_meant(raster.path()); }
};

}  // namespace scarp::cli
