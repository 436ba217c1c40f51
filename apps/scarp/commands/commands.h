// The commands of the program. Each runs with the given options and fails with one sentence for the user.
// `command_line`: the user's input, for reports.
#pragma once

#include <string>

#include "scarp/result.h"
#include "session/options/given_options.h"

namespace scarp::cli {

/// Simplifies a raster or scattered points; also runs scarp classic.
Result<void> run_simplify(const GivenOptions& given, const std::string& command_line);
Result<void> run_simplify_points(const GivenOptions& given, const std::string& command_line);
/// Judges a mesh file against its raster or points.
Result<void> run_measure(const GivenOptions& given, const std::string& command_line);
Result<void> run_measure_points(const GivenOptions& given, const std::string& command_line);
/// Makes a page for browsers that shows a mesh and its errors.
Result<void> run_view(const GivenOptions& given, const std::string& command_line);
/// Makes a pyramid of terrain tiles.
Result<void> run_tile(const GivenOptions& given, const std::string& command_line);
/// Plans a tile job for many processes, makes a share of its blocks, and joins all parts into a tileset.
Result<void> run_tile_plan(const GivenOptions& given, const std::string& command_line);
Result<void> run_tile_run(const GivenOptions& given, const std::string& command_line);
Result<void> run_tile_finish(const GivenOptions& given, const std::string& command_line);
/// Proves that a finished tileset keeps its promises.
Result<void> run_tile_check(const GivenOptions& given, const std::string& command_line);
/// Serves a tileset, or tiles made on demand from a raster, over HTTP until a signal ends the server.
Result<void> run_serve(const GivenOptions& given, const std::string& command_line);
/// Prints facts about a raster, points or a mesh, and suitable max errors for a raster.
Result<void> run_info(const GivenOptions& given, const std::string& command_line);
/// Makes rasters of synthetic heights.
Result<void> run_generate(const GivenOptions& given, const std::string& command_line);
/// Explains a command and its options.
Result<void> run_help(const GivenOptions& given, const std::string& command_line);
Result<void> run_version(const GivenOptions& given, const std::string& command_line);

}  // namespace scarp::cli
