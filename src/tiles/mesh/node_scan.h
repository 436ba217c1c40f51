// Compares a tile's decoded mesh with its nodes.
#pragma once

#include <cstdint>
#include <vector>

#include "scarp/tile.h"
#include "tiles/mesh/tile_nodes.h"

namespace scarp {

struct NodeErrors {
  double largest = 0;           ///< largest |mesh − node| over all nodes that the mesh covers
  std::vector<SampleAt> worst;  ///< worst node of each triangle beyond the limit: the first in raster order
  std::uint64_t uncovered = 0;  ///< nodes in no triangle
};

/// Integers decide which nodes lie in a triangle, its sides included: none is missed between neighbours. REQUIRES:
/// triangles are positive. Cost: some nanoseconds a node, and a hundred a triangle.
NodeErrors scan_nodes(const TerrainTile& tile, const TileNodes& nodes, double limit);

}  // namespace scarp
