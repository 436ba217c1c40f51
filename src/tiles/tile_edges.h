// The four edges of a tile: lines that nothing but the nodes of the edge and the level decide.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scarp/tile.h"

namespace scarp {

/// Columns or rows of nodes that become 0 … 32767 in a tile of `steps` steps a side.
inline std::uint16_t quantized(std::int64_t node, std::int64_t steps) {
  return static_cast<std::uint16_t>((2 * 32767 * node + steps) / (2 * steps));
}

/// The nearest multiple of the quantum; halves go up.
std::int32_t quanta_of(double height, double quantum);

/// The nodes of an edge that are vertices, ascending, with the ends and each node that begins a segment of the level:
/// as few as keep every node within the level's max error of the line through them, the vertices where clients decode
/// them. `heights`: of steps + 1 nodes, none missing.
std::vector<std::int32_t> choose_edge_vertices(std::span<const float> heights, const PyramidLevel& level);

}  // namespace scarp
