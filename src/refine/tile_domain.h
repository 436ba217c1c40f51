// The triangulation of a tile before any refinement.
#pragma once

#include <span>

#include "refine/tile.h"
#include "tin/tile_mesh.h"

namespace scarp {

/// Two triangles over the tile, with the outline of its valid data constrained where it has nodata, and `border`
/// (points on its sides) inserted. A part that is no surface is outside; that may be everything. Fails with kInternal
/// if edges of the outline cross.
Result<void> start_tile(const Tile& tile, std::span<const TilePoint> border, TileMesh& mesh);

}  // namespace scarp
