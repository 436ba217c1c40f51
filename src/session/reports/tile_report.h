// The report on a finished tileset as text and JSON.
#pragma once

#include <string>
#include <vector>

#include "scarp/tile_job.h"
#include "session/text/json.h"

namespace scarp::cli {

/// Adds the set and "levels": one object per level.
void add_tiles(Json& json, const TileJob& job, const std::string& output, const PyramidReport& report);
/// A length of the tiles with its unit; the unit of a local grid may be unknown.
std::string format_length(const TileJob& job, double length);
/// Summary lines about a local grid; "" for others.
std::string grid_lines(const TileJob& job);
/// Summary line about lakes and rivers; empty without water.
std::string waters_line(const TileJob& job);
/// A table of the levels, with input and output above and the time below. `points_line`: about points as input, or "".
std::string make_tile_summary(const TileJob& job, const std::string& output, const PyramidReport& report,
                              double seconds, const std::string& points_line = "");
/// Warnings about a raster, except those about a mesh's frame.
std::vector<std::string> warnings_of_raster(const GlobeRaster& raster);
/// The expected cost, the actual cost and their ratio; null without an expectation.
Json compare_model(const TileJob& job, const PyramidReport& report, const PartsCost& cost);
/// Like compare_model(), as a line of the summary; empty without an expectation.
std::string summarize_model(const TileJob& job, const PyramidReport& report, const PartsCost& cost);
/// Warnings about levels whose tiles exceed the max error.
std::vector<std::string> warnings_of_levels(const PyramidPlan& plan, const PyramidReport& report);
/// Fails with kUsage if no node has a height.
Result<void> check_heights(const TileJob& job, const PyramidReport& report);

}  // namespace scarp::cli
