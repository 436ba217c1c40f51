// The triangulation of a tile before any refinement.
#pragma once

#include <span>

#include "refine/tile.h"
#include "tin/tile_mesh.h"

namespace scarp::refine {

/// Two triangles over the tile, with constrained edges along the outline of its valid data if it has nodata, and with
/// `border` (points on its sides) inserted. Parts that are not surface, possibly all, are outside. Fails with kInternal
/// if edges of the outline cross.
Result<void> start_tile(const Tile& tile, std::span<const geom::TilePoint> border, tin::TileMesh& mesh);

}  // namespace scarp::refine
