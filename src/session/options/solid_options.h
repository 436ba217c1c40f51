// --solid and --split: a print of the terrain, whole or in print tiles.
#pragma once

#include <optional>
#include <string>

#include "scarp/print.h"
#include "session/options/given_options.h"

namespace scarp::cli {

/// Nothing without --solid.
Result<std::optional<PrintOptions>> parse_solid(const GivenOptions& given, std::vector<std::string>& warnings);

/// "hills-r1-c2.stl": the path of a print tile.
std::string tile_path(const std::string& output, int row, int column);

}  // namespace scarp::cli
