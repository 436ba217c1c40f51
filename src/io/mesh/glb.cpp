// GLB: glTF 2.0 in one file. A JSON chunk describes one binary chunk of arrays by vertex and indices.
//
// glTF is y up and right-handed: (x, y, z) of ours becomes (x, z, −y). That is a rotation, so winding stays as it is.
// Positions are float32 offsets, or numbers of a grid; the origin is the translation of the only node, where JSON keeps
// every bit of its doubles. Each part of the mesh is a primitive with indices of 16 bits.
#include "scarp/glb.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <utility>

#include "base/caught.h"
#include "base/large_vector.h"
#include "base/parallel.h"
#include "io/mesh/file_bytes.h"
#include "io/mesh/glb_attributes.h"
#include "io/mesh/glb_json.h"
#include "io/mesh/glb_numbers.h"
#include "io/mesh/mesh_file.h"
#include "io/mesh/mesh_parts.h"
#include "io/mesh/meshopt_codec.h"

namespace scarp {
namespace {

constexpr std::uint32_t kMagic = 0x46546C67;
constexpr int kArrayBuffer = 34962, kIndexBuffer = 34963;
constexpr const char* kMeshopt = "EXT_meshopt_compression";

/// A PNG of one white pixel: places in an image mean something only where there is a texture, and this one stands in
/// for the user's.
constexpr std::uint8_t kWhitePng[] = {
    0x89, 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A, 0x00, 0x00, 0x00, 0x0D, 0x49, 0x48, 0x44, 0x52, 0x00, 0x00,
    0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x02, 0x00, 0x00, 0x00, 0x90, 0x77, 0x53, 0xDE, 0x00, 0x00, 0x00,
    0x0C, 0x49, 0x44, 0x41, 0x54, 0x78, 0xDA, 0x63, 0xF8, 0xFF, 0xFF, 0x3F, 0x00, 0x05, 0xFE, 0x02, 0xFE, 0x33,
    0x12, 0x95, 0x14, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4E, 0x44, 0xAE, 0x42, 0x60, 0x82};

std::uint64_t pad4(std::uint64_t size) { return (size + 3) / 4 * 4; }

bool has_gaps(const Mesh& mesh) {
  return std::any_of(mesh.channels.begin(), mesh.channels.end(), [](float value) { return !std::isfinite(value); });
}

/// The binary chunk as it will be: pieces, written once all sizes are known.
class Binary {
 public:
  using Write = std::function<void(std::uint8_t* at)>;

  /// Returns its place, a multiple of 4.
  std::uint64_t add(std::uint64_t size, Write write) {
    const std::uint64_t offset = pad4(size_);
    pieces_.push_back({offset, std::move(write)});
    size_ = offset + size;
    return offset;
  }
  std::uint64_t add(std::vector<std::uint8_t> bytes) {
    const std::uint64_t size = bytes.size();
    return add(size, [bytes = std::move(bytes)](std::uint8_t* at) { std::memcpy(at, bytes.data(), bytes.size()); });
  }
  std::uint64_t size() const { return size_; }
  void write(std::uint8_t* begin, int threads) const {
    parallel_for(pieces_.size(), threads, [&](std::size_t i) { pieces_[i].write(begin + pieces_[i].offset); });
  }

 private:
  struct Piece {
    std::uint64_t offset;
    Write write;
  };
  std::vector<Piece> pieces_;
  std::uint64_t size_ = 0;
};

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

/// What JSON tells of a part, and its compressed arrays where they are.
struct PreparedPart {
  std::array<float, 3> low, high;                  ///< of its positions
  std::vector<std::vector<std::uint8_t>> streams;  ///< of its attributes
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
    json_["accessors"] = std::move(accessors_);
    json_["bufferViews"] = std::move(views_);
    json_["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
    if (options_.compress) {
      json_["buffers"].push_back({{"byteLength", unpacked_}, {"extensions", {{kMeshopt, {{"fallback", true}}}}}});
    }
    return assemble();
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
    if (options_.compress) extensions = {"KHR_mesh_quantization", kMeshopt};
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

  Json& add_accessor(std::size_t view, int component, std::uint64_t count, const char* type) {
    accessors_.push_back({{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
    return accessors_.back();
  }

  /// A view of items that stand in the binary chunk as they are. Returns its number.
  std::size_t add_view(std::uint64_t size, int target, std::size_t stride, Binary::Write write) {
    Json view = {{"buffer", 0}, {"byteOffset", binary_.add(size, std::move(write))}, {"byteLength", size}};
    if (stride > 0) view["byteStride"] = stride;
    view["target"] = target;
    views_.push_back(std::move(view));
    return views_.size() - 1;
  }

  /// A view of compressed items: readers that undo it put them into the second buffer, which no file holds.
  std::size_t add_packed(std::vector<std::uint8_t> stream, int target, std::uint64_t count, std::size_t stride,
                         const char* mode) {
    const std::uint64_t size = count * stride;
    Json packed = {{"buffer", 0}, {"byteOffset", 0}, {"byteLength", stream.size()}};
    packed["byteOffset"] = binary_.add(std::move(stream));
    packed["byteStride"] = stride;
    packed["count"] = count;
    packed["mode"] = mode;
    Json view = {{"buffer", 1}, {"byteOffset", unpacked_}, {"byteLength", size}};
    if (target == kArrayBuffer) view["byteStride"] = stride;
    view["target"] = target;
    view["extensions"] = {{kMeshopt, std::move(packed)}};
    views_.push_back(std::move(view));
    unpacked_ = pad4(unpacked_ + size);
    return views_.size() - 1;
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
      return add_view(size, kArrayBuffer, 0,
                      [&attribute, &part](std::uint8_t* at) { store_items(attribute, part, at); });
    }
    return add_packed(std::move(prepared.streams[number]), kArrayBuffer, count, attribute.stride, "ATTRIBUTES");
  }

  Json add_part(const MeshPart& part, PreparedPart prepared) {
    constexpr const char* kTypes[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    Json named = Json::object();
    for (std::size_t number = 0; number < attributes_.size(); ++number) {
      const GlbAttribute& attribute = attributes_[number];
      named[attribute.name] = accessors_.size();
      Json& accessor = add_accessor(add_items(number, part, prepared), attribute.component, part.vertices.size(),
                                    kTypes[attribute.width]);
      if (attribute.is_normalized) accessor["normalized"] = true;
      if (attribute.name != "POSITION") continue;
      accessor["min"] = prepared.low;
      accessor["max"] = prepared.high;
    }
    Json primitive = {{"attributes", named}, {"indices", accessors_.size()}, {"material", 0}, {"mode", 4}};
    if (mesh_.channel_count > 0) {
      primitive["extras"]["channels"] = mesh_.channel_count;
      if (has_gaps(mesh_)) primitive["extras"]["noValue"] = kNoChannelValue;
    }
    const std::uint64_t corners = part.corners.size();
    const std::size_t view = options_.compress
                                 ? add_packed(std::move(prepared.triangles), kIndexBuffer, corners, 2, "TRIANGLES")
                                 : add_view(2 * corners, kIndexBuffer, 0, [&part](std::uint8_t* at) {
                                     for (const std::uint16_t corner : part.corners) store_number(at, corner);
                                   });
    add_accessor(view, kUint16Component, corners, "SCALAR");
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

  /// Returns the number of a texture that shows it.
  std::size_t add_texture(const std::uint8_t* bytes, std::size_t size, const std::string& mime_type) {
    const std::uint64_t offset = binary_.add(size, [bytes, size](std::uint8_t* at) { std::memcpy(at, bytes, size); });
    views_.push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}});
    json_["images"].push_back({{"bufferView", views_.size() - 1}, {"mimeType", mime_type}});
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
      // Beyond the border of the image there is nothing: its pixels end at the mesh's.
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
    // Colours of vertices and textures are multiplied with the material's.
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

  Result<std::vector<std::uint8_t>> assemble() const {
    std::string json = print_json(json_);
    json.resize(pad4(json.size()), ' ');
    const std::uint64_t binary = pad4(binary_.size());
    const std::uint64_t total = 28 + json.size() + binary;
    if (total > std::numeric_limits<std::uint32_t>::max()) {
      return fail(ErrorKind::kOutput,
                  fmt::format("a GLB file holds less than 4 GiB, and this mesh needs {:.1f} GiB; write PLY instead",
                              static_cast<double>(total) / (1 << 30)));
    }
    std::vector<std::uint8_t> bytes;
    resize_large(bytes, total, options_.threads);
    std::uint8_t* at = bytes.data();
    for (const std::uint32_t word : {kMagic, std::uint32_t{2}, static_cast<std::uint32_t>(total),
                                     static_cast<std::uint32_t>(json.size()), kJsonChunk}) {
      store_number(at, word);
    }
    std::memcpy(at, json.data(), json.size());
    at += json.size();
    store_number(at, static_cast<std::uint32_t>(binary));
    store_number(at, kBinaryChunk);
    binary_.write(at, options_.threads);
    return bytes;
  }

  static constexpr const char* kWebp = "image/webp";
  static constexpr const char* kWebpTexture = "EXT_texture_webp";

  const Mesh& mesh_;
  const GlbOptions& options_;
  const GlbGrid grid_;
  const std::vector<GlbAttribute> attributes_;
  const std::vector<MeshPart> parts_;
  Binary binary_;
  std::uint64_t unpacked_ = 0;  // bytes of the second buffer
  Json json_ = Json::object(), accessors_ = Json::array(), views_ = Json::array();
};

}  // namespace

Result<std::vector<std::uint8_t>> encode_glb(const Mesh& mesh) { return GlbWriter(mesh, {}).encode(); }

Result<std::vector<std::uint8_t>> encode_glb(const Mesh& mesh, const GlbOptions& options) {
  if (std::string why = find_unwritable(mesh, true); !why.empty()) return fail(ErrorKind::kOutput, std::move(why));
  try {
    return GlbWriter(mesh, options).encode();
  } catch (...) {
    return caught(ErrorKind::kInput, "encode the mesh");
  }
}

}  // namespace scarp
