// The root entries of tileset.json, from which clients find implicit tiles and decide when to load them.
#pragma once

#include <cstddef>
#include <vector>

#include "io/tiles/set_claims.h"
#include "scarp/tile_set.h"

namespace scarp::check {

/// `levels`: number of levels of the set; `low`, `high`: range of the heights of all its vertices.
void check_tileset(const io::SetClaims& claims, const TileGrid& grid, std::size_t levels, double low, double high,
                   const CheckedNodes& nodes, std::vector<TileFault>& faults);

}  // namespace scarp::check
