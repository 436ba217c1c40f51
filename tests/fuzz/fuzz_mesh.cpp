// Any bytes: a consistent mesh that can be written again, or an error with a message; the same as points of LandXML.
#include <cmath>
#include <cstdlib>

#include "io/points/point_source.h"
#include "scarp/io.h"

namespace {

void read_as_points(std::span<const std::uint8_t> bytes) {
  const auto points = scarp::io::read_landxml_points(bytes, "fuzz.xml", {}, "");
  if (!points) {
    if (points.error().message.empty()) std::abort();
    return;
  }
  if (points->size() == 0 || points->y.size() != points->size() || points->z.size() != points->size()) std::abort();
  for (const scarp::PointLine& line : points->lines) {
    if (line.points.size() < 2) std::abort();
    for (const std::uint32_t point : line.points) {
      if (point >= points->size()) std::abort();
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  read_as_points({data, size});
  const auto mesh = scarp::decode_mesh({data, size}, "fuzz.stl");  // the name selects the reader for damaged STL
  if (!mesh) {
    if (mesh.error().message.empty() || mesh.error().kind != scarp::ErrorKind::kInput) std::abort();
    return 0;
  }
  if (mesh->triangles.empty() || mesh->triangles.size() % 3 != 0) std::abort();
  for (const std::uint32_t vertex : mesh->triangles) {
    if (vertex >= mesh->vertex_count()) std::abort();
  }
  for (const double coordinate : mesh->positions) {
    if (!std::isfinite(coordinate)) std::abort();
  }
  const std::size_t count = mesh->vertex_count();
  if (!mesh->normals.empty() && mesh->normals.size() != 3 * count) std::abort();
  if (!mesh->uvs.empty() && mesh->uvs.size() != 2 * count) std::abort();
  if (!mesh->colors.empty() && mesh->colors.size() != 3 * count) std::abort();
  if (mesh->channel_count < 0 || mesh->channels.size() != count * static_cast<std::size_t>(mesh->channel_count)) {
    std::abort();
  }
  // A mesh that was read can be written; reading back PLY and VTU, which store all contents, gives the same mesh.
  for (const scarp::MeshFormatTraits* traits : scarp::mesh_formats()) {
    if (!traits->is_read) continue;
    const auto bytes = scarp::encode_mesh(*mesh, traits->format);
    if (!bytes && bytes.error().kind != scarp::ErrorKind::kOutput) std::abort();
    if (bytes && !scarp::decode_mesh(*bytes, "fuzz")) std::abort();
  }
  const auto packed = scarp::encode_glb(*mesh, {.compress = true, .cell = {1, -1}});
  if (!packed && packed.error().kind != scarp::ErrorKind::kOutput) std::abort();
  if (packed && !scarp::decode_mesh(*packed, "fuzz")) std::abort();
  for (const auto format : {scarp::MeshFormat::kPly, scarp::MeshFormat::kVtu}) {
    const auto bytes = scarp::encode_mesh(*mesh, format);
    if (!bytes) continue;
    const auto back = scarp::decode_mesh(*bytes, "fuzz");
    if (!back || back->triangles != mesh->triangles || back->vertex_count() != mesh->vertex_count()) std::abort();
    if (back->colors != mesh->colors || back->channels.size() != mesh->channels.size()) std::abort();
    for (std::size_t v = 0; v < mesh->vertex_count(); ++v) {
      if (back->vertex(v) != mesh->vertex(v)) std::abort();
    }
  }
  return 0;
}
