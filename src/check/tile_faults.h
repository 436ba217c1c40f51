// Checks of the rules for a single tile.
#pragma once

#include <string>
#include <vector>

#include "check/client_tile.h"
#include "scarp/tile_set.h"

namespace scarp::check {

/// Adds one sentence per violated rule to `faults`.
void check_coverage(const ClientTile& tile, std::vector<TileFault>& faults);
/// On a plane: checks that the triangles cover exactly the raster's part of the tile.
void check_land(const ClientTile& tile, const TileGrid& grid, std::vector<TileFault>& faults);
void check_edge_lists(const ClientTile& tile, std::vector<TileFault>& faults);
/// Checks that the skirt hangs from whole edges and faces away from the tile.
void check_skirt(const ClientTile& tile, const World& world, std::vector<TileFault>& faults);
void check_header(const ClientTile& tile, std::vector<TileFault>& faults);
void check_horizon(const ClientTile& tile, const World& world, std::vector<TileFault>& faults);

/// `is_announced`: the set declares water masks.
void check_water_mask(const ClientTile& tile, bool is_announced, std::vector<TileFault>& faults);

/// The largest depth of the flat triangles below the curved surface between their corners, in metres.
double measure_sag(const ClientTile& tile, const World& world);

}  // namespace scarp::check
