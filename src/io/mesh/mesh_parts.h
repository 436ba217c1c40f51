// A mesh in parts that indices of 16 bits can number.
#pragma once

#include <cstdint>
#include <vector>

#include "scarp/mesh.h"

namespace scarp {

/// Some of the triangles, with the vertices they use.
struct MeshPart {
  std::vector<std::uint32_t> vertices;  ///< ids in the mesh
  std::vector<std::uint16_t> corners;   ///< places in `vertices`
};

/// Every triangle is in one part, in the order that it has in the mesh; a vertex on the line between parts is in each
/// of them. A mesh of few vertices is one part, as it stands. No part has more than 65,535 vertices, since a corner of
/// 65,535 would restart a primitive. Parts are halves of halves, along x or y. Cost: O(triangles · log parts).
std::vector<MeshPart> split_mesh(const Mesh& mesh, int threads);

}  // namespace scarp
