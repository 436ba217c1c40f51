// A plan's water as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "tiles/water/tile_waters.h"

namespace scarp::jobs {

/// Coordinates are stored as base64 of doubles: exact and compact.
nlohmann::ordered_json describe_waters(const TileWaters& waters);
/// Throws for JSON not written by describe_waters(). Does not set waters.grid and waters.per_turn.
TileWaters parse_waters(const nlohmann::ordered_json& json);

}  // namespace scarp::jobs
