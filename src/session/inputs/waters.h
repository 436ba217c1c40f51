// Lakes and rivers that the mesh must hold.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scarp/features.h"
#include "session/inputs/memory.h"
#include "session/options/line_options.h"

namespace scarp::cli {

/// Makes the lakes of --water flat, or finds those of its flats=N, and reads the lines of --rivers. `memory`:
/// without that of the lakes.
Result<void> read_waters(const GivenOptions& given, const ProgressCallback& progress, const MemoryShare& memory,
                         OwnedHeightField& field, Features& features, std::vector<std::string>& warnings);

/// Bytes that the field keeps for the lakes, where its samples are not in memory as one array.
std::uint64_t bytes_of(const std::vector<Lake>& lakes);

}  // namespace scarp::cli
