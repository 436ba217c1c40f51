// Comparison of the announced tiles with the present ones.
#pragma once

#include <vector>

#include "io/tiles/set_claims.h"
#include "scarp/tile_set.h"

namespace scarp::check {

/// Adds a sentence for each tile that is announced but absent, present but not announced, or without a parent. Also
/// reports missing roots and faults of the claims themselves.
void check_availability(const TileSetReader& set, const io::SetClaims& claims, const TileGrid& grid,
                        std::vector<TileFault>& faults);

}  // namespace scarp::check
