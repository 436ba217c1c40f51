// The agreement of the processes of a plan of tiles: where parts lie, and how much memory a share has.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "scarp/tile_job.h"
#include "session/options/values.h"

namespace scarp::cli {

/// The raster's share of a process's memory, unless --memory sets it: a share of the blocks needs a part of the raster.
inline constexpr std::uint64_t kShareRasterBytes = 256'000'000;

/// --parts, or else a folder next to the plan: "world.parts" for "world.json".
inline std::string parts_folder(const std::string& plan, const Given& parts) {
  return parts ? *parts : std::filesystem::path(plan).replace_extension(".parts").string();
}
/// The same of a plan that was read: one that follows another uses the other's.
inline std::string parts_folder(const std::string& plan, const Given& parts, const TileJob& job) {
  return !parts && !job.parts.empty() ? job.parts : parts_folder(plan, parts);
}

}  // namespace scarp::cli
