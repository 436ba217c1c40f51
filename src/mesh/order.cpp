#ifdef SCARP_WITH_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

#include <algorithm>
#include <limits>
#include <type_traits>
#include <vector>

#include "mesh/attributes.h"
#include "scarp/mesh.h"

namespace scarp {

#ifdef SCARP_WITH_MESHOPTIMIZER

void optimize_order(Mesh& mesh) {
  const std::size_t vertices = mesh.vertex_count();
  std::vector<std::uint32_t> triangles(mesh.triangles.size());
  meshopt_optimizeVertexCache(triangles.data(), mesh.triangles.data(), mesh.triangles.size(), vertices);
  std::vector<std::uint32_t> new_ids(vertices);
  const std::size_t used =
      meshopt_optimizeVertexFetchRemap(new_ids.data(), triangles.data(), triangles.size(), vertices);

  const auto reorder = [&](auto& values, std::size_t width) {
    std::decay_t<decltype(values)> reordered(width * used);
    for (std::size_t v = 0; v < vertices; ++v) {
      if (new_ids[v] == std::numeric_limits<std::uint32_t>::max()) continue;
      std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(width * v), width,
                  reordered.begin() + static_cast<std::ptrdiff_t>(width * new_ids[v]));
    }
    values = std::move(reordered);
  };
  reorder(mesh.positions, 3);
  if (!mesh.normals.empty()) reorder(mesh.normals, 3);
  for_each_attribute(mesh, reorder);
  for (std::uint32_t& vertex : triangles) vertex = new_ids[vertex];
  mesh.triangles = std::move(triangles);
}

#else

void optimize_order(Mesh&) {}

#endif

}  // namespace scarp
