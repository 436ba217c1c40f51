// Compares a tile's decoded mesh with its nodes.
#pragma once

#include <cstdint>
#include <vector>

#include "scarp/tile.h"
#include "tiles/mesh/tile_nodes.h"

namespace scarp::tiles {

struct NodeErrors {
  double largest = 0;           ///< largest |mesh − node| over all nodes that the mesh covers
  std::vector<SampleAt> worst;  ///< worst node of each triangle beyond the limit: the first in raster order
  std::uint64_t uncovered = 0;  ///< nodes in no triangle
};

/// Scans the nodes in each triangle, including its sides. Integer arithmetic ensures that no node between neighbours is
/// missed. REQUIRES: triangles are positive. Cost: some nanoseconds per node, and a hundred per triangle.
NodeErrors scan_nodes(const TerrainTile& tile, const TileNodes& nodes, double limit);

}  // namespace scarp::tiles
