// The order of a mesh's vertices and triangles in a file, computed before the mesh is complete.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/function_ref.h"

namespace scarp::mesh {

/// Writes the positions of the vertices [first, end), seen from above, relative to any origin; NaN for vertices without
/// triangles. Several threads call it at once, repeatedly, for parts of the vertices.
using FindPlaces = FunctionRef<void(std::size_t first, std::size_t end, std::span<std::array<double, 2>> places)>;

/// New numbers of vertices.
struct VertexNumbers {
  static constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();

  std::vector<std::uint32_t> ids;  ///< by vertex; kUnused: no triangle uses it
  std::size_t count = 0;           ///< number of used vertices
};

/// Numbers the vertices used by triangles, in ascending order.
VertexNumbers number_used(std::span<const std::uint32_t> corners, std::size_t vertices);

/// The corners of triangles, sorted by place as optimize_order() does; unchanged without meshoptimizer.
std::vector<std::uint32_t> sort_by_place(std::span<const std::uint32_t> corners, std::size_t vertices,
                                         FindPlaces find_places, int threads);

/// Sorts the triangles locally for the vertex cache and numbers vertices by first use. After sort_by_place() the result
/// equals that of optimize_order(). Replaces corners by the new numbers. Without meshoptimizer triangles keep their
/// order.
VertexNumbers sort_for_cache(std::vector<std::uint32_t>& corners, std::size_t vertices, int threads);

}  // namespace scarp::mesh
