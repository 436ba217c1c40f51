// Tiles announced by implicit tiling: subtrees of 3D Tiles 1.1.
#pragma once

#include "io/mesh/glb_json.h"
#include "io/tiles/set_claims.h"

namespace scarp {

/// Adds the tiles of all subtrees of the tileset, with their known facts. Unreadable parts are added to the faults.
void read_subtrees(const TileSetReader& set, const Json& tileset, SetClaims& claims);

}  // namespace scarp
