// Lakes and rivers that become part of the mesh.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scarp/features.h"
#include "session/inputs/memory.h"
#include "session/options/line_options.h"

namespace scarp::cli {

/// Flattens the lakes of --water, or finds lakes for its part flats=N, and reads the lines of --rivers. `memory`:
/// without the lakes' share.
Result<void> read_waters(const GivenOptions& given, const ProgressCallback& progress, const MemoryShare& memory,
                         OwnedHeightField& field, Features& features, std::vector<std::string>& warnings);

/// Bytes of the lakes for a field whose samples are not in memory as one array.
std::uint64_t bytes_of(const std::vector<Lake>& lakes);

}  // namespace scarp::cli
