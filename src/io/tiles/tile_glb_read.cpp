// Reads terrain tiles from GLB files: the part of glTF that Scarp writes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "base/caught.h"
#include "io/mesh/file_bytes.h"
#include "io/mesh/glb_arrays.h"
#include "io/mesh/glb_numbers.h"
#include "io/tiles3d.h"

namespace scarp::io {
namespace {

class TileGlbReader : public GlbArrays {
 public:
  TileGlb tile;

  bool read(std::span<const std::uint8_t> bytes) {
    if (!split(bytes) || !read_node()) return false;
    const Json* const mesh = item("meshes", 0);
    const Json* const primitives = mesh != nullptr ? member(*mesh, "primitives") : nullptr;
    if (primitives == nullptr || !primitives->is_array() || primitives->empty()) return refuse("it has no mesh");
    // Only a skirt is allowed in addition to the surface.
    for (std::size_t k = 1; k < primitives->size(); ++k) {
      if (k > 1 || !is_skirt((*primitives)[k])) return refuse("it has more surfaces than one");
    }
    const Json& primitive = primitives->front();
    const Json* const attributes = member(primitive, "attributes");
    std::uint64_t accessor = 0;
    if (attributes == nullptr || member(*attributes, "POSITION") == nullptr) return refuse("it has no positions");
    if (!read_count(*attributes, "POSITION", 0, accessor) || !read_positions(accessor, tile.positions)) return false;
    if (member(*attributes, "NORMAL") != nullptr &&
        (!read_count(*attributes, "NORMAL", 0, accessor) || !read_normals(accessor)))
      return false;
    if (!read_triangles(primitive, tile.positions.size(), tile.triangles)) return false;
    if (!read_image(primitive, *attributes) || !read_edges(primitive)) return false;
    return primitives->size() == 1 || read_skirt((*primitives)[1]);
  }

 private:
  bool split(std::span<const std::uint8_t> bytes) {
    constexpr std::size_t kHead = 12, kChunkHead = 8;
    if (bytes.size() < kHead + kChunkHead || std::memcmp(bytes.data(), "glTF", 4) != 0)
      return refuse("it is no GLB file");
    if (load_number<std::uint32_t>(bytes.data() + 8) != bytes.size()) return refuse("it was cut off");
    const std::size_t size = load_number<std::uint32_t>(bytes.data() + kHead);
    if (load_number<std::uint32_t>(bytes.data() + kHead + 4) != kJsonChunk || size > bytes.size() - kHead - kChunkHead)
      return refuse("it has no JSON");
    auto json = parse_json({reinterpret_cast<const char*>(bytes.data()) + kHead + kChunkHead, size});
    if (!json || !json->is_object()) return refuse("it has no JSON");
    json_ = std::move(*json);
    const std::span<const std::uint8_t> rest = bytes.subspan(kHead + kChunkHead + size);
    if (rest.size() < kChunkHead || load_number<std::uint32_t>(rest.data() + 4) != kBinaryChunk ||
        load_number<std::uint32_t>(rest.data()) > rest.size() - kChunkHead)
      return refuse("it has no numbers, or was cut off");
    binary_ = rest.subspan(kChunkHead, load_number<std::uint32_t>(rest.data()));
    return true;
  }

  bool read_node() {
    const Json* const node = item("nodes", 0);
    const Json* const matrix = node != nullptr ? member(*node, "matrix") : nullptr;
    if (matrix == nullptr || !matrix->is_array() || matrix->size() != 16) return refuse("it has no node with a matrix");
    std::array<double, 16> m{};
    for (std::size_t k = 0; k < m.size(); ++k) {
      if (!(*matrix)[k].is_number()) return refuse("it has no node with a matrix");
      m[k] = (*matrix)[k].get<double>();
    }
    for (std::size_t k = 0; k < 12; ++k) {
      if (k % 5 != 0 && m[k] != 0) return refuse("it is turned or sheared by its matrix");
    }
    scale_ = {m[0], m[5], m[10]};
    origin_ = {m[12], m[13], m[14]};
    return *std::min_element(scale_.begin(), scale_.end()) > 0 || refuse("it has no node with a matrix");
  }

  bool read_positions(std::uint64_t accessor, std::vector<std::array<double, 3>>& positions) {
    GlbItems items;
    if (!find_items(accessor, "VEC3", items)) return false;
    std::array<double, 3> scale = scale_;
    if (items.is_normalized) {
      // Exact, since the numbers are whole steps.
      if (items.component_type != kUint16Component) return refuse("it has positions of another type than Scarp writes");
      items.is_normalized = false;
      for (double& step : scale) step /= 65535;
    }
    tile.step = *std::max_element(scale.begin(), scale.end());
    for (std::uint64_t v = 0; v < items.count; ++v) {
      std::array<double, 3> at{};
      for (std::size_t k = 0; k < 3; ++k) at[k] = items.number(v, k) * scale[k] + origin_[k];
      for (const double metres : at) {
        if (!(std::abs(metres) < 1e9)) return refuse("it has a position far from any planet");
      }
      positions.push_back({at[0], 0.0 - at[2], at[1]});
    }
    return true;
  }

  bool read_normals(std::uint64_t accessor) {
    GlbItems items;
    if (!find_items(accessor, "VEC3", items)) return false;
    if (items.count != tile.positions.size()) return refuse("it has another number of normals than of positions");
    const bool is_even = scale_[0] == scale_[1] && scale_[0] == scale_[2];
    for (std::uint64_t v = 0; v < items.count; ++v) {
      std::array<double, 3> normal{items.number(v, 0), items.number(v, 1), items.number(v, 2)};
      if (!is_even) {
        double length = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          normal[k] *= scale_[1] / scale_[k];
          length += normal[k] * normal[k];
        }
        for (double& part : normal) part /= std::sqrt(length);
      }
      tile.normals.push_back({normal[0], 0.0 - normal[2], normal[1]});
    }
    return true;
  }

  bool read_triangles(const Json& primitive, std::size_t vertices, std::vector<std::uint32_t>& corners) {
    std::uint64_t accessor = 0;
    if (!read_count(primitive, "indices", UINT64_MAX, accessor) || !read_indices(accessor, vertices, corners))
      return false;
    return corners.size() % 3 == 0 || refuse("it has triangles of less than three corners");
  }

  bool read_skirt(const Json& primitive) {
    const Json* const attributes = member(primitive, "attributes");
    std::uint64_t accessor = 0;
    if (attributes == nullptr || member(*attributes, "POSITION") == nullptr)
      return refuse("its skirt has no positions");
    if (!read_count(*attributes, "POSITION", 0, accessor) || !read_positions(accessor, tile.skirt)) return false;
    return read_triangles(primitive, tile.skirt.size(), tile.skirt_triangles);
  }

  bool read_indices(std::uint64_t accessor, std::size_t vertices, std::vector<std::uint32_t>& indices) {
    GlbItems items;
    if (!find_items(accessor, "SCALAR", items)) return false;
    if (items.component_type != kUint16Component && items.component_type != kUint32Component)
      return refuse("it has indices of another type than Scarp writes");
    for (std::uint64_t k = 0; k < items.count; ++k) {
      const std::uint64_t vertex = items.index(k);
      if (vertex >= vertices) return refuse("it has a triangle or an edge of a vertex that is not there");
      indices.push_back(static_cast<std::uint32_t>(vertex));
    }
    return true;
  }

  /// The texture of a primitive's material; null, without a complaint, if none.
  const Json* find_texture(const Json& primitive) {
    std::uint64_t index = 0;
    if (member(primitive, "material") == nullptr || !read_count(primitive, "material", 0, index)) return nullptr;
    const Json* found = item("materials", index);
    for (const char* key : {"pbrMetallicRoughness", "baseColorTexture"}) {
      if (found != nullptr) found = member(*found, key);
    }
    if (found == nullptr || !read_count(*found, "index", UINT64_MAX, index)) return nullptr;
    return item("textures", index);
  }

  bool read_image(const Json& primitive, const Json& attributes) {
    const Json* texture = find_texture(primitive);
    if (texture == nullptr || member(attributes, "TEXCOORD_0") == nullptr) return complaint.empty();
    if (const Json* const extensions = member(*texture, "extensions")) {
      if (const Json* const webp = member(*extensions, "EXT_texture_webp")) texture = webp;
    }
    std::uint64_t index = 0, view_index = 0, accessor = 0;
    if (!read_count(*texture, "source", UINT64_MAX, index)) return false;
    const Json* const image = item("images", index);
    if (image == nullptr) return false;
    const Json* const type = member(*image, "mimeType");
    if (member(*image, "bufferView") == nullptr || type == nullptr || !type->is_string())
      return refuse("it has an image that lies elsewhere");
    View view;
    GlbItems items;
    if (!read_count(*image, "bufferView", 0, view_index) || !find_view(view_index, view) ||
        !read_count(attributes, "TEXCOORD_0", 0, accessor) || !find_items(accessor, "VEC2", items))
      return false;
    if (items.count != tile.positions.size())
      return refuse("it has another number of places in its image than of positions");
    for (std::uint64_t v = 0; v < items.count; ++v) {
      for (std::uint64_t k = 0; k < 2; ++k) tile.uvs.push_back(static_cast<float>(items.number(v, k)));
    }
    tile.image = {{view.bytes.begin(), view.bytes.end()}, type->get<std::string>()};
    return true;
  }

  bool read_edges(const Json& primitive) {
    const Json* const extensions = member(primitive, "extensions");
    const Json* const edges = extensions != nullptr ? member(*extensions, "CESIUM_tile_edges") : nullptr;
    if (edges == nullptr) return refuse("it does not list its edges");
    const std::pair<const char*, std::vector<std::uint32_t>*> lists[] = {
        {"left", &tile.west}, {"bottom", &tile.south}, {"right", &tile.east}, {"top", &tile.north}};
    for (const auto& [name, list] : lists) {
      std::uint64_t accessor = 0;
      if (!read_count(*edges, name, UINT64_MAX, accessor) || !read_indices(accessor, tile.positions.size(), *list))
        return false;
    }
    return true;
  }

  std::array<double, 3> scale_{1, 1, 1};
  std::array<double, 3> origin_{};
};

}  // namespace

Result<TileGlb> decode_tile_glb(std::span<const std::uint8_t> bytes, const std::string& name_for_errors) {
  try {
    TileGlbReader reader;
    if (!reader.read(bytes)) return fail(ErrorKind::kInput, fmt::format("{}: {}", name_for_errors, reader.complaint));
    const auto facts = read_tile_facts(bytes);
    if (!facts) return fail(ErrorKind::kInput, fmt::format("{} does not tell its heights and sphere", name_for_errors));
    reader.tile.facts = *facts;
    return std::move(reader.tile);
  } catch (...) {
    return caught(ErrorKind::kInput, fmt::format("decode {}", name_for_errors));
  }
}

}  // namespace scarp::io
