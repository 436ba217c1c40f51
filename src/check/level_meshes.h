// Tile sets as plain meshes, for viewing.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "scarp/io.h"
#include "scarp/mesh.h"
#include "scarp/result.h"
#include "scarp/tile_set.h"

#pragma GCC visibility push(default)

namespace scarp {

/// A tile.
struct LevelTile {
  /// On a flat map: metres east and north of the middle, true to scale there, and the tiles' heights. Tiles that meet
  /// have separate vertices at identical positions. Metadata hold `tile_level`.
  Mesh mesh;
  GlbImage image;  ///< draped over the mesh by its uvs; empty if absent
};

/// The tiles of a level next to each other, as clients decode them.
struct LevelMesh {
  int z = 0;
  std::vector<LevelTile> tiles;  ///< those without an image first
  /// Metres of which x and y are multiples, each a power of two; heights have a third. The smallest steps for which
  /// differences in a tile fit 16 bits: GlbOptions::cell for a small file.
  std::array<double, 2> cell{};
  std::uint64_t tile_bytes = 0;  ///< stored size
};

/// The finest level whose tiles have at most `most_bytes` together, then coarser levels of the same area while the
/// total fits. Stops when tiles are more than four times as wide or as high as the whole finest level. Fails with
/// kInput for damaged tiles, and with kUsage where no level is small enough. Cost: O(tiles read).
Result<std::vector<LevelMesh>> read_level_meshes(const TileSetReader& set, std::uint64_t most_bytes);

/// Sentences about differences between the set and its metadata: tiles missing or not announced, an invalid layer.json
/// or tileset.json. Empty for an intact set. Reads no tile. Cost: O(tiles).
std::vector<std::string> find_set_faults(const TileSetReader& set);

}  // namespace scarp

#pragma GCC visibility pop
