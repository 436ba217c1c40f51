// Lines and areas in the mesh: objects of a report, lines of a summary, and warnings.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scarp/features.h"
#include "scarp/io.h"
#include "scarp/simplify.h"
#include "session/inputs/cutline.h"
#include "session/options/given_options.h"
#include "session/text/json.h"
#include "simplify/zones.h"

namespace scarp::cli {

/// The "breaklines" object of a report; null without lines.
Json describe_lines(const GivenOptions& given, const Simplified& simplified);
/// A line of the summary; empty without lines.
std::string lines_line(std::uint64_t lines, std::uint64_t inserted, const std::vector<SampleEdit>& edits);
/// Warns of breaklines and rivers that are farther from the raster than ten times `error`.
void warn_of_far_lines(const Simplified& simplified, double error, std::vector<std::string>& warnings);

/// Warns of lines that are not rivers.
void warn_of_dry_lines(const Features& features, const std::vector<River>& rivers, std::vector<std::string>& warnings);
/// The "water" and "rivers" lists of a report.
Json describe_lakes(const std::vector<Lake>& lakes);
Json describe_rivers(const std::vector<River>& rivers);
/// Lines of the summary; empty without lakes and rivers.
std::string waters_lines(const std::vector<Lake>& lakes, const std::vector<River>& rivers);

/// The "cliffs" object of a report; null without --cliff.
Json describe_cliffs(const GivenOptions& given, const std::optional<Cliffs>& cliffs);
/// A line of the summary; empty without --cliff.
std::string cliffs_line(const std::optional<Cliffs>& cliffs);
/// Warns if walls were requested but none was found.
void warn_of_missing_walls(const GivenOptions& given, const std::optional<Cliffs>& cliffs,
                           std::vector<std::string>& warnings);

/// The "ridges" object of a report; null without --ridges.
Json describe_ridges(const GivenOptions& given, const std::optional<Ridges>& ridges);
/// A line of the summary; empty without --ridges.
std::string ridges_line(const std::optional<Ridges>& ridges);
/// Warns if ridges were requested but none was found.
void warn_of_missing_ridges(const GivenOptions& given, const std::optional<Ridges>& ridges,
                            std::vector<std::string>& warnings);

/// The "cutline" object of a report; null without a cut. `outside`: samples outside that did not become nodata.
Json describe_cut(const GivenOptions& given, const Cut& cut, std::uint64_t outside);
/// "2 polygons, 1,234 samples outside left out".
std::string cut_words(const Cut& cut, std::uint64_t outside);

/// Adds "materials" and "node_strings" to a report; null if not requested.
void add_zones(Json& report, const GivenOptions& given, const MeshZones& zones);
/// Lines of the summary.
std::string zones_lines(const GivenOptions& given, const MeshZones& zones);

}  // namespace scarp::cli
