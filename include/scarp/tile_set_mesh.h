// Sets of tiles as plain meshes, to look at.
#pragma once

#include <cstdint>
#include <vector>

#include "scarp/mesh.h"
#include "scarp/result.h"
#include "scarp/tile_set.h"

#pragma GCC visibility push(default)

namespace scarp {

/// The tiles of a level beside each other, as clients decode them.
struct LevelMesh {
  int z = 0;
  /// On a flat map: metres east and north of the middle, true to scale there, and heights of the tiles. Vertices
  /// where tiles meet are not joined. Its metadata tell `tile_level`.
  Mesh mesh;
  std::uint64_t tile_bytes = 0;  ///< as they are kept
};

/// The finest level, then coarser ones of the same place, until their tiles are more than four times as wide or as high
/// as all of the finest level. Fails with kInput for tiles that are damaged, and with kUsage once the tiles take more
/// than `most_bytes`. Cost: O(tiles that are read).
Result<std::vector<LevelMesh>> read_level_meshes(const TileSetReader& set, std::uint64_t most_bytes);

}  // namespace scarp

#pragma GCC visibility pop
