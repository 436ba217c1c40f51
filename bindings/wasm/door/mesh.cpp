#include "mesh.h"

#include <limits>
#include <utility>

namespace scarp::wasm {

std::unique_ptr<WholeMesh> whole_of(Mesh mesh, double max_error) {
  auto whole = std::make_unique<WholeMesh>();
  whole->mesh = std::move(mesh);
  whole->report.vertices = static_cast<double>(whole->mesh.vertex_count());
  whole->report.triangles = static_cast<double>(whole->mesh.triangle_count());
  whole->report.max_error = max_error;
  whole->report.rmse = std::numeric_limits<double>::quiet_NaN();
  return whole;
}

}  // namespace scarp::wasm

using namespace scarp::wasm;

SCARP_EXPORT(scarp_mesh_view) void scarp_mesh_view(const WholeMesh* whole, MeshView* out) {
  const scarp::Mesh& mesh = whole->mesh;
  const auto place = [](const auto& values) { return values.empty() ? 0 : address_of(values.data()); };
  *out = {static_cast<double>(mesh.vertex_count()),
          static_cast<double>(mesh.triangle_count()),
          place(mesh.positions),
          place(mesh.triangles),
          place(mesh.normals),
          place(mesh.uvs),
          {mesh.origin[0], mesh.origin[1], mesh.origin[2]},
          {whole->cell[0], whole->cell[1]},
          whole->report};
}
SCARP_EXPORT(scarp_mesh_free) void scarp_mesh_free(WholeMesh* mesh) { delete mesh; }
