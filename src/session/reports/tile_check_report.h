// The findings of scarp tile check as text and JSON.
#pragma once

#include <string>

#include "scarp/tile_set.h"
#include "session/text/json.h"

namespace scarp::cli {

/// Adds tiles, triangles, edges …, "levels", "faults" and "described".
void add_tile_check(Json& report, const TileCheck& check);
/// A table of the levels, followed by faults and counts.
std::string make_check_summary(const std::string& set, const TileCheck& check, double seconds);
/// One sentence for a set with faults: the number of each kind, and the first fault.
std::string describe_faults(const std::string& set, const TileCheck& check);

}  // namespace scarp::cli
