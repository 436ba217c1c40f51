#include "session/reports/level_pages.h"

#include <fmt/format.h>

#include <utility>

#include "scarp/io.h"

namespace scarp::cli {
namespace {

Result<std::vector<std::uint8_t>> encode_level(const check::LevelMesh& level) {
  std::vector<std::vector<std::uint8_t>> files;
  for (const check::LevelTile& tile : level.tiles) {
    SCARP_TRY(auto&& glb,
              encode_glb(tile.mesh, {.compress = can_compress_glb(), .cell = level.cell, .base_color = tile.image}));
    files.push_back(std::move(glb));
  }
  return join_glbs(files);
}

}  // namespace

Result<std::vector<PageMesh>> encode_levels(const std::string& path, const std::vector<check::LevelMesh>& levels) {
  std::vector<PageMesh> meshes;
  for (const check::LevelMesh& level : levels) {
    SCARP_TRY(auto&& glb, encode_level(level));
    meshes.push_back({fmt::format("{}, level {}", path, level.z), level.tile_bytes, std::move(glb)});
  }
  return meshes;
}

}  // namespace scarp::cli
