// Names of files in a set of tiles.
#pragma once

#include <string_view>

#include "scarp/tile_set.h"

namespace scarp {

/// True if a set may hold it next to its tiles: a relative path whose parts are neither empty nor hidden, and so never
/// lead out of a folder.
bool is_plain_name(std::string_view name);

/// True if it is one of the names that Scarp gives to other files than tiles.
bool is_known_name(std::string_view name);

/// True if these are the bytes of a layer.json or a tileset.json that marks the set as Scarp's.
bool bears_mark(std::span<const std::uint8_t> bytes);

}  // namespace scarp
