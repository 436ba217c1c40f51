// Comparison of tiles with their source nodes.
#pragma once

#include <cstdint>
#include <vector>

#include "check/space.h"
#include "io/tiles/set_claims.h"
#include "scarp/tile_set.h"

namespace scarp::check {

/// Compares each node under each tile of the set with the tile's triangles. Adds results to the check's levels, nodes
/// and faults. Tiles that cannot be decoded are omitted. Fails as the source does, and with kCancelled.
Result<void> check_nodes(const TileSetReader& set, const io::SetClaims& claims, const TileCheckOptions& options,
                         const TileGrid& grid, const World& world, TileCheck& check, std::vector<TileFault>& faults);

}  // namespace scarp::check
