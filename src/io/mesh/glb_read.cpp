// Reads GLB from any writer: the part of glTF 2.0 that can represent a terrain.
//
// The file may be hostile (glb_arrays.h): the node tree is checked for loops. Unsupported features (Draco, sparse
// accessors, lines, external buffers) are rejected by name rather than misread.

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>

#include "io/mesh/file_bytes.h"
#include "io/mesh/glb_arrays.h"
#include "io/mesh/glb_json.h"
#include "io/mesh/glb_numbers.h"
#include "io/mesh/glb_transform.h"
#include "io/mesh/mesh_file.h"
#include "io/mesh/srgb.h"
#include "scarp/height_field.h"

namespace scarp::io {
namespace {

class GlbReader : public GlbArrays {
 public:
  explicit GlbReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  Mesh mesh;

  bool read() {
    if (!split_chunks() || !check_extensions()) return false;
    if (const Json* asset = member(json_, "asset")) {
      if (const Json* extras = member(*asset, "extras")) mesh.metadata = extras_to_metadata(*extras);
      const Json* generator = member(*asset, "generator");
      if (generator && generator->is_string()) mesh.metadata.emplace("generator", generator->get<std::string>());
    }
    return read_scene();
  }

 private:
  bool read_numbers(const Json& object, const char* key, double* values, std::size_t count, bool& present) {
    const Json* found = member(object, key);
    present = found != nullptr;
    if (!present) return true;
    if (!found->is_array() || found->size() != count) return refuse(fmt::format("a node's '{}' is malformed", key));
    for (std::size_t i = 0; i < count; ++i) {
      if (!(*found)[i].is_number()) return refuse(fmt::format("a node's '{}' is malformed", key));
      values[i] = (*found)[i].get<double>();
    }
    return true;
  }

  bool split_chunks() {
    if (bytes_.size() < 20)
      return refuse(fmt::format("it ends after {} bytes, within the header of a GLB file", bytes_.size()));
    const std::uint32_t version = load_number<std::uint32_t>(&bytes_[4]);
    if (version != 2) return refuse(fmt::format("it is glTF version {}; only version 2 can be read", version));
    const std::uint32_t length = load_number<std::uint32_t>(&bytes_[8]);
    if (length > bytes_.size()) {
      return refuse(fmt::format("it ends after {} of {} bytes: it was cut off", bytes_.size(), length));
    }
    std::size_t at = 12;
    bool has_json = false;
    while (at + 8 <= length) {
      const std::uint32_t size = load_number<std::uint32_t>(&bytes_[at]),
                          type = load_number<std::uint32_t>(&bytes_[at + 4]);
      at += 8;
      if (size > length - at) return refuse(fmt::format("its chunk at byte {} reaches beyond the file's end", at - 8));
      const auto chunk = bytes_.subspan(at, size);
      at += size;
      if (type == kJsonChunk && !has_json) {
        auto json = parse_json({reinterpret_cast<const char*>(chunk.data()), chunk.size()});
        if (!json || !json->is_object()) return refuse("its JSON chunk is malformed");
        json_ = std::move(*json);
        has_json = true;
      } else if (type == kBinaryChunk && binary_.empty()) {
        binary_ = chunk;
      }
    }
    return has_json || refuse("it has no JSON chunk");
  }

  bool check_extensions() {
    const Json* required = member(json_, "extensionsRequired");
    if (!required || !required->is_array()) return true;
    for (const Json& name : *required) {
      if (!name.is_string()) continue;
      const auto& text = name.get_ref<const std::string&>();
      const bool harmless = text.starts_with("KHR_materials_") || text.starts_with("KHR_texture_") ||
                            text.starts_with("EXT_texture_") || text.starts_with("KHR_lights_") ||
                            text == "KHR_mesh_quantization" || text == "EXT_meshopt_compression";
      if (!harmless) return refuse(fmt::format("it needs the glTF extension {}, which is not supported", text));
    }
    return true;
  }

  /// Visits the nodes of the default scene, else of the first scene, else all nodes. Without nodes, visits all meshes.
  bool read_scene() {
    const Json* nodes = member(json_, "nodes");
    if (!nodes || !nodes->is_array() || nodes->empty()) {
      const Json* meshes = member(json_, "meshes");
      const std::size_t count = meshes && meshes->is_array() ? meshes->size() : 0;
      for (std::size_t m = 0; m < count; ++m) {
        if (!read_mesh(m, Transform{})) return false;
      }
      return true;
    }
    seen_.assign(nodes->size(), false);
    std::vector<std::uint64_t> roots;
    const Json* scenes = member(json_, "scenes");
    if (scenes && scenes->is_array() && !scenes->empty()) {
      std::uint64_t index = 0;
      if (!read_count(json_, "scene", 0, index)) return false;
      const Json* scene = item("scenes", index);
      if (!scene || !read_node_list(*scene, "nodes", roots)) return false;
    } else {
      std::vector<bool> is_child(nodes->size(), false);
      std::vector<std::uint64_t> children;
      for (const Json& node : *nodes) {
        children.clear();
        if (!read_node_list(node, "children", children)) return false;
        for (const std::uint64_t child : children) is_child[child] = true;
      }
      for (std::size_t n = 0; n < nodes->size(); ++n) {
        if (!is_child[n]) roots.push_back(n);
      }
    }
    return read_nodes(roots);
  }

  bool read_node_list(const Json& object, const char* key, std::vector<std::uint64_t>& list) {
    const Json* found = member(object, key);
    if (!found) return true;
    if (!found->is_array()) return refuse(fmt::format("a list '{}' in its JSON is malformed", key));
    for (const Json& index : *found) {
      if (!index.is_number_unsigned() || index.get<std::uint64_t>() >= seen_.size()) {
        return refuse(fmt::format("a list '{}' in its JSON names a node that does not exist", key));
      }
      list.push_back(index.get<std::uint64_t>());
    }
    return true;
  }

  bool read_nodes(const std::vector<std::uint64_t>& roots) {
    struct Visit {
      std::uint64_t node;
      Transform parent;
    };
    std::vector<Visit> stack;
    for (auto root = roots.rbegin(); root != roots.rend(); ++root) stack.push_back({*root, Transform{}});
    std::vector<std::uint64_t> children;
    while (!stack.empty()) {
      const Visit visit = stack.back();
      stack.pop_back();
      if (seen_[visit.node]) return refuse(fmt::format("its node {} has more than one parent", visit.node));
      seen_[visit.node] = true;
      const Json* node = item("nodes", visit.node);
      Transform local;
      if (!node || !read_transform(*node, local)) return false;
      const Transform global = visit.parent * local;
      if (member(*node, "mesh")) {
        std::uint64_t index = 0;
        if (!read_count(*node, "mesh", 0, index) || !read_mesh(index, global)) return false;
      }
      children.clear();
      if (!read_node_list(*node, "children", children)) return false;
      for (auto child = children.rbegin(); child != children.rend(); ++child) stack.push_back({*child, global});
    }
    return true;
  }

  bool read_transform(const Json& node, Transform& local) {
    double m[16], q[4] = {0, 0, 0, 1}, s[3] = {1, 1, 1};
    bool present = false;
    if (!read_numbers(node, "matrix", m, 16, present)) return false;
    if (present) {
      for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) local.linear[c][r] = m[4 * c + r];
        local.translation[c] = m[12 + c];
      }
      return true;
    }
    if (!read_numbers(node, "translation", local.translation, 3, present) ||
        !read_numbers(node, "rotation", q, 4, present) || !read_numbers(node, "scale", s, 3, present)) {
      return false;
    }
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    const double rotation[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
                                   {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
                                   {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)}};
    for (int c = 0; c < 3; ++c) {
      for (int r = 0; r < 3; ++r) local.linear[c][r] = rotation[c][r] * s[c];
    }
    return true;
  }

  bool read_mesh(std::uint64_t index, const Transform& transform) {
    const Json* found = item("meshes", index);
    const Json* primitives = found ? member(*found, "primitives") : nullptr;
    if (!primitives || !primitives->is_array()) return refuse(fmt::format("its mesh {} is malformed", index));
    std::map<std::uint64_t, std::uint32_t> first_vertices;  // first vertex of each position accessor already read
    for (const Json& primitive : *primitives) {
      if (is_skirt(primitive)) continue;
      std::uint64_t mode = 0;
      if (!read_count(primitive, "mode", 4, mode)) return false;
      if (mode != 4)
        return refuse(fmt::format("its mesh {} has primitives of mode {}, not triangles (mode 4)", index, mode));
      if (!read_primitive(primitive, transform, first_vertices)) return false;
    }
    return true;
  }

  bool read_primitive(const Json& primitive, const Transform& transform,
                      std::map<std::uint64_t, std::uint32_t>& first_vertices) {
    const Json* attributes = member(primitive, "attributes");
    if (!attributes || !member(*attributes, "POSITION")) return refuse("a primitive has no positions");
    std::uint64_t accessor = 0;
    GlbItems positions;
    if (!read_count(*attributes, "POSITION", 0, accessor) || !find_items(accessor, "VEC3", positions)) return false;
    if (positions.component_type == kUint32Component)
      return refuse(fmt::format("its accessor {} of positions is neither float32 nor of 8 or 16 bits", accessor));
    const auto known = first_vertices.find(accessor);
    const bool is_new = known == first_vertices.end();
    const std::uint32_t first = is_new ? static_cast<std::uint32_t>(mesh.vertex_count()) : known->second;
    if (is_new) {
      if (!append_positions(positions, transform)) return false;
      first_vertices.emplace(accessor, first);
      if (!append_normals(*attributes, positions.count, transform) || !append_uvs(*attributes, positions.count) ||
          !append_colors(*attributes, positions.count) || !append_channels(primitive, *attributes, positions.count)) {
        return false;
      }
    }
    return append_triangles(primitive, positions.count, first, transform.determinant() < 0);
  }

  bool append_positions(const GlbItems& items, const Transform& transform) {
    // Instances may multiply a file's contents. Terrains use no instances, but malicious files may use millions.
    const std::uint64_t most = std::max<std::uint64_t>(std::uint64_t{1} << 24, 16 * bytes_.size() / 12);
    if (items.count > most || mesh.vertex_count() + items.count > most)
      return refuse("it repeats its meshes too often");
    if (mesh.positions.empty()) {
      const double* t = transform.translation;
      mesh.origin = {t[0] + 0.0, 0.0 - t[2], t[1] + 0.0};
    }
    for (std::uint64_t v = 0; v < items.count; ++v) {
      const double p[3] = {items.number(v, 0), items.number(v, 1), items.number(v, 2)};
      const auto q = transform.apply_linear(p);
      const double* t = transform.translation;
      mesh.positions.push_back(q[0] + (t[0] - mesh.origin[0]));
      mesh.positions.push_back(0.0 - (q[2] + (t[2] + mesh.origin[1])));
      mesh.positions.push_back(q[1] + (t[1] - mesh.origin[2]));
    }
    return true;
  }

  bool append_normals(const Json& attributes, std::uint64_t count, const Transform& transform) {
    if (!member(attributes, "NORMAL")) return true;
    std::uint64_t accessor = 0;
    GlbItems normals;
    if (!read_count(attributes, "NORMAL", 0, accessor) || !find_items(accessor, "VEC3", normals)) return false;
    if (normals.component_type == kUint32Component || normals.count != count)
      return refuse(fmt::format("its accessor {} of normals is malformed", accessor));
    for (std::uint64_t v = 0; v < count; ++v) {
      const double given[3] = {normals.number(v, 0), normals.number(v, 1), normals.number(v, 2)};
      for (const double component : given) {
        if (!std::isfinite(component)) return refuse(fmt::format("normal {} is not finite", v));
      }
      const auto n =
          transform.is_translation() ? std::array{given[0], given[1], given[2]} : transform.apply_normal(given);
      const auto x = static_cast<float>(n[0]), y = static_cast<float>(n[1]), z = static_cast<float>(n[2]);
      mesh.normals.insert(mesh.normals.end(), {x, 0.0f - z, y});
    }
    return true;
  }

  /// The items of a numeric attribute: float32, or integers that represent 0 … 1.
  bool find_attribute(const Json& attributes, const char* name, std::string_view type, std::uint64_t count,
                      GlbItems& items) {
    std::uint64_t accessor = 0;
    if (!read_count(attributes, name, 0, accessor) || !find_items(accessor, type, items)) return false;
    if (items.component_type != kUint32Component && items.count == count) return true;
    return refuse(fmt::format("its accessor {} of {} is malformed", accessor, name));
  }

  /// Integers represent 0 … 1 in colours and texture coordinates, whether or not the file declares it.
  static double load_component(GlbItems items, std::uint64_t v, std::uint64_t k) {
    items.is_normalized = true;
    return items.number(v, k);
  }

  bool append_uvs(const Json& attributes, std::uint64_t count) {
    if (!member(attributes, "TEXCOORD_0")) return true;
    GlbItems uvs;
    if (!find_attribute(attributes, "TEXCOORD_0", "VEC2", count, uvs)) return false;
    for (std::uint64_t i = 0; i < 2 * count; ++i) {
      const double value = load_component(uvs, i / 2, i % 2);
      if (!std::isfinite(value)) return refuse(fmt::format("texture coordinate {} is not finite", i / 2));
      mesh.uvs.push_back(static_cast<float>(value));
    }
    return true;
  }

  /// Colours in linear light, with or without alpha.
  bool append_colors(const Json& attributes, std::uint64_t count) {
    if (!member(attributes, "COLOR_0")) return true;
    std::uint64_t accessor = 0;
    if (!read_count(attributes, "COLOR_0", 0, accessor)) return false;
    const Json* described = item("accessors", accessor);
    if (!described) return false;
    const Json* type = member(*described, "type");
    const bool with_alpha = type && type->is_string() && type->get_ref<const std::string&>() == "VEC4";
    GlbItems colors;
    if (!find_attribute(attributes, "COLOR_0", with_alpha ? "VEC4" : "VEC3", count, colors)) return false;
    for (std::uint64_t i = 0; i < 3 * count; ++i) {
      const double value = load_component(colors, i / 3, i % 3);
      if (!std::isfinite(value)) return refuse(fmt::format("colour {} is not finite", i / 3));
      mesh.colors.push_back(srgb_of_linear(value));
    }
    return true;
  }

  /// Scarp's own "_CHANNEL_n". If extras announce channels that are absent, the colours are used.
  bool append_channels(const Json& primitive, const Json& attributes, std::uint64_t count) {
    std::vector<GlbItems> channels;
    while (channels.size() < kMaxChannels) {
      const std::string name = fmt::format("_CHANNEL_{}", channels.size() + 1);
      if (!member(attributes, name.c_str())) break;
      channels.emplace_back();
      if (!find_attribute(attributes, name.c_str(), "SCALAR", count, channels.back())) return false;
      if (channels.back().component_type != kFloatComponent) return true;  // another program's
    }
    const Json* extras = member(primitive, "extras");
    const Json* announced = extras ? member(*extras, "channels") : nullptr;
    const Json* no_value = extras ? member(*extras, "noValue") : nullptr;
    const bool by_colors = channels.empty() && announced && (*announced == 1 || *announced == 3) &&
                           mesh.colors.size() == mesh.positions.size();
    const std::size_t width = by_colors ? announced->get<std::size_t>() : channels.size();
    if (width == 0) return true;
    if (mesh.channel_count == 0 && mesh.channels.empty()) mesh.channel_count = static_cast<int>(width);
    if (static_cast<std::size_t>(mesh.channel_count) != width) {
      mesh.channel_count = -1;  // parts with different channels
      return true;
    }
    if (mesh.channels.size() + width * count > most_numbers()) return refuse("it repeats its meshes too often");
    const double gap =
        no_value && no_value->is_number() ? no_value->get<double>() : std::numeric_limits<double>::quiet_NaN();
    for (std::uint64_t v = 0; v < count; ++v) {
      for (std::size_t c = 0; c < width; ++c) {
        const double value =
            by_colors ? mesh.colors[mesh.colors.size() - 3 * (count - v) + c] : load_component(channels[c], v, 0);
        mesh.channels.push_back(value == gap ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(value));
      }
    }
    return true;
  }

  bool append_triangles(const Json& primitive, std::uint64_t vertices, std::uint32_t first, bool mirrored) {
    GlbItems indices;
    std::uint64_t accessor = 0, corners = vertices;
    const bool indexed = member(primitive, "indices") != nullptr;
    if (indexed) {
      if (!read_count(primitive, "indices", 0, accessor) || !find_items(accessor, "SCALAR", indices)) return false;
      if (indices.component_type == kFloatComponent)
        return refuse(fmt::format("its accessor {} of indices is not integer", accessor));
      corners = indices.count;
    }
    if (corners % 3 != 0) return refuse(fmt::format("its triangles have {} corners, no multiple of 3", corners));
    if (corners > most_corners()) return refuse("it repeats its meshes too often");
    const std::size_t start = mesh.triangles.size();
    for (std::uint64_t i = 0; i < corners; ++i) {
      const std::uint64_t vertex = indexed ? indices.index(i) : i;
      if (vertex >= vertices) {
        return refuse(fmt::format("index {} of accessor {} names vertex {} of {}", i, accessor, vertex, vertices));
      }
      mesh.triangles.push_back(first + static_cast<std::uint32_t>(vertex));
    }
    for (std::size_t i = start; mirrored && i < mesh.triangles.size(); i += 3) {
      std::swap(mesh.triangles[i + 1], mesh.triangles[i + 2]);
    }
    return true;
  }

  std::uint64_t most_numbers() const { return std::max<std::uint64_t>(std::uint64_t{1} << 26, 16 * bytes_.size()); }
  std::uint64_t most_corners() const {
    return most_numbers() - std::min<std::uint64_t>(most_numbers(), mesh.triangles.size());
  }

  std::span<const std::uint8_t> bytes_;
  std::vector<bool> seen_;
};

}  // namespace

Result<Mesh> decode_glb(std::span<const std::uint8_t> bytes) {
  GlbReader reader(bytes);
  if (!reader.read()) return fail(ErrorKind::kInput, std::move(reader.complaint));
  return std::move(reader.mesh);
}

}  // namespace scarp::io
