// The self-contained page of a served set.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scarp/tile_set.h"

namespace scarp::cli {

/// The viewer with the finest levels that fit into a page, as `scarp view SET` writes it. If the viewer is not
/// installed or cannot show the set, the page is a map of the tiles. `makes_tiles`: tiles are made on demand, so the
/// page has one coarse level. `name`: the set's name.
std::vector<std::uint8_t> make_set_page(const std::string& name, const TileSetReader& set, bool makes_tiles);

/// The files of a set, one URL path per line.
std::string list_set(const TileSetReader& set, const std::string& file_url);

}  // namespace scarp::cli
