// Names of files in a tile set.
#pragma once

#include <string_view>

#include "scarp/tile_set.h"

namespace scarp::io {

/// True for valid names of additional files in a set: relative paths without empty or hidden parts, which never leave
/// the folder.
bool is_plain_name(std::string_view name);

/// True for the names of Scarp's files other than tiles.
bool is_known_name(std::string_view name);

/// True for a layer.json or tileset.json that marks the set as Scarp's.
bool bears_mark(std::span<const std::uint8_t> bytes);

}  // namespace scarp::io
