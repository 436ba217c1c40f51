// The tiles of a pyramid, down to its blocks.
#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "scarp/tile.h"

namespace scarp::tiles {

/// Tiles of one level by row, then column.
using TileSet = std::set<std::pair<std::uint32_t, std::uint32_t>>;

/// True if the source may have a height in the tile, or near enough to affect the tile's normals.
bool is_covered(const PyramidPlan& plan, TileId id);

/// True if a source requires the tile's level at its place, or the plan needs the tile as a sibling.
bool is_wanted(const PyramidPlan& plan, TileId id);

/// The four tiles of the next level: south-west, south-east, north-west, north-east.
std::array<TileId, 4> children_of(TileId id);

/// The tiles of each level up to the block level: those that may have heights, their ancestors and all siblings.
std::vector<TileSet> choose_tiles(const PyramidPlan& plan);

}  // namespace scarp::tiles
