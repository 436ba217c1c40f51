// Reads subtrees of 3D Tiles 1.1, which announce tiles by implicit tiling.
#pragma once

#include "io/mesh/glb_json.h"
#include "io/tiles/set_claims.h"

namespace scarp::io {

/// Adds the tiles of the tileset's subtrees, with their known facts. Unreadable parts become faults.
void read_subtrees(const TileSetReader& set, const Json& tileset, SetClaims& claims);

}  // namespace scarp::io
