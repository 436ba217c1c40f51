// The water of a plan as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "tiles/water/tile_waters.h"

namespace scarp {

/// Coordinates are base64 of doubles, so that they are read back exactly and need little room.
nlohmann::ordered_json describe_waters(const TileWaters& waters);
/// Throws for what describe_waters() did not write; of waters.grid and waters.per_turn nothing is known.
TileWaters parse_waters(const nlohmann::ordered_json& json);

}  // namespace scarp
