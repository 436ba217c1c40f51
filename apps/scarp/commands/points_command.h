// simplify and measure where the input is scattered points instead of a raster.
#pragma once

#include <string>

#include "session/options/measure_options.h"
#include "session/options/points_options.h"
#include "session/options/simplify_options.h"

namespace CLI {
class App;
}

namespace scarp::cli {

/// `command` is asked which options were given: those for rasters are refused by name. `command_line` is what the user
/// typed, for the report.
Result<void> run_simplify_points(const CLI::App& command, const SimplifyArguments& given, const PointsArguments& points,
                                 const std::string& command_line);
Result<void> run_measure_points(const CLI::App& command, const MeasureArguments& given,
                                const std::string& command_line);

}  // namespace scarp::cli
