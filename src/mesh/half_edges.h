// The triangle across each edge of a mesh.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace scarp::mesh {

/// Half-edge 3t + k of triangle t runs from its corner k to its corner k + 1.
inline constexpr std::uint32_t kNoHalfEdge = std::numeric_limits<std::uint32_t>::max();

inline std::uint32_t next_half_edge(std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
inline std::uint32_t previous_half_edge(std::uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }

/// For each half-edge a→b, the half-edge b→a of the other triangle. kNoHalfEdge on the border, and where an edge does
/// not have exactly two triangles in opposite directions. REQUIRES: fewer than 2^32 / 3 triangles. Cost: O(n log n), 16
/// bytes per half-edge during the call.
std::vector<std::uint32_t> build_twins(std::span<const std::uint32_t> triangles);

}  // namespace scarp::mesh
