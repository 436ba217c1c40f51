// Lakes and rivers that the mesh must hold.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scarp/features.h"
#include "session/inputs/memory.h"
#include "session/options/line_options.h"
#include "session/text/json.h"

namespace scarp::cli {

/// Makes the lakes of --water flat, or finds those of --detect-flats, and reads the lines of --rivers. `memory`:
/// without that of the lakes.
Result<void> read_waters(const LineArguments& given, const ProgressCallback& progress, const MemoryShare& memory,
                         OwnedHeightField& field, Features& features, std::vector<std::string>& warnings);

/// Bytes that the field keeps for the lakes, where its samples are not in memory as one array.
std::uint64_t bytes_of(const std::vector<Lake>& lakes);

/// Warns of lines that are no rivers.
void warn_of_dry_lines(const Features& features, const std::vector<River>& rivers, std::vector<std::string>& warnings);

/// The "water" and "rivers" lists of a report.
Json describe_lakes(const std::vector<Lake>& lakes);
Json describe_rivers(const std::vector<River>& rivers);
/// Of the summary; empty without lakes and rivers.
std::string waters_lines(const std::vector<Lake>& lakes, const std::vector<River>& rivers);

}  // namespace scarp::cli
