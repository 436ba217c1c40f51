// The options of `scarp simplify`, as they were given.
#pragma once

#include <string>

#include "session/options/channel_options.h"
#include "session/options/cliff_options.h"
#include "session/options/companion_options.h"
#include "session/options/cutline_options.h"
#include "session/options/image_options.h"
#include "session/options/level_options.h"
#include "session/options/line_options.h"
#include "session/options/memory_options.h"
#include "session/options/raster_options.h"
#include "session/options/ridge_options.h"
#include "session/options/shape_options.h"
#include "session/options/solid_options.h"
#include "session/options/strategy_options.h"
#include "session/options/values.h"
#include "session/options/zone_options.h"

namespace CLI {
class App;
}

namespace scarp::cli {

struct SimplifyArguments {
  RasterArguments raster;
  std::string output;
  Given max_error, max_triangles, max_points;
  Given nodata_policy, fill_distance, background, outline_tolerance;
  Given format, up, base, preview, render, error_raster, html, report, threads;
  LevelArguments levels;
  StrategyArguments strategy;
  CompanionArguments companions;
  ChannelArguments channels;
  LineArguments lines;
  CliffArguments cliff;
  RidgeArguments ridges;
  CutlineArguments cut;
  ZoneArguments zones;
  ShapeArguments shape;
  MemoryArguments memory;
  SolidArguments solid;
  ImageArguments images;
  bool normals = false, uvs = false, compress = false, doubles = false;
  bool overwrite = false, quiet = false, timing = false, json_progress = false;

  void add_to(CLI::App& command);
  /// The command for the mesh's metadata: options in a fixed order and with their long names, folders omitted, and
  /// without what cannot change the mesh (threads, quietness, other outputs, the output's name).
  std::string canonical() const;
};

}  // namespace scarp::cli
