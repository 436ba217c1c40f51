// Conventions shared by the processes of a tile plan: the folder of parts and the memory of a share.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "scarp/tile_job.h"
#include "session/options/values.h"

namespace scarp::cli {

/// A process's default memory for the raster: a share of the blocks needs only a part of the raster.
inline constexpr std::uint64_t kShareRasterBytes = 256'000'000;

/// --parts, or else a folder next to the plan: "world.parts" for "world.json".
inline std::string parts_folder(const std::string& plan, const Given& parts) {
  return parts ? *parts : std::filesystem::path(plan).replace_extension(".parts").string();
}
/// The folder of a plan that was read: a follow-up plan uses the folder of the earlier plan.
inline std::string parts_folder(const std::string& plan, const Given& parts, const TileJob& job) {
  return !parts && !job.parts.empty() ? job.parts : parts_folder(plan, parts);
}

}  // namespace scarp::cli
