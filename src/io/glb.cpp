// GLB: glTF 2.0 in one file. A JSON chunk describes one binary chunk of positions, normals and indices.
//
// glTF is y up and right-handed: (x, y, z) of ours becomes (x, z, −y). That is a rotation, so winding stays as it is.
// Offsets are float32; the origin is the translation of the only node, where JSON keeps every bit of its doubles.

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "io/file_bytes.h"
#include "io/glb_json.h"
#include "io/mesh_file.h"

namespace scarp {
namespace {

constexpr std::uint32_t kMagic = 0x46546C67, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr int kFloat = 5126, kUint16 = 5123, kUint32 = 5125, kArrayBuffer = 34962, kIndexBuffer = 34963;

std::uint64_t pad4(std::uint64_t size) { return (size + 3) / 4 * 4; }
// 65535 itself would restart a primitive.
std::size_t index_size(std::uint64_t vertices) { return vertices < 65535 ? 2 : 4; }

/// (x, y, z) → (x, z, −y); 0 − y rather than −y, so that 0 stays 0.
template <class T>
std::array<T, 3> to_y_up(T x, T y, T z) {
  return {x, z, T{0} - y};
}

Json describe(const Mesh& mesh, const std::array<float, 3>& low, const std::array<float, 3>& high) {
  const std::uint64_t vertices = mesh.vertex_count(), corners = mesh.triangles.size();
  const bool with_normals = !mesh.normals.empty();
  Json json;
  const auto generator = mesh.metadata.find("generator");
  json["asset"] = {{"version", "2.0"}, {"generator", generator == mesh.metadata.end() ? "Scarp" : generator->second}};
  if (!mesh.metadata.empty()) json["asset"]["extras"] = metadata_to_extras(mesh.metadata);
  json["scene"] = 0;
  json["scenes"] = Json::array({{{"nodes", {0}}}});
  Json node = {{"name", "terrain"}, {"mesh", 0}};
  if (mesh.origin != std::array<double, 3>{}) {
    node["translation"] = to_y_up(mesh.origin[0] + 0.0, mesh.origin[1], mesh.origin[2] + 0.0);
  }
  json["nodes"] = Json::array({node});
  Json attributes = {{"POSITION", 0}};
  if (with_normals) attributes["NORMAL"] = 1;
  const int indices = with_normals ? 2 : 1;
  json["meshes"] = Json::array(
      {{{"name", "terrain"},
        {"primitives",
         Json::array({{{"attributes", attributes}, {"indices", indices}, {"material", 0}, {"mode", 4}}})}}});
  json["materials"] =
      Json::array({{{"name", "earth"},
                    {"pbrMetallicRoughness",
                     {{"baseColorFactor", {0.47, 0.42, 0.33, 1.0}}, {"metallicFactor", 0.0}, {"roughnessFactor", 1.0}}},
                    {"doubleSided", false}}});
  Json accessors = Json::array(), views = Json::array();
  const auto add = [&](std::uint64_t offset, std::uint64_t size, int target, int component, std::uint64_t count,
                       const char* type) -> Json& {
    views.push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}, {"target", target}});
    accessors.push_back(
        {{"bufferView", views.size() - 1}, {"componentType", component}, {"count", count}, {"type", type}});
    return accessors.back();
  };
  Json& positions = add(0, 12 * vertices, kArrayBuffer, kFloat, vertices, "VEC3");
  positions["min"] = low;
  positions["max"] = high;
  if (with_normals) add(12 * vertices, 12 * vertices, kArrayBuffer, kFloat, vertices, "VEC3");
  const std::uint64_t before = (with_normals ? 24 : 12) * vertices, size = index_size(vertices);
  add(before, size * corners, kIndexBuffer, size == 2 ? kUint16 : kUint32, corners, "SCALAR");
  json["accessors"] = std::move(accessors);
  json["bufferViews"] = std::move(views);
  json["buffers"] = Json::array({{{"byteLength", before + size * corners}}});
  return json;
}

}  // namespace

std::uint64_t glb_binary_size(std::uint64_t vertices, std::uint64_t triangles, bool normals) {
  return 12 + 8 + 8 + pad4((normals ? 24 : 12) * vertices + 3 * triangles * index_size(vertices));
}

Result<std::vector<std::uint8_t>> encode_glb(const Mesh& mesh) {
  const std::size_t vertices = mesh.vertex_count();
  std::array<float, 3> low, high;
  low.fill(std::numeric_limits<float>::infinity());
  high.fill(-std::numeric_limits<float>::infinity());
  const auto position = [&](std::size_t v) {
    return to_y_up(static_cast<float>(mesh.positions[3 * v]), static_cast<float>(mesh.positions[3 * v + 1]),
                   static_cast<float>(mesh.positions[3 * v + 2]));
  };
  for (std::size_t v = 0; v < vertices; ++v) {
    const auto p = position(v);
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k] + 0.0f);
      high[k] = std::max(high[k], p[k] + 0.0f);
    }
  }
  const std::uint64_t binary_part = glb_binary_size(vertices, mesh.triangle_count(), !mesh.normals.empty());
  if (binary_part > std::numeric_limits<std::uint32_t>::max()) {
    return fail(ErrorKind::kOutput,
                fmt::format("a GLB file holds less than 4 GiB, and this mesh needs {:.1f} GiB; write PLY instead",
                            static_cast<double>(binary_part) / (1 << 30)));
  }
  std::string json = print_json(describe(mesh, low, high));
  json.resize(pad4(json.size()), ' ');
  const std::uint64_t total = binary_part + json.size();
  if (total > std::numeric_limits<std::uint32_t>::max()) {
    return fail(ErrorKind::kOutput,
                "a GLB file holds less than 4 GiB, and this mesh with its metadata needs more; write "
                "PLY instead");
  }

  std::vector<std::uint8_t> bytes(total);
  std::uint8_t* at = bytes.data();
  for (const std::uint32_t word : {kMagic, std::uint32_t{2}, static_cast<std::uint32_t>(total),
                                   static_cast<std::uint32_t>(json.size()), kJsonChunk}) {
    store_number(at, word);
  }
  std::memcpy(at, json.data(), json.size());
  at += json.size();
  store_number(at, static_cast<std::uint32_t>(binary_part - 28));
  store_number(at, kBinaryChunk);
  for (std::size_t v = 0; v < vertices; ++v) {
    for (const float coordinate : position(v)) store_number(at, coordinate);
  }
  for (std::size_t i = 0; i < mesh.normals.size(); i += 3) {
    for (const float coordinate : to_y_up(mesh.normals[i], mesh.normals[i + 1], mesh.normals[i + 2])) {
      store_number(at, coordinate);
    }
  }
  const bool short_indices = index_size(vertices) == 2;
  for (const std::uint32_t vertex : mesh.triangles) {
    if (short_indices) {
      store_number(at, static_cast<std::uint16_t>(vertex));
    } else {
      store_number(at, vertex);
    }
  }
  return bytes;
}

}  // namespace scarp
