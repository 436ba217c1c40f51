// Levels of a tileset for the viewer's page.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "check/level_meshes.h"
#include "session/reports/view_page.h"

namespace scarp::cli {

/// Maximum bytes of a level's tiles: a larger page opens too slowly.
inline constexpr std::uint64_t kMostTileBytes = 8'000'000;

/// A mesh for each level of the set `path`. Fails if encode_glb() fails.
Result<std::vector<PageMesh>> encode_levels(const std::string& path, const std::vector<check::LevelMesh>& levels);

}  // namespace scarp::cli
