// Compares a tile with the samples of its source, each at its own place between the nodes.
#pragma once

#include <vector>

#include "scarp/tile.h"
#include "tiles/mesh/tile_nodes.h"
#include "tiles/mesh/tile_surface.h"

namespace scarp {

struct SampleVerdict {
  double error = 0;                  ///< the largest; NaN: the source shows no samples
  std::vector<FarPoint> far_points;  ///< the worst of each triangle, of those beyond the limit
};

/// Samples in a cell with a node that has no height do not count. `nodes`: of the tile. Fails as the source does.
Result<SampleVerdict> judge_at_samples(const TerrainTile& tile, const TileGrid& grid, const TileNodes& nodes,
                                       const NodeSource& source,
                                       double limit = std::numeric_limits<double>::infinity());

}  // namespace scarp
