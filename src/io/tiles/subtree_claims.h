// Tiles that implicit tiling announces: subtrees of 3D Tiles 1.1.
#pragma once

#include "io/mesh/glb_json.h"
#include "io/tiles/set_claims.h"

namespace scarp {

/// Adds the tiles of all subtrees that the tileset leads to, with what is known of each. A part that cannot be read is
/// among the faults.
void read_subtrees(const TileSetReader& set, const Json& tileset, SetClaims& claims);

}  // namespace scarp
