// The order of a mesh in a file, while the mesh is still being made.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/function_ref.h"

namespace scarp {

/// Fills in where the vertices [first, end) lie, seen from above: relative to what is up to the caller, NaN for
/// vertices that no triangle has. Called for parts of the vertices, for each more than once, by several threads at
/// once.
using FindPlaces = FunctionRef<void(std::size_t first, std::size_t end, std::span<std::array<double, 2>> places)>;

/// New numbers of vertices.
struct VertexNumbers {
  static constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();

  std::vector<std::uint32_t> ids;  ///< by vertex; kUnused: no triangle has it
  std::size_t count = 0;           ///< number of vertices that are used
};

/// Numbers the vertices that triangles have, in their order.
VertexNumbers number_used(std::span<const std::uint32_t> corners, std::size_t vertices);

/// The corners of triangles, sorted by place as optimize_order() does. Without meshoptimizer as they are.
std::vector<std::uint32_t> sort_by_place(std::span<const std::uint32_t> corners, std::size_t vertices,
                                         FindPlaces find_places, int threads);

/// Sorts the triangles for the vertex cache, near where they are, and numbers vertices by first use, as
/// optimize_order() does: after sort_by_place() that is its order. The corners are the new numbers then. Without
/// meshoptimizer triangles stay as they are.
VertexNumbers sort_for_cache(std::vector<std::uint32_t>& corners, std::size_t vertices, int threads);

}  // namespace scarp
