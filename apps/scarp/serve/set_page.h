// The page of a set that is served, which needs nothing from elsewhere.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scarp/tile_set.h"

namespace scarp::cli {

/// The viewer with the finest levels that a page may hold, as `scarp view SET` writes it; where the viewer is not
/// installed, or cannot show the set, a map of its tiles. `makes_tiles`: they are made as they are read, so that the
/// page has one coarse level. `name` is what the set is called.
std::vector<std::uint8_t> make_set_page(const std::string& name, const TileSetReader& set, bool makes_tiles);

/// The files of a set, one URL's path a line.
std::string list_set(const TileSetReader& set, const std::string& file_url);

}  // namespace scarp::cli
