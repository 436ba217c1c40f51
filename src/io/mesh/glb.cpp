// GLB: glTF 2.0 in one file. A JSON chunk describes one binary chunk of per-vertex arrays and indices.
//
// glTF has y up and is right-handed: (x, y, z) becomes (x, z, −y). That is a rotation, so the winding does not change.
// Positions are float32 offsets, or numbers of a grid. The origin is the translation of the only node, since JSON keeps
// every bit of a double. Each part of the mesh is a primitive with 16-bit indices.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "base/caught.h"
#include "base/parallel.h"
#include "io/mesh/file_bytes.h"
#include "io/mesh/glb_attributes.h"
#include "io/mesh/glb_builder.h"
#include "io/mesh/glb_json.h"
#include "io/mesh/glb_numbers.h"
#include "io/mesh/mesh_file.h"
#include "io/mesh/mesh_parts.h"
#include "io/mesh/meshopt_codec.h"
#include "scarp/io.h"

namespace scarp::io {
namespace {

/// A PNG of one white pixel: texture coordinates require a texture, and this one is a placeholder for the user's.
constexpr std::uint8_t kWhitePng[] = {
    0x89, 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A, 0x00, 0x00, 0x00, 0x0D, 0x49, 0x48, 0x44, 0x52, 0x00, 0x00,
    0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x02, 0x00, 0x00, 0x00, 0x90, 0x77, 0x53, 0xDE, 0x00, 0x00, 0x00,
    0x0C, 0x49, 0x44, 0x41, 0x54, 0x78, 0xDA, 0x63, 0xF8, 0xFF, 0xFF, 0x3F, 0x00, 0x05, 0xFE, 0x02, 0xFE, 0x33,
    0x12, 0x95, 0x14, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4E, 0x44, 0xAE, 0x42, 0x60, 0x82};

bool has_gaps(const Mesh& mesh) {
  return std::any_of(mesh.channels.begin(), mesh.channels.end(), [](float value) { return !std::isfinite(value); });
}

void store_items(const GlbAttribute& attribute, const MeshPart& part, std::uint8_t* at) {
  for (const std::uint32_t v : part.vertices) attribute.store(v, at);
}

std::vector<MeshPart> list_parts(const Mesh& mesh, const GlbOptions& options) {
  std::vector<MeshPart> parts = split_mesh(mesh, options.threads);
  if (!options.compress) return parts;
  parallel_for(parts.size(), options.threads,
               [&](std::size_t i) { order_for_codec(parts[i].vertices, parts[i].corners); });
  return parts;
}

/// The JSON of a part, and its compressed arrays if any.
struct PreparedPart {
  std::array<float, 3> low, high;                  ///< range of its positions
  std::vector<std::vector<std::uint8_t>> streams;  ///< streams of its attributes
  std::vector<std::uint8_t> triangles;
};

class GlbWriter {
 public:
  GlbWriter(const Mesh& mesh, const GlbOptions& options)
      : mesh_(mesh),
        options_(options),
        grid_(options.compress ? find_grid(mesh, options.cell) : GlbGrid{}),
        attributes_(list_glb_attributes(mesh, grid_, options)),
        parts_(list_parts(mesh, options)) {}

  Result<std::vector<std::uint8_t>> encode() {
    if (std::string why = find_obstacle(); !why.empty()) return fail(ErrorKind::kOutput, std::move(why));
    describe_asset();
    std::vector<PreparedPart> prepared(parts_.size());
    parallel_for(parts_.size(), options_.threads, [&](std::size_t i) { prepared[i] = prepare(parts_[i]); });
    Json primitives = Json::array();
    for (std::size_t i = 0; i < parts_.size(); ++i) primitives.push_back(add_part(parts_[i], std::move(prepared[i])));
    json_["meshes"] = Json::array({{{"name", "terrain"}, {"primitives", std::move(primitives)}}});
    add_material();
    return glb_.assemble(options_.threads);
  }

 private:
  std::string find_obstacle() const {
    if (has_gaps(mesh_) && std::count(mesh_.channels.begin(), mesh_.channels.end(), kNoChannelValue) > 0) {
      return fmt::format(
          "a channel of the mesh has the value {}, which stands for no value in a "
          "GLB file; write PLY instead",
          kNoChannelValue);
    }
    if (mesh_.uvs.empty() && !(options_.base_color.bytes.empty() && options_.normal_map.bytes.empty()))
      return "an image is laid over a mesh by texture coordinates, and the mesh has none";
    if (!options_.compress) return {};
    if (!kHasMeshoptCodec) return "this build compresses no GLB: it has no libmeshoptimizer";
    if (!holds_positions(grid_, mesh_)) {
      return "the mesh's positions are neither float32 nor on the lattice of the cells, so compression would move "
             "them; write it uncompressed";
    }
    return {};
  }

  void describe_asset() {
    const auto generator = mesh_.metadata.find("generator");
    json_["asset"] = {{"version", "2.0"},
                      {"generator", generator == mesh_.metadata.end() ? "Scarp" : generator->second}};
    if (!mesh_.metadata.empty()) json_["asset"]["extras"] = metadata_to_extras(mesh_.metadata);
    std::vector<std::string> extensions;
    if (options_.compress) extensions = {"KHR_mesh_quantization", kMeshoptExtension};
    if (options_.base_color.mime_type == kWebp) extensions.emplace_back(kWebpTexture);
    if (!extensions.empty()) {
      json_["extensionsUsed"] = extensions;
      json_["extensionsRequired"] = extensions;
    }
    json_["scene"] = 0;
    json_["scenes"] = Json::array({{{"nodes", {0}}}});
    Json node = {{"name", "terrain"}, {"mesh", 0}};
    const std::array<double, 3> origin = to_y_up(mesh_.origin[0] + 0.0, mesh_.origin[1], mesh_.origin[2] + 0.0);
    std::array<double, 3> translation{};
    for (std::size_t k = 0; k < 3; ++k) translation[k] = origin[k] + grid_.shift[k];
    if (translation != std::array<double, 3>{}) node["translation"] = translation;
    if (!grid_.is_plain()) node["scale"] = grid_.scale;
    json_["nodes"] = Json::array({node});
  }

  PreparedPart prepare(const MeshPart& part) const {
    PreparedPart prepared;
    find_bounds(part, prepared);
    if (!options_.compress) return prepared;
    for (const GlbAttribute& attribute : attributes_) {
      std::vector<std::uint8_t> items(attribute.stride * part.vertices.size());
      store_items(attribute, part, items.data());
      prepared.streams.push_back(encode_meshopt_attributes(items, attribute.stride));
    }
    prepared.triangles = encode_meshopt_triangles(part.corners, part.vertices.size());
    return prepared;
  }

  std::size_t add_items(std::size_t number, const MeshPart& part, PreparedPart& prepared) {
    const GlbAttribute& attribute = attributes_[number];
    const std::uint64_t count = part.vertices.size(), size = attribute.stride * count;
    if (!options_.compress) {
      return glb_.add_view(size, kArrayBuffer, 0,
                           [&attribute, &part](std::uint8_t* at) { store_items(attribute, part, at); });
    }
    return glb_.add_packed(std::move(prepared.streams[number]), kArrayBuffer, count, attribute.stride, "ATTRIBUTES");
  }

  Json add_part(const MeshPart& part, PreparedPart prepared) {
    constexpr const char* kTypes[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    Json named = Json::object();
    for (std::size_t number = 0; number < attributes_.size(); ++number) {
      const GlbAttribute& attribute = attributes_[number];
      named[attribute.name] = glb_.accessor_count();
      Json& accessor = glb_.add_accessor(add_items(number, part, prepared), attribute.component, part.vertices.size(),
                                         kTypes[attribute.width]);
      if (attribute.is_normalized) accessor["normalized"] = true;
      if (attribute.name != "POSITION") continue;
      accessor["min"] = prepared.low;
      accessor["max"] = prepared.high;
    }
    Json primitive = {{"attributes", named}, {"indices", glb_.accessor_count()}, {"material", 0}, {"mode", 4}};
    if (mesh_.channel_count > 0) {
      primitive["extras"]["channels"] = mesh_.channel_count;
      if (has_gaps(mesh_)) primitive["extras"]["noValue"] = kNoChannelValue;
    }
    const std::uint64_t corners = part.corners.size();
    const std::size_t view = options_.compress
                                 ? glb_.add_packed(std::move(prepared.triangles), kIndexBuffer, corners, 2, "TRIANGLES")
                                 : glb_.add_view(2 * corners, kIndexBuffer, 0, [&part](std::uint8_t* at) {
                                     for (const std::uint16_t corner : part.corners) store_number(at, corner);
                                   });
    glb_.add_accessor(view, kUint16Component, corners, "SCALAR");
    return primitive;
  }

  void find_bounds(const MeshPart& part, PreparedPart& prepared) const {
    prepared.low.fill(std::numeric_limits<float>::infinity());
    prepared.high.fill(-std::numeric_limits<float>::infinity());
    for (const std::uint32_t v : part.vertices) {
      const std::array<double, 3> number = grid_.number(&mesh_.positions[3 * std::size_t{v}]);
      for (std::size_t k = 0; k < 3; ++k) {
        const float coordinate = static_cast<float>(number[k]) + 0.0f;
        prepared.low[k] = std::min(prepared.low[k], coordinate);
        prepared.high[k] = std::max(prepared.high[k], coordinate);
      }
    }
  }

  /// Adds a texture of the image and returns its number.
  std::size_t add_texture(const std::uint8_t* bytes, std::size_t size, const std::string& mime_type) {
    const std::size_t view =
        glb_.add_view(size, 0, 0, [bytes, size](std::uint8_t* at) { std::memcpy(at, bytes, size); });
    json_["images"].push_back({{"bufferView", view}, {"mimeType", mime_type}});
    const std::size_t source = json_["images"].size() - 1;
    Json texture = Json::object();
    if (mime_type == kWebp) {
      texture["extensions"] = {{kWebpTexture, {{"source", source}}}};
    } else {
      texture["source"] = source;
    }
    if (has_images()) texture["sampler"] = 0;
    json_["textures"].push_back(std::move(texture));
    return source;
  }

  bool has_images() const { return !options_.base_color.bytes.empty() || !options_.normal_map.bytes.empty(); }

  void add_material() {
    std::size_t base_texture = 0, normal_texture = 0;
    const bool has_base = !mesh_.uvs.empty() && (!options_.base_color.bytes.empty() || !has_images());
    if (!mesh_.uvs.empty()) {
      json_["images"] = Json::array();
      json_["textures"] = Json::array();
    }
    if (has_images()) {
      // Clamped, since the image ends at the mesh's border.
      constexpr int kLinear = 9729, kLinearMipmaps = 9987, kClamp = 33071;
      json_["samplers"] =
          Json::array({{{"magFilter", kLinear}, {"minFilter", kLinearMipmaps}, {"wrapS", kClamp}, {"wrapT", kClamp}}});
    }
    if (has_base) {
      const GlbImage& image = options_.base_color;
      base_texture = image.bytes.empty() ? add_texture(kWhitePng, sizeof kWhitePng, "image/png")
                                         : add_texture(image.bytes.data(), image.bytes.size(), image.mime_type);
    }
    if (!options_.normal_map.bytes.empty()) {
      const GlbImage& image = options_.normal_map;
      normal_texture = add_texture(image.bytes.data(), image.bytes.size(), image.mime_type);
    }
    // Colours of vertices and textures are multiplied by the material's.
    const bool is_plain = mesh_.colors.empty() && !has_base;
    const Json base = is_plain ? Json{0.47, 0.42, 0.33, 1.0} : Json{1.0, 1.0, 1.0, 1.0};
    Json material = {
        {"name", is_plain ? "earth" : "white"},
        {"pbrMetallicRoughness", {{"baseColorFactor", base}, {"metallicFactor", 0.0}, {"roughnessFactor", 1.0}}},
        {"doubleSided", false}};
    if (has_base) material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", base_texture}};
    if (!options_.normal_map.bytes.empty()) material["normalTexture"] = {{"index", normal_texture}};
    json_["materials"] = Json::array({std::move(material)});
  }

  static constexpr const char* kWebp = "image/webp";
  static constexpr const char* kWebpTexture = "EXT_texture_webp";

  const Mesh& mesh_;
  const GlbOptions& options_;
  const GlbGrid grid_;
  const std::vector<GlbAttribute> attributes_;
  const std::vector<MeshPart> parts_;
  GlbBuilder glb_;
  Json& json_ = glb_.json;
};

}  // namespace

Result<std::vector<std::uint8_t>> encode_glb(const Mesh& mesh) { return GlbWriter(mesh, {}).encode(); }

}  // namespace scarp::io

namespace scarp {

bool can_compress_glb() { return io::kHasMeshoptCodec; }

Result<std::vector<std::uint8_t>> encode_glb(const Mesh& mesh, const GlbOptions& options) {
  if (std::string why = io::find_unwritable(mesh, true); !why.empty()) return fail(ErrorKind::kOutput, std::move(why));
  try {
    return io::GlbWriter(mesh, options).encode();
  } catch (...) {
    return caught(ErrorKind::kInput, "encode the mesh");
  }
}

}  // namespace scarp
