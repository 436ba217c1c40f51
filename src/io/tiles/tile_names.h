// Names of files in a tile set.
#pragma once

#include <string_view>

#include "scarp/tile_set.h"

namespace scarp {

/// True for names of additional files in a set: a relative path without empty or hidden parts, so that it never leaves
/// the folder.
bool is_plain_name(std::string_view name);

/// True for the names of Scarp's files other than tiles.
bool is_known_name(std::string_view name);

/// True for the bytes of a layer.json or a tileset.json that marks the set as Scarp's.
bool bears_mark(std::span<const std::uint8_t> bytes);

}  // namespace scarp
