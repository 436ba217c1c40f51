// A tile as a GLB file with y up, i.e. (x, z, −y) of the earth's axes, which 3D Tiles clients rotate back.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <string_view>
#include <utility>

#include "base/caught.h"
#include "io/mesh/file_bytes.h"
#include "io/mesh/glb_attributes.h"
#include "io/mesh/glb_builder.h"
#include "io/mesh/glb_numbers.h"
#include "io/mesh/meshopt_codec.h"
#include "io/tiles/json_members.h"
#include "io/tiles3d.h"
#include "scarp/version.h"

namespace scarp::io {
namespace {

constexpr const char* kTileEdges = "CESIUM_tile_edges";
constexpr const char* kWebpExtension = "EXT_texture_webp";
/// Index 65535 would end a strip of triangles.
constexpr std::size_t kShortIndices = 65535;
constexpr std::uint32_t kShort = 65535;
constexpr double kMostUnlike = 4;

/// The octahedral encoding in signed bytes, for decoding by EXT_meshopt_compression's filter: x, y, the value of 1, and
/// 0.
std::array<std::int8_t, 4> to_octahedral(const std::array<double, 3>& normal) {
  const double size = std::abs(normal[0]) + std::abs(normal[1]) + std::abs(normal[2]);
  double x = normal[0] / size, y = normal[1] / size;
  if (normal[2] < 0) {
    const double folded = (1 - std::abs(y)) * (x < 0 ? -1 : 1);
    y = (1 - std::abs(x)) * (y < 0 ? -1 : 1);
    x = folded;
  }
  const auto byte = [](double value) { return static_cast<std::int8_t>(std::floor(value * 127 + 0.5)); };
  return {byte(x), byte(y), 127, 0};
}

using Steps = std::array<std::uint32_t, 3>;

/// Vertices of the file: index in the tile (for normal and texture coordinates), and position.
struct GlbVertices {
  std::vector<std::uint32_t> of;
  std::vector<Steps> offsets;

  void add(std::uint32_t vertex, const Steps& offset) {
    of.push_back(vertex);
    offsets.push_back(offset);
  }
};

class TileGlbWriter {
 public:
  TileGlbWriter(const EarthTile& tile, const TileGlbOptions& options)
      : tile_(tile), options_(options), is_packed_(options.compress && kHasMeshoptCodec) {
    const auto hold = [&](const std::vector<Steps>& offsets) {
      for (const Steps& offset : offsets) {
        for (std::size_t k = 0; k < 3; ++k) size_[k] = std::max(size_[k], offset[k]);
      }
    };
    hold(tile.offsets);
    for (const std::vector<Steps>& feet : tile.feet) hold(feet);
    is_short_ = is_packed_ && *std::max_element(size_.begin(), size_.end()) <= kShort;
    has_short_indices_ = tile.offsets.size() <= kShortIndices;
    order_vertices();
  }

  Result<std::vector<std::uint8_t>> encode() {
    describe();
    Json surface = add_primitive(surface_, corners_);
    surface["extensions"][kTileEdges] = add_edges();
    Json primitives = Json::array({std::move(surface)});
    if (add_skirt(); !skirt_.of.empty()) {
      Json skirt = add_primitive(skirt_, skirt_corners_);
      skirt["extras"]["scarp"]["skirt"] = true;
      primitives.push_back(std::move(skirt));
    }
    glb_.json["meshes"] = Json::array({{{"primitives", std::move(primitives)}}});
    add_material();
    return glb_.assemble(1);
  }

 private:
  /// Sorts for the smallest encoding.
  void order_vertices() {
    std::vector<std::uint32_t>& vertices = surface_.of;
    for (std::uint32_t v = 0; v < tile_.offsets.size(); ++v) vertices.push_back(v);
    corners_ = tile_.triangles;
    if (is_packed_ && has_short_indices_) {
      std::vector<std::uint16_t> corners(corners_.begin(), corners_.end());
      order_for_codec(vertices, corners);
      corners_.assign(corners.begin(), corners.end());
    }
    places_.resize(vertices.size());
    for (std::uint32_t place = 0; place < vertices.size(); ++place) places_[vertices[place]] = place;
    for (const std::uint32_t v : vertices) surface_.offsets.push_back(tile_.offsets[v]);
  }

  /// Adds the skirt, facing outwards from the tile.
  void add_skirt() {
    const std::array edges{&tile_.west, &tile_.north, &tile_.east, &tile_.south};
    for (std::size_t side = 0; side < edges.size(); ++side) {
      const std::vector<Steps>& feet = tile_.feet[side];
      for (std::size_t k = 0; k < feet.size(); ++k) {
        const std::uint32_t vertex = (*edges[side])[k];
        const auto top = static_cast<std::uint32_t>(skirt_.of.size());
        skirt_.add(vertex, tile_.offsets[vertex]);
        skirt_.add(vertex, feet[k]);
        if (k == 0) continue;
        for (const std::uint32_t corner : {top - 2, top, top - 1, top - 1, top, top + 1})
          skirt_corners_.push_back(corner);
      }
    }
  }

  Json add_primitive(const GlbVertices& vertices, const std::vector<std::uint32_t>& corners) {
    Json attributes = Json::object();
    attributes["POSITION"] = add_positions(vertices);
    if (!tile_.normals.empty()) attributes["NORMAL"] = add_normals(vertices);
    if (options_.texture) attributes["TEXCOORD_0"] = add_places(vertices);
    const std::size_t indices = add_indices(corners, vertices.of.size());
    return {{"attributes", std::move(attributes)}, {"indices", indices}, {"material", 0}, {"mode", 4}};
  }

  void describe() {
    const TileFacts& facts = tile_.facts;
    Json extras = {{"min_height", facts.min_height},
                   {"max_height", facts.max_height},
                   {"sphere", facts.sphere},
                   {"horizon_point", facts.has_horizon() ? Json(facts.horizon_point) : Json(nullptr)}};
    glb_.json["asset"] = {
        {"version", "2.0"}, {"generator", std::string("scarp ") + version()}, {"extras", {{"scarp", extras}}}};
    std::vector<std::string> used{kTileEdges}, required;
    if (is_packed_) {
      used.emplace_back(kMeshoptExtension);
      used.emplace_back("KHR_mesh_quantization");
      required.emplace_back(kMeshoptExtension);
      required.emplace_back("KHR_mesh_quantization");
    }
    if (options_.texture && options_.texture->format == ImageFormat::kWebp) {
      used.emplace_back(kWebpExtension);
      required.emplace_back(kWebpExtension);
    }
    glb_.json["extensionsUsed"] = used;
    if (!required.empty()) glb_.json["extensionsRequired"] = required;
    glb_.json["scene"] = 0;
    glb_.json["scenes"] = Json::array({{{"nodes", {0}}}});
    const auto& [east, north, up] = tile_.steps;
    const double unit = is_short_ ? kShort : 1;
    const std::array<double, 3> origin =
        to_y_up(east * static_cast<double>(tile_.origin[0]), north * static_cast<double>(tile_.origin[1] + size_[1]),
                up * static_cast<double>(tile_.origin[2]));
    glb_.json["nodes"] = Json::array({{{"mesh", 0},
                                       {"matrix",
                                        {unit * east, 0.0, 0.0, 0.0, 0.0, unit * up, 0.0, 0.0, 0.0, 0.0, unit * north,
                                         0.0, origin[0], origin[1], origin[2], 1.0}}}});
  }

  /// Clients transform normals by the matrix's inverse. On a globe, the matrix's scale is uniform.
  std::array<double, 3> normal_before_matrix(std::uint32_t v) const {
    auto [x, y, z] = tile_.normals[v];
    const auto& [east, north, up] = tile_.steps;
    if (east == up && north == up) return to_y_up(x, y, z);
    x *= east;
    y *= north;
    z *= up;
    const double length = std::sqrt(x * x + y * y + z * z);
    return to_y_up(x / length, y / length, z / length);
  }

  /// Steps from the node's origin.
  Steps steps_of(const Steps& offset) const {
    const auto& [x, y, z] = offset;
    return {x, z, size_[1] - y};
  }

  template <class Number>
  std::vector<std::uint8_t> positions_as(const GlbVertices& vertices, std::size_t width) const {
    std::vector<std::uint8_t> items(vertices.of.size() * width * sizeof(Number));
    std::uint8_t* at = items.data();
    for (const Steps& offset : vertices.offsets) {
      for (const std::uint32_t step : steps_of(offset)) store_number(at, static_cast<Number>(step));
      for (std::size_t k = 3; k < width; ++k) store_number(at, Number{0});
    }
    return items;
  }

  std::size_t add_plain(std::vector<std::uint8_t> items, int target) {
    const std::uint64_t size = items.size();
    return glb_.add_view(size, target, 0,
                         [items = std::move(items)](std::uint8_t* at) { std::memcpy(at, items.data(), items.size()); });
  }

  std::size_t add_positions(const GlbVertices& vertices) {
    const std::uint64_t count = vertices.of.size();
    std::size_t view = 0;
    if (is_short_) {
      constexpr std::size_t kStride = 8;
      view = glb_.add_packed(encode_meshopt_attributes(positions_as<std::uint16_t>(vertices, 4), kStride), kArrayBuffer,
                             count, kStride, "ATTRIBUTES");
    } else {
      view = add_plain(positions_as<float>(vertices, 3), kArrayBuffer);
    }
    Steps low{steps_of(vertices.offsets[0])}, high{low};
    for (const Steps& offset : vertices.offsets) {
      const Steps steps = steps_of(offset);
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], steps[k]);
        high[k] = std::max(high[k], steps[k]);
      }
    }
    Json& accessor = glb_.add_accessor(view, is_short_ ? kUint16Component : kFloatComponent, count, "VEC3");
    if (is_short_) accessor["normalized"] = true;
    accessor["min"] = low;
    accessor["max"] = high;
    return glb_.accessor_count() - 1;
  }

  std::size_t add_normals(const GlbVertices& vertices) {
    const std::uint64_t count = vertices.of.size();
    std::size_t view = 0;
    // Bytes are too coarse for a plane's normals if steps differ much between axes.
    const auto [least, most] = std::minmax_element(tile_.steps.begin(), tile_.steps.end());
    const bool is_packed = is_packed_ && *most <= kMostUnlike * *least;
    if (is_packed) {
      constexpr std::size_t kStride = 4;
      std::vector<std::uint8_t> items(count * kStride);
      std::uint8_t* at = items.data();
      for (const std::uint32_t v : vertices.of) {
        for (const std::int8_t part : to_octahedral(normal_before_matrix(v))) store_number(at, part);
      }
      view = glb_.add_packed(encode_meshopt_attributes(items, kStride), kArrayBuffer, count, kStride, "ATTRIBUTES",
                             "OCTAHEDRAL");
    } else {
      std::vector<std::uint8_t> items(count * 12);
      std::uint8_t* at = items.data();
      for (const std::uint32_t v : vertices.of) {
        for (const double part : normal_before_matrix(v)) store_number(at, static_cast<float>(part));
      }
      view = add_plain(std::move(items), kArrayBuffer);
    }
    Json& accessor = glb_.add_accessor(view, is_packed ? kInt8Component : kFloatComponent, count, "VEC3");
    if (is_packed) accessor["normalized"] = true;
    return glb_.accessor_count() - 1;
  }

  /// Adds texture coordinates of vertices, measured from the top. The texture's outermost pixels are outside the tile.
  std::size_t add_places(const GlbVertices& vertices) {
    constexpr std::size_t kStride = 4;
    const std::uint64_t count = vertices.of.size();
    const double side = options_.texture->side;
    const auto whole = [&](double share) {
      return static_cast<std::uint16_t>(std::floor((1 + share * (side - 2)) / side * kShort + 0.5));
    };
    std::vector<std::uint8_t> items(count * kStride);
    std::uint8_t* at = items.data();
    for (const std::uint32_t v : vertices.of) {
      const auto& [west, north] = tile_.places[v];
      store_number(at, whole(west));
      store_number(at, whole(north));
    }
    const std::size_t view = is_packed_ ? glb_.add_packed(encode_meshopt_attributes(items, kStride), kArrayBuffer,
                                                          count, kStride, "ATTRIBUTES")
                                        : add_plain(std::move(items), kArrayBuffer);
    Json& accessor = glb_.add_accessor(view, kUint16Component, count, "VEC2");
    accessor["normalized"] = true;
    return glb_.accessor_count() - 1;
  }

  void add_material() {
    const auto& [red, green, blue] = kGroundColor;
    const Json color = options_.texture ? Json{1.0, 1.0, 1.0, 1.0} : Json{red, green, blue, 1.0};
    Json surface = {{"baseColorFactor", color}, {"metallicFactor", 0.0}, {"roughnessFactor", 1.0}};
    if (options_.texture) {
      const TileTexture& texture = *options_.texture;
      const bool is_webp = texture.format == ImageFormat::kWebp;
      const char* const type = is_webp                                ? "image/webp"
                               : texture.format == ImageFormat::kJpeg ? "image/jpeg"
                                                                      : "image/png";
      glb_.json["images"] = Json::array({{{"bufferView", add_plain(texture.bytes, 0)}, {"mimeType", type}}});
      constexpr int kLinear = 9729, kLinearMipmaps = 9987, kClamp = 33071;
      glb_.json["samplers"] =
          Json::array({{{"magFilter", kLinear}, {"minFilter", kLinearMipmaps}, {"wrapS", kClamp}, {"wrapT", kClamp}}});
      Json shown = {{"sampler", 0}};
      if (is_webp)
        shown["extensions"] = {{kWebpExtension, {{"source", 0}}}};
      else
        shown["source"] = 0;
      glb_.json["textures"] = Json::array({std::move(shown)});
      surface["baseColorTexture"] = {{"index", 0}};
    }
    glb_.json["materials"] = Json::array({{{"pbrMetallicRoughness", std::move(surface)}}});
  }

  std::vector<std::uint8_t> indices_of(const std::vector<std::uint32_t>& vertices) const {
    std::vector<std::uint8_t> items(vertices.size() * (has_short_indices_ ? 2 : 4));
    std::uint8_t* at = items.data();
    for (const std::uint32_t v : vertices) {
      if (has_short_indices_) {
        store_number(at, static_cast<std::uint16_t>(v));
      } else {
        store_number(at, v);
      }
    }
    return items;
  }

  int index_component() const { return has_short_indices_ ? kUint16Component : kUint32Component; }

  std::size_t add_indices(const std::vector<std::uint32_t>& corners, std::size_t vertex_count) {
    const std::uint64_t count = corners.size();
    std::size_t view = 0;
    if (is_packed_ && has_short_indices_) {
      const std::vector<std::uint16_t> short_corners(corners.begin(), corners.end());
      view =
          glb_.add_packed(encode_meshopt_triangles(short_corners, vertex_count), kIndexBuffer, count, 2, "TRIANGLES");
    } else {
      view = add_plain(indices_of(corners), kIndexBuffer);
    }
    glb_.add_accessor(view, index_component(), count, "SCALAR");
    return glb_.accessor_count() - 1;
  }

  /// All edges share one view, since more JSON would cost more than compression saves.
  Json add_edges() {
    const std::pair<const char*, const std::vector<std::uint32_t>*> edges[] = {
        {"left", &tile_.west}, {"bottom", &tile_.south}, {"right", &tile_.east}, {"top", &tile_.north}};
    std::vector<std::uint32_t> all;
    for (const auto& [name, vertices] : edges) {
      for (const std::uint32_t v : *vertices) all.push_back(places_[v]);
    }
    const std::size_t view = add_plain(indices_of(all), 0), size = has_short_indices_ ? 2 : 4;
    Json accessors = Json::object();
    std::size_t offset = 0;
    for (const auto& [name, vertices] : edges) {
      Json& accessor = glb_.add_accessor(view, index_component(), vertices->size(), "SCALAR");
      if (offset > 0) accessor["byteOffset"] = offset;
      offset += vertices->size() * size;
      accessors[name] = glb_.accessor_count() - 1;
    }
    return accessors;
  }

  const EarthTile& tile_;
  const TileGlbOptions& options_;
  bool is_packed_, is_short_ = false, has_short_indices_ = false;
  Steps size_{};                        ///< largest offsets
  GlbVertices surface_, skirt_;         ///< in the file's order
  std::vector<std::uint32_t> places_;   ///< indices of the tile's vertices in the file
  std::vector<std::uint32_t> corners_;  ///< corners of triangles, in the file's order
  std::vector<std::uint32_t> skirt_corners_;
  GlbBuilder glb_;
};

/// The numbers of an array of length N.
template <std::size_t N>
bool read_numbers(const Json& object, const char* key, std::array<double, N>& numbers) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_array() || found->size() != N) return false;
  for (std::size_t k = 0; k < N; ++k) {
    if (!(*found)[k].is_number()) return false;
    numbers[k] = (*found)[k].get<double>();
  }
  return true;
}

}  // namespace

Result<std::vector<std::uint8_t>> encode_tile_glb(const EarthTile& tile, const TileGlbOptions& options) {
  try {
    return TileGlbWriter(tile, options).encode();
  } catch (...) {
    return caught(ErrorKind::kInput, "encode the tile");
  }
}

Result<TileFacts> read_tile_facts(std::span<const std::uint8_t> glb) {
  constexpr std::size_t kHeader = 20;
  const auto refuse = [] { return fail(ErrorKind::kInput, "a tile is no GLB file of Scarp's"); };
  if (glb.size() < kHeader || std::memcmp(glb.data(), "glTF", 4) != 0) return refuse();
  const std::size_t length = load_number<std::uint32_t>(glb.data() + 12);
  if (load_number<std::uint32_t>(glb.data() + 16) != kJsonChunk || length > glb.size() - kHeader) return refuse();
  const auto json = parse_json(std::string_view(reinterpret_cast<const char*>(glb.data()) + kHeader, length));
  if (!json) return refuse();
  const Json* const scarp = find_member(find_member(find_member(&*json, "asset"), "extras"), "scarp");
  TileFacts facts;
  const auto low = find_number(scarp, "min_height"), high = find_number(scarp, "max_height");
  if (!low || !high || !read_numbers(*scarp, "sphere", facts.sphere)) return refuse();
  const Json* const horizon = find_member(scarp, "horizon_point");
  if (horizon == nullptr || (!horizon->is_null() && !read_numbers(*scarp, "horizon_point", facts.horizon_point)))
    return refuse();
  facts.min_height = *low;
  facts.max_height = *high;
  return facts;
}

}  // namespace scarp::io
