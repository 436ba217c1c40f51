// The four edges of a tile: lines that nothing but the nodes of the edge and the level decide.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scarp/tile.h"

namespace scarp {

/// Columns or rows of nodes that become 0 … `units` in a tile of `steps` steps a side.
inline std::uint16_t quantized(std::int64_t node, std::int64_t steps, std::int64_t units) {
  return static_cast<std::uint16_t>((2 * units * node + steps) / (2 * steps));
}

/// The nearest multiple of the quantum; halves go up.
std::int32_t quanta_of(double height, double quantum);

/// An edge's nodes, one after the other.
struct EdgeNodes {
  std::vector<float> heights;   ///< none missing
  std::vector<double> places;   ///< along the edge, as clients divide it
  std::vector<double> decoded;  ///< places of vertices at the nodes, as clients decode them
};

/// The nodes of an edge that are vertices, ascending, with the ends and each node that begins a segment of the level:
/// as few as keep every node within the level's max error of the line through them, the vertices where clients decode
/// them. `forced`: others that are vertices, in any order.
std::vector<std::int32_t> choose_edge_vertices(const EdgeNodes& nodes, const PyramidLevel& level,
                                               std::span<const std::int32_t> forced = {});

}  // namespace scarp
