// The report on a finished set of tiles, in words and as JSON.
#pragma once

#include <string>
#include <vector>

#include "scarp/tile_job.h"
#include "session/text/json.h"

namespace scarp::cli {

/// The set, and "levels": one object a level.
void add_tiles(Json& json, const TileJob& job, const std::string& output, const PyramidReport& report);
/// A length of the tiles, with its unit; that of a local grid's cells may be none that anybody knows.
std::string format_length(const TileJob& job, double length);
/// Lines about a local grid, for summaries; "" for others.
std::string grid_lines(const TileJob& job);
/// The line of a summary about lakes and rivers; empty without water.
std::string waters_line(const TileJob& job);
/// A table of the levels, with what was read and written above it, and the time below.
std::string make_tile_summary(const TileJob& job, const std::string& output, const PyramidReport& report,
                              double seconds);
/// Warnings about a raster, except those about frames that tiles do not have.
std::vector<std::string> warnings_of_raster(const GlobeRaster& raster);
/// The cost that the plan expected, the cost of the set, and their ratio; null without an expectation.
Json compare_model(const TileJob& job, const PyramidReport& report, const PartsCost& cost);
/// The same as a line of the summary; empty without an expectation.
std::string summarize_model(const TileJob& job, const PyramidReport& report, const PartsCost& cost);
/// Warnings about levels whose tiles do not keep the max error.
std::vector<std::string> warnings_of_levels(const PyramidPlan& plan, const PyramidReport& report);
/// Fails with kUsage where no node has a height.
Result<void> check_heights(const TileJob& job, const PyramidReport& report);

}  // namespace scarp::cli
