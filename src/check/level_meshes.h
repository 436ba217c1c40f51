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

namespace scarp::check {

struct LevelTile {
  /// On a flat map: x and y are metres east and north of the middle, where the scale is true; z is the tiles' height.
  /// Adjacent tiles have separate vertices at identical positions. The metadata contain `tile_level`.
  Mesh mesh;
  GlbImage image;  ///< draped over the mesh by the mesh's uvs; empty if absent
};

/// The tiles of a level next to each other, as clients decode them.
struct LevelMesh {
  int z = 0;
  std::vector<LevelTile> tiles;  ///< tiles without an image first
  /// Steps of x and y in metres, each a power of two: the smallest ones for which differences in a tile fit 16 bits.
  /// Heights have their own step. Used as GlbOptions::cell for a small file.
  std::array<double, 2> cell{};
  std::uint64_t tile_bytes = 0;  ///< stored size
};

/// The finest level with at most `most_bytes` in all its tiles, then coarser levels of the same area while the total
/// fits. Stops when tiles are more than four times as wide or as high as the whole finest level. Fails with kInput for
/// damaged tiles, and with kUsage if no level is small enough. Cost: O(tiles read).
Result<std::vector<LevelMesh>> read_level_meshes(const TileSetReader& set, std::uint64_t most_bytes);

/// Sentences about differences between the set and its metadata: missing or unannounced tiles, an invalid layer.json or
/// tileset.json. Empty for an intact set. Reads no tile. Cost: O(tiles).
std::vector<std::string> find_set_faults(const TileSetReader& set);

}  // namespace scarp::check

#pragma GCC visibility pop
