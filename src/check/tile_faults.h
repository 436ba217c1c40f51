// The laws that a tile keeps or breaks by itself.
#pragma once

#include <string>
#include <vector>

#include "check/client_tile.h"
#include "scarp/tile_set.h"

namespace scarp {

/// Adds what is wrong to `faults`, one sentence for each law.
void check_coverage(const ClientTile& tile, std::vector<TileFault>& faults);
/// On a plane: that the triangles cover the raster's part of the tile, and no more.
void check_land(const ClientTile& tile, const TileGrid& grid, std::vector<TileFault>& faults);
void check_edge_lists(const ClientTile& tile, std::vector<TileFault>& faults);
/// Checks that it hangs down from whole edges, and faces away from the tile.
void check_skirt(const ClientTile& tile, const World& world, std::vector<TileFault>& faults);
void check_header(const ClientTile& tile, std::vector<TileFault>& faults);
void check_horizon(const ClientTile& tile, const World& world, std::vector<TileFault>& faults);

/// `is_announced`: the set declares that its tiles have one.
void check_water_mask(const ClientTile& tile, bool is_announced, std::vector<TileFault>& faults);

/// The largest depth of the flat triangles below the curve between their corners, in metres.
double measure_sag(const ClientTile& tile, const World& world);

}  // namespace scarp
