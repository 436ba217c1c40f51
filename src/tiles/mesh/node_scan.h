// Compares a tile's decoded mesh with its nodes.
#pragma once

#include <cstdint>
#include <vector>

#include "scarp/tile.h"
#include "tiles/mesh/tile_nodes.h"

namespace scarp {

struct NodeErrors {
  double largest = 0;           ///< |mesh − node|, of all nodes that the mesh covers
  std::vector<SampleAt> worst;  ///< worst node of each triangle, where it is beyond the limit: the first in raster
                                ///< order
  std::uint64_t uncovered = 0;  ///< nodes in no triangle
};

/// Whole numbers decide which nodes lie in a triangle, its sides included, so that none is missed between two
/// neighbours. REQUIRES: triangles are positive. Cost: some nanoseconds a node, and a hundred a triangle.
NodeErrors scan_nodes(const TerrainTile& tile, const TileNodes& nodes, double limit);

}  // namespace scarp
