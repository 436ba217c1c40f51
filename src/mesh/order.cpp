#include <meshoptimizer.h>

#include <limits>
#include <vector>

#include "scarp/mesh.h"

namespace scarp {

void optimize_order(Mesh& mesh) {
  const std::size_t vertices = mesh.vertex_count();
  std::vector<std::uint32_t> triangles(mesh.triangles.size());
  meshopt_optimizeVertexCache(triangles.data(), mesh.triangles.data(), mesh.triangles.size(), vertices);
  std::vector<std::uint32_t> new_ids(vertices);
  const std::size_t used =
      meshopt_optimizeVertexFetchRemap(new_ids.data(), triangles.data(), triangles.size(), vertices);

  std::vector<double> positions(3 * used);
  std::vector<float> normals(mesh.normals.empty() ? 0 : 3 * used);
  for (std::size_t v = 0; v < vertices; ++v) {
    if (new_ids[v] == std::numeric_limits<std::uint32_t>::max()) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      positions[3 * std::size_t{new_ids[v]} + k] = mesh.positions[3 * v + k];
      if (!normals.empty()) normals[3 * std::size_t{new_ids[v]} + k] = mesh.normals[3 * v + k];
    }
  }
  for (std::uint32_t& vertex : triangles) vertex = new_ids[vertex];
  mesh.positions = std::move(positions);
  mesh.normals = std::move(normals);
  mesh.triangles = std::move(triangles);
}

}  // namespace scarp
