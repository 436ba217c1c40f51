// GLB: glTF 2.0 in one file. A JSON chunk describes one binary chunk of arrays by vertex and indices.
//
// glTF is y up and right-handed: (x, y, z) of ours becomes (x, z, −y). That is a rotation, so winding stays as it is.
// Offsets are float32; the origin is the translation of the only node, where JSON keeps every bit of its doubles.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

#include "io/file_bytes.h"
#include "io/glb_json.h"
#include "io/glb_numbers.h"
#include "io/mesh_file.h"
#include "io/srgb.h"

namespace scarp {
namespace {

constexpr std::uint32_t kMagic = 0x46546C67;
constexpr int kArrayBuffer = 34962, kIndexBuffer = 34963;

/// A PNG of one white pixel: places in an image mean something only where there is a texture, and this one stands in
/// for the user's.
constexpr std::uint8_t kWhitePng[] = {
    0x89, 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A, 0x00, 0x00, 0x00, 0x0D, 0x49, 0x48, 0x44, 0x52, 0x00, 0x00,
    0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x02, 0x00, 0x00, 0x00, 0x90, 0x77, 0x53, 0xDE, 0x00, 0x00, 0x00,
    0x0C, 0x49, 0x44, 0x41, 0x54, 0x78, 0xDA, 0x63, 0xF8, 0xFF, 0xFF, 0x3F, 0x00, 0x05, 0xFE, 0x02, 0xFE, 0x33,
    0x12, 0x95, 0x14, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4E, 0x44, 0xAE, 0x42, 0x60, 0x82};

std::uint64_t pad4(std::uint64_t size) { return (size + 3) / 4 * 4; }
// 65535 itself would restart a primitive.
std::size_t index_size(std::uint64_t vertices) { return vertices < 65535 ? 2 : 4; }

/// (x, y, z) → (x, z, −y); 0 − y rather than −y, so that 0 stays 0.
template <class T>
std::array<T, 3> to_y_up(T x, T y, T z) {
  return {x, z, T{0} - y};
}

/// Whether the channels are the colours once more: three as red, green and blue, or one as grey.
bool colors_say_channels(const Mesh& mesh) {
  const auto channels = static_cast<std::size_t>(mesh.channel_count);
  if (mesh.colors.empty() || (channels != 1 && channels != 3)) return false;
  for (std::size_t i = 0; i < mesh.colors.size(); ++i) {
    if (mesh.channels[channels == 3 ? i : i / 3] != static_cast<float>(mesh.colors[i])) return false;
  }
  return true;
}

/// One array of float32 by vertex.
struct Attribute {
  std::string name;
  std::size_t width = 0;
  std::function<float(std::size_t vertex, std::size_t k)> value;
};

/// What stands for a channel without a value, as declared in the primitive's extras: JSON and glTF have no NaN.
constexpr float kNoValue = std::numeric_limits<float>::lowest();

bool has_gaps(const Mesh& mesh) {
  return std::any_of(mesh.channels.begin(), mesh.channels.end(), [](float value) { return !std::isfinite(value); });
}

std::vector<Attribute> list_attributes(const Mesh& mesh) {
  std::vector<Attribute> list;
  list.push_back({"POSITION", 3, [&mesh](std::size_t v, std::size_t k) {
                    const double* p = &mesh.positions[3 * v];
                    return to_y_up(static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]))[k];
                  }});
  if (!mesh.normals.empty()) {
    list.push_back({"NORMAL", 3, [&mesh](std::size_t v, std::size_t k) {
                      const float* n = &mesh.normals[3 * v];
                      return to_y_up(n[0], n[1], n[2])[k];
                    }});
  }
  if (!mesh.uvs.empty()) {
    list.push_back({"TEXCOORD_0", 2, [&mesh](std::size_t v, std::size_t k) { return mesh.uvs[2 * v + k]; }});
  }
  if (!mesh.colors.empty()) {
    list.push_back(
        {"COLOR_0", 3, [&mesh](std::size_t v, std::size_t k) { return kLinearOfSrgb[mesh.colors[3 * v + k]]; }});
  }
  const auto channels = static_cast<std::size_t>(mesh.channel_count);
  const std::size_t written = colors_say_channels(mesh) ? 0 : channels;
  for (std::size_t c = 0; c < written; ++c) {
    list.push_back({fmt::format("_CHANNEL_{}", c + 1), 1, [&mesh, channels, c](std::size_t v, std::size_t) {
                      const float value = mesh.channels[channels * v + c];
                      return std::isfinite(value) ? value : kNoValue;
                    }});
  }
  return list;
}

std::uint64_t count_floats(const std::vector<Attribute>& attributes) {
  std::uint64_t floats = 0;
  for (const Attribute& attribute : attributes) floats += attribute.width;
  return floats;
}

Json describe(const Mesh& mesh, const std::vector<Attribute>& attributes, const std::array<float, 3>& low,
              const std::array<float, 3>& high) {
  const std::uint64_t vertices = mesh.vertex_count(), corners = mesh.triangles.size();
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

  Json accessors = Json::array(), views = Json::array(), named = Json::object();
  std::uint64_t offset = 0;
  const auto add = [&](std::uint64_t size, int target, int component, std::uint64_t count, const char* type) -> Json& {
    views.push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}, {"target", target}});
    offset += size;
    accessors.push_back(
        {{"bufferView", views.size() - 1}, {"componentType", component}, {"count", count}, {"type", type}});
    return accessors.back();
  };
  constexpr const char* kTypes[] = {"", "SCALAR", "VEC2", "VEC3"};
  for (const Attribute& attribute : attributes) {
    named[attribute.name] = accessors.size();
    Json& accessor =
        add(4 * attribute.width * vertices, kArrayBuffer, kFloatComponent, vertices, kTypes[attribute.width]);
    if (attribute.name == "POSITION") {
      accessor["min"] = low;
      accessor["max"] = high;
    }
  }
  Json primitive = {{"attributes", named}, {"indices", accessors.size()}, {"material", 0}, {"mode", 4}};
  if (mesh.channel_count > 0) {
    primitive["extras"]["channels"] = mesh.channel_count;
    if (has_gaps(mesh)) primitive["extras"]["noValue"] = kNoValue;
  }
  const std::uint64_t size = index_size(vertices);
  add(size * corners, kIndexBuffer, size == 2 ? kUint16Component : kUint32Component, corners, "SCALAR");
  json["meshes"] = Json::array({{{"name", "terrain"}, {"primitives", Json::array({primitive})}}});
  if (!mesh.uvs.empty()) {
    offset = pad4(offset);
    views.push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", sizeof kWhitePng}});
    offset += sizeof kWhitePng;
    json["images"] = Json::array({{{"bufferView", views.size() - 1}, {"mimeType", "image/png"}}});
    json["textures"] = Json::array({{{"source", 0}}});
  }
  // Colours of vertices and textures are multiplied with the material's.
  const bool is_plain = mesh.colors.empty() && mesh.uvs.empty();
  const Json base = is_plain ? Json{0.47, 0.42, 0.33, 1.0} : Json{1.0, 1.0, 1.0, 1.0};
  json["materials"] = Json::array(
      {{{"name", is_plain ? "earth" : "white"},
        {"pbrMetallicRoughness", {{"baseColorFactor", base}, {"metallicFactor", 0.0}, {"roughnessFactor", 1.0}}},
        {"doubleSided", false}}});
  if (!mesh.uvs.empty()) json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  json["accessors"] = std::move(accessors);
  json["bufferViews"] = std::move(views);
  json["buffers"] = Json::array({{{"byteLength", offset}}});
  return json;
}

}  // namespace

std::uint64_t glb_binary_size(std::uint64_t vertices, std::uint64_t triangles, std::uint64_t floats) {
  return 12 + 8 + 8 + pad4(4 * floats * vertices + 3 * triangles * index_size(vertices));
}

Result<std::vector<std::uint8_t>> encode_glb(const Mesh& mesh) {
  const std::size_t vertices = mesh.vertex_count();
  const std::vector<Attribute> attributes = list_attributes(mesh);
  if (has_gaps(mesh) && std::count(mesh.channels.begin(), mesh.channels.end(), kNoValue) > 0) {
    return fail(ErrorKind::kOutput,
                fmt::format("a channel of the mesh has the value {}, which stands for no value in a "
                            "GLB file; write PLY instead",
                            kNoValue));
  }
  std::array<float, 3> low, high;
  low.fill(std::numeric_limits<float>::infinity());
  high.fill(-std::numeric_limits<float>::infinity());
  for (std::size_t v = 0; v < vertices; ++v) {
    for (std::size_t k = 0; k < 3; ++k) {
      const float coordinate = attributes[0].value(v, k) + 0.0f;
      low[k] = std::min(low[k], coordinate);
      high[k] = std::max(high[k], coordinate);
    }
  }
  const std::uint64_t binary_part = glb_binary_size(vertices, mesh.triangle_count(), count_floats(attributes)) +
                                    (mesh.uvs.empty() ? 0 : pad4(sizeof kWhitePng));
  if (binary_part > std::numeric_limits<std::uint32_t>::max()) {
    return fail(ErrorKind::kOutput,
                fmt::format("a GLB file holds less than 4 GiB, and this mesh needs {:.1f} GiB; write PLY instead",
                            static_cast<double>(binary_part) / (1 << 30)));
  }
  std::string json = print_json(describe(mesh, attributes, low, high));
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
  for (const Attribute& attribute : attributes) {
    for (std::size_t v = 0; v < vertices; ++v) {
      for (std::size_t k = 0; k < attribute.width; ++k) store_number(at, attribute.value(v, k));
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
  if (!mesh.uvs.empty()) {
    std::memcpy(bytes.data() + (bytes.size() - pad4(sizeof kWhitePng)), kWhitePng, sizeof kWhitePng);
  }
  return bytes;
}

}  // namespace scarp
