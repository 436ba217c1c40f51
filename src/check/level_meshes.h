// Sets of tiles as plain meshes, to view.
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
  /// On a flat map: metres east and north of the middle, true to scale there, and heights of the tiles. Where tiles
  /// meet each has its own vertex, at the very same place. Its metadata hold `tile_level`.
  Mesh mesh;
  GlbImage image;  ///< draped over the mesh by its uvs; empty without one
};

/// The tiles of a level side by side, as clients decode them.
struct LevelMesh {
  int z = 0;
  std::vector<LevelTile> tiles;  ///< first those without an image
  /// Metres that x and y are multiples of, a power of two each; heights are of a third. They are the least that give a
  /// difference within a tile 16 bits: GlbOptions::cell for a small file.
  std::array<double, 2> cell{};
  std::uint64_t tile_bytes = 0;  ///< size as they are kept
};

/// The finest level whose tiles have at most `most_bytes` together, then coarser ones of the same place as long as all
/// together do, until their tiles are more than four times as wide or as high as all of the set's finest level. Fails
/// with kInput for tiles that are damaged, and with kUsage where no level is so small. Cost: O(tiles that are read).
Result<std::vector<LevelMesh>> read_level_meshes(const TileSetReader& set, std::uint64_t most_bytes);

/// Sentences about contents of the set that differ from its metadata: tiles that are missing or not announced, a
/// layer.json or tileset.json that makes no sense. Empty of a whole set. Cost: O(tiles), none of which is read.
std::vector<std::string> find_set_faults(const TileSetReader& set);

}  // namespace scarp

#pragma GCC visibility pop
