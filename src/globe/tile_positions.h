// The vertices of a tile in space.
#pragma once

#include <vector>

#include "globe/ground.h"
#include "scarp/tile.h"

namespace scarp::globe {

std::vector<Space> positions_in_space(const TerrainTile& tile, const TileGrid& grid, const Ground& ground);

}  // namespace scarp::globe
