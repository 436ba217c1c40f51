// The tiles of a pyramid, down to its blocks.
#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "scarp/tile.h"

namespace scarp {

/// Tiles of one level by row, then column.
using TileSet = std::set<std::pair<std::uint32_t, std::uint32_t>>;

/// True if the source may have a height in the tile, or so near that its normals reach it.
bool is_covered(const PyramidPlan& plan, TileId id);

/// True if the level is one that a source asks for there, or the tile is a wanted sibling of such a tile.
bool is_wanted(const PyramidPlan& plan, TileId id);

/// The four tiles of the next level: south-west, south-east, north-west, north-east.
std::array<TileId, 4> children_of(TileId id);

/// The tiles of each level up to the block level: those that may have heights, their ancestors, and the siblings of
/// all.
std::vector<TileSet> choose_tiles(const PyramidPlan& plan);

}  // namespace scarp
