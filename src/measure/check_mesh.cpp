#include "measure/check_mesh.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>

namespace scarp::judge {

Result<void> check_mesh(const Mesh& mesh) {
  if (mesh.triangles.empty()) return fail(ErrorKind::kInput, "the mesh has no triangles");
  if (mesh.triangles.size() % 3 != 0 || mesh.positions.size() % 3 != 0) {
    return fail(ErrorKind::kInput, "the mesh is cut off: its indices or coordinates are not a multiple of 3");
  }
  if (mesh.triangles.size() >= std::uint64_t{1} << 32 || mesh.positions.size() / 3 >= std::uint64_t{1} << 32) {
    return fail(ErrorKind::kInput,
                fmt::format("the mesh has {} triangles; the judge holds up to 1,431,655,765", mesh.triangle_count()));
  }
  // The first pass has no branches, so that it can be vectorised.
  std::uint32_t largest = 0;
  for (const std::uint32_t v : mesh.triangles) largest = std::max(largest, v);
  for (std::size_t i = 0; largest >= mesh.vertex_count() && i < mesh.triangles.size(); ++i) {
    if (mesh.triangles[i] < mesh.vertex_count()) continue;
    return fail(ErrorKind::kInput, fmt::format("triangle {} of the mesh names vertex {}, but there are only {}", i / 3,
                                               mesh.triangles[i], mesh.vertex_count()));
  }
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    if (is_in_reach(mesh.positions[i])) continue;
    return fail(ErrorKind::kInput,
                fmt::format("vertex {} of the mesh has a coordinate that is {}", i / 3,
                            std::isfinite(mesh.positions[i]) ? "beyond 1e100; only nearer ones can be judged"
                                                             : "not a finite number"));
  }
  if (!std::all_of(mesh.origin.begin(), mesh.origin.end(), is_in_reach)) {
    return fail(ErrorKind::kInput, "the mesh's origin is not a finite point within 1e100");
  }
  return {};
}

}  // namespace scarp::judge
