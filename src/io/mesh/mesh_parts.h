// A mesh in parts small enough for 16-bit indices.
#pragma once

#include <cstdint>
#include <vector>

#include "scarp/mesh.h"

namespace scarp::io {

/// Some of the triangles, with their vertices.
struct MeshPart {
  std::vector<std::uint32_t> vertices;  ///< ids in the mesh
  std::vector<std::uint16_t> corners;   ///< indices into `vertices`
};

/// Every triangle is in one part, in the order of the mesh. A vertex shared by parts is in each of them. A mesh of few
/// vertices is one unchanged part. No part has more than 65,535 vertices, since index 65,535 would restart a primitive.
/// Parts are made by recursive halving along x or y. Cost: O(triangles · log parts).
std::vector<MeshPart> split_mesh(const Mesh& mesh, int threads);

}  // namespace scarp::io
