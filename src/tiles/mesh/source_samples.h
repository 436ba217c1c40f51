// Compares a tile with the samples of its source, which are between the nodes.
#pragma once

#include <vector>

#include "scarp/tile.h"
#include "tiles/mesh/tile_nodes.h"
#include "tiles/mesh/tile_surface.h"

namespace scarp::tiles {

struct SampleVerdict {
  double error = 0;                  ///< largest error; NaN: the source has no samples
  std::vector<FarPoint> far_points;  ///< worst sample of each triangle beyond the limit
};

/// Ignores samples in a cell with a node that has no height. `nodes`: the tile's nodes. Fails like the source.
Result<SampleVerdict> judge_at_samples(const TerrainTile& tile, const TileGrid& grid, const TileNodes& nodes,
                                       const NodeSource& source,
                                       double limit = std::numeric_limits<double>::infinity());

}  // namespace scarp::tiles
