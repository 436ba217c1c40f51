// The tiles that are announced, and those that are there.
#pragma once

#include <vector>

#include "io/tiles/set_claims.h"
#include "scarp/tile_set.h"

namespace scarp {

/// Adds a sentence for each tile that is announced and not there, or there and not announced, or has no parent; for
/// roots that are missing; and the claims' own faults.
void check_availability(const TileSetReader& set, const SetClaims& claims, const TileGrid& grid,
                        std::vector<TileFault>& faults);

}  // namespace scarp
