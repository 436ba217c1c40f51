// The commands of the program. Each runs with the options that were given; `command_line` is what the user typed, for
// reports. Fails with one sentence for the user.
#pragma once

#include <string>

#include "scarp/result.h"
#include "session/options/given_options.h"

namespace scarp::cli {

/// One raster, or scattered points, to one mesh; scarp classic, too.
Result<void> run_simplify(const GivenOptions& given, const std::string& command_line);
Result<void> run_simplify_points(const GivenOptions& given, const std::string& command_line);
/// A mesh file judged by its raster or points.
Result<void> run_measure(const GivenOptions& given, const std::string& command_line);
Result<void> run_measure_points(const GivenOptions& given, const std::string& command_line);
/// A page that shows a mesh and its errors, for a browser.
Result<void> run_view(const GivenOptions& given, const std::string& command_line);
/// A pyramid of terrain tiles.
Result<void> run_tile(const GivenOptions& given, const std::string& command_line);
/// A job of tiles that many processes share; a share of its blocks; the set of tiles, of all parts.
Result<void> run_tile_plan(const GivenOptions& given, const std::string& command_line);
Result<void> run_tile_run(const GivenOptions& given, const std::string& command_line);
Result<void> run_tile_finish(const GivenOptions& given, const std::string& command_line);
/// The promises of a finished set of tiles, proven.
Result<void> run_tile_check(const GivenOptions& given, const std::string& command_line);
/// A set of tiles over HTTP, or the tiles of a raster as they are asked for. Returns once a signal asks to stop.
Result<void> run_serve(const GivenOptions& given, const std::string& command_line);
/// The contents of a raster, points or a mesh, and the errors that suit a raster.
Result<void> run_info(const GivenOptions& given, const std::string& command_line);
/// Synthetic height fields as rasters.
Result<void> run_generate(const GivenOptions& given, const std::string& command_line);
/// The text that explains a command and its options.
Result<void> run_help(const GivenOptions& given, const std::string& command_line);
Result<void> run_version(const GivenOptions& given, const std::string& command_line);

}  // namespace scarp::cli
