// A grid of tiles as JSON, for plans and sets.
#pragma once

#include <optional>

#include "io/tiles/json_members.h"
#include "scarp/tile.h"

namespace scarp::io {

Json describe_grid(const TileGrid& grid);
/// Nothing for an invalid grid, or a local one without a raster.
std::optional<TileGrid> parse_grid(const Json& json);

}  // namespace scarp::io
