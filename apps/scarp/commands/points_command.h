// simplify and measure where the input is scattered points instead of a raster.
#pragma once

#include <string>
#include <vector>

#include "scarp/points.h"
#include "session/plan/simplify_plan.h"

namespace CLI {
class App;
}

namespace scarp::cli {

/// The options of every command that reads points.
struct PointsArguments {
  bool points = false;
  Given duplicates, layer, z_field, columns, boundary;

  void add_to(CLI::App& command);
  /// True if the input is to be read as points: it was asked for, or its name says so.
  bool are_meant(const std::string& path) const { return points || columns || is_point_file(path); }
  /// Fails if one of several inputs holds points, which make no mosaic.
  Result<void> check_single(const std::vector<std::string>& paths) const;
  /// Fails if an option for points was given, for an input that is a raster.
  Result<void> check_unused(const std::string& path) const;
};

/// What `scarp measure` was asked to do with points.
struct MeasurePointsArguments {
  RasterArguments input;  ///< of which some options are for points, too
  std::string mesh;
  Given fail_above, threads;
  bool json = false, quiet = false, json_progress = false;
};

/// `command` is asked which options were given: those for rasters are refused by name. `command_line` is what the user
/// typed, for the report.
Result<void> run_simplify_points(const CLI::App& command, const SimplifyArguments& given, const PointsArguments& points,
                                 const std::string& command_line);
Result<void> run_measure_points(const CLI::App& command, const MeasurePointsArguments& given,
                                const PointsArguments& points, const std::string& command_line);

}  // namespace scarp::cli
