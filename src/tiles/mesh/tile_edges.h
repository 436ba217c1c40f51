// The four edges of a tile: lines that depend only on the edge's nodes and the level.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scarp/tile.h"

namespace scarp::tiles {

/// Quantizes a node's column or row to 0 … `units` in a tile of `steps` steps a side.
inline std::uint16_t quantized(std::int64_t node, std::int64_t steps, std::int64_t units) {
  return static_cast<std::uint16_t>((2 * units * node + steps) / (2 * steps));
}

/// The nearest multiple of the quantum; halves are rounded up.
std::int32_t quanta_of(double height, double quantum);

/// The nodes of an edge in order.
struct EdgeNodes {
  std::vector<float> heights;   ///< none is missing
  std::vector<double> places;   ///< along the edge, as clients subdivide it
  std::vector<double> decoded;  ///< places of vertices at the nodes, as clients decode them
};

/// The nodes of an edge that become vertices, ascending: the ends, each node that begins a segment of the level, and as
/// few others as possible. Every node is within the level's max error of the line through the vertices as clients
/// decode them. `forced`: further vertices in any order.
std::vector<std::int32_t> choose_edge_vertices(const EdgeNodes& nodes, const PyramidLevel& level,
                                               std::span<const std::int32_t> forced = {});

}  // namespace scarp::tiles
