// MSH 4.1 of Gmsh, as text. Nodes and elements are in blocks, each for one entity. A material's triangles are a
// surface, and a node string is a curve. Each entity belongs to a physical group, whose name solvers use. Nodes keep
// the order of the mesh's vertices, and elements have the numbers of its triangles. A section $Comments holds metadata.
//
// The reader also accepts version 2, which other programs write: each section has a single list.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "io/mesh/formats.h"
#include "io/mesh/id_table.h"
#include "io/mesh/mesh_file.h"
#include "io/mesh/mesh_file_text.h"
#include "io/mesh/text_comments.h"
#include "scarp/io.h"

namespace scarp::io {
namespace {

enum GmshElement : std::int64_t { kGmshLine = 1, kGmshTriangle = 2, kGmshQuadrangle = 3, kGmshPoint = 15 };

/// Nodes of an element with straight edges and no inner nodes; 0 for all others.
int corners_of_gmsh(std::int64_t type) {
  switch (type) {
    case kGmshPoint:
      return 1;
    case kGmshLine:
      return 2;
    case kGmshTriangle:
      return 3;
    case kGmshQuadrangle:
      return 4;
    default:
      return 0;
  }
}

struct PhysicalGroup {
  int dimension;
  std::uint32_t tag;
  std::string name;
};

/// A surface with triangles, or a curve with the nodes of a line.
struct GmshEntity {
  int dimension;
  std::uint32_t tag;    ///< from 1, per dimension
  std::uint32_t group;  ///< tag of its physical group
  std::vector<std::uint32_t> parts;
  std::size_t element_count() const { return dimension == 2 ? parts.size() : parts.size() - 1; }
};

/// A name as quoted text. Gmsh truncates long names.
std::string gmsh_name(std::string name) {
  constexpr std::size_t kMost = 120;
  for (char& c : name) {
    if (c == '"' || static_cast<unsigned char>(c) < 32) c = '_';
  }
  if (name.size() <= kMost) return name;
  std::size_t size = kMost;
  while (size > 0 && (static_cast<unsigned char>(name[size]) & 0xC0) == 0x80) --size;  // within a character
  name.resize(size);
  return name;
}

class GmshWriter {
 public:
  GmshWriter(const Mesh& mesh, const MeshZones& zones) : mesh_(mesh) {
    add_surfaces(zones.materials);
    add_curves(zones.node_strings);
  }

  std::vector<std::uint8_t> write() {
    bytes_.reserve(mesh_.positions.size() * 20 + mesh_.triangles.size() * 12);
    put("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n");
    write_comments();
    put("$PhysicalNames\n{}\n", groups_.size());
    for (const PhysicalGroup& group : groups_) put("{} {} \"{}\"\n", group.dimension, group.tag, gmsh_name(group.name));
    put("$EndPhysicalNames\n");
    write_entities();
    write_nodes();
    write_elements();
    return std::move(bytes_);
  }

 private:
  template <class... Values>
  void put(fmt::format_string<Values...> text, Values&&... values) {
    fmt::format_to(std::back_inserter(bytes_), text, std::forward<Values>(values)...);
  }

  void add_surfaces(const std::vector<std::uint32_t>& materials) {
    std::map<std::uint32_t, std::vector<std::uint32_t>> triangles_of;
    if (materials.empty()) {
      groups_.push_back({2, 1, "terrain"});
      entities_.push_back({2, 1, 1, std::vector<std::uint32_t>(mesh_.triangle_count())});
      std::iota(entities_[0].parts.begin(), entities_[0].parts.end(), 0u);
      return;
    }
    for (std::size_t t = 0; t < materials.size(); ++t) {
      triangles_of[materials[t]].push_back(static_cast<std::uint32_t>(t));
    }
    std::uint32_t in_place_of_0 = 1;  // Gmsh counts groups from 1
    while (triangles_of.contains(in_place_of_0)) ++in_place_of_0;
    for (auto& [material, triangles] : triangles_of) {
      const std::uint32_t tag = material != 0 ? material : in_place_of_0;
      groups_.push_back({2, tag, fmt::format("material_{}", material)});
      entities_.push_back({2, static_cast<std::uint32_t>(entities_.size() + 1), tag, std::move(triangles)});
    }
  }

  /// The parts of one line share a group.
  void add_curves(const std::vector<NodeString>& strings) {
    std::map<std::string, std::uint32_t> groups;
    std::uint32_t tag = 0;
    for (const NodeString& string : strings) {
      if (string.nodes.size() < 2) continue;
      const auto [group, is_new] = groups.try_emplace(string.name, static_cast<std::uint32_t>(groups.size() + 1));
      if (is_new) groups_.push_back({1, group->second, string.name});
      entities_.push_back({1, ++tag, group->second, string.nodes});
    }
  }

  void write_comments() {
    std::vector<std::uint8_t> comments;
    TextComments::write(mesh_, comments);
    put("$Comments\n");
    for (const std::uint8_t byte : comments) {  // Gmsh reads lines in chunks of 255 bytes, and starts a section at each
                                                // '$'
      if (byte == '$') {
        put("%24");
      } else {
        bytes_.push_back(byte);
      }
    }
    put("$EndComments\n");
  }

  /// The six numbers of an entity's bounding box.
  std::string box_of(const GmshEntity& entity) const {
    std::array<double, 3> low, high;
    low.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
    const auto add = [&](std::uint32_t v) {
      const auto p = mesh_.vertex(v);
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], p[k]);
        high[k] = std::max(high[k], p[k]);
      }
    };
    for (const std::uint32_t part : entity.parts) {
      if (entity.dimension == 1) add(part);
      for (std::size_t k = 0; k < 3 && entity.dimension == 2; ++k) add(mesh_.triangles[3 * std::size_t{part} + k]);
    }
    return fmt::format("{} {} {} {} {} {}", low[0], low[1], low[2], high[0], high[1], high[2]);
  }

  void write_entities() {
    const auto is_curve = [](const GmshEntity& entity) { return entity.dimension == 1; };
    const auto curves = std::count_if(entities_.begin(), entities_.end(), is_curve);
    put("$Entities\n0 {} {} 0\n", curves, static_cast<std::ptrdiff_t>(entities_.size()) - curves);
    for (const int dimension : {1, 2}) {
      for (const GmshEntity& entity : entities_) {
        if (entity.dimension == dimension) put("{} {} 1 {} 0\n", entity.tag, box_of(entity), entity.group);
      }
    }
    put("$EndEntities\n");
  }

  /// Writes all nodes as nodes of the first surface, to preserve their order.
  void write_nodes() {
    const std::size_t count = mesh_.vertex_count();
    put("$Nodes\n1 {0} 1 {0}\n2 1 0 {0}\n", count);
    for (std::size_t v = 0; v < count; ++v) put("{}\n", v + 1);
    for (std::size_t v = 0; v < count; ++v) {
      const auto p = mesh_.vertex(v);
      put("{} {} {}\n", p[0], p[1], p[2]);
    }
    put("$EndNodes\n");
  }

  void write_elements() {
    std::size_t count = 0;
    for (const GmshEntity& entity : entities_) count += entity.element_count();
    put("$Elements\n{} {} 1 {}\n", entities_.size(), count, count);
    std::size_t number = mesh_.triangle_count();  // lines are numbered after the triangles
    for (const GmshEntity& entity : entities_) {
      const bool is_curve = entity.dimension == 1;
      put("{} {} {} {}\n", entity.dimension, entity.tag, static_cast<int>(is_curve ? kGmshLine : kGmshTriangle),
          entity.element_count());
      for (std::size_t k = 1; k < entity.parts.size() && is_curve; ++k) {
        put("{} {} {}\n", ++number, entity.parts[k - 1] + std::size_t{1}, entity.parts[k] + std::size_t{1});
      }
      for (std::size_t k = 0; k < entity.parts.size() && !is_curve; ++k) {
        const std::uint32_t* corners = &mesh_.triangles[3 * std::size_t{entity.parts[k]}];
        put("{} {} {} {}\n", entity.parts[k] + std::size_t{1}, corners[0] + std::size_t{1}, corners[1] + std::size_t{1},
            corners[2] + std::size_t{1});
      }
    }
    put("$EndElements\n");
  }

  const Mesh& mesh_;
  std::vector<PhysicalGroup> groups_;
  std::vector<GmshEntity> entities_;
  std::vector<std::uint8_t> bytes_;
};

/// Functions return a complaint, or an empty string.
class GmshReader {
 public:
  explicit GmshReader(std::span<const std::uint8_t> bytes) : cursor_(bytes) {}

  Mesh mesh;

  std::string read() {
    while (!cursor_.at_end()) {
      const std::string_view section = cursor_.word();
      cursor_.rest_of_line();
      if (section.empty()) continue;
      std::string complaint =
          section[0] == '$' ? read_section(std::string(section.substr(1))) : "a section begins with a '$'";
      if (!complaint.empty()) return fmt::format("line {}: {}", cursor_.line(), complaint);
    }
    if (!has_nodes_ || !has_elements_) return "it ends before its nodes and elements do: it was cut off";
    if (mesh.vertex_count() > std::numeric_limits<std::uint32_t>::max()) return "it has more nodes than 32 bits number";
    if (const auto twice = nodes_.finish(0)) return fmt::format("two of its nodes have the number {}", *twice);
    mesh.triangles.reserve(corners_.size());
    for (const std::int64_t corner : corners_) {
      const auto vertex = nodes_.find(corner);
      if (!vertex) return fmt::format("an element names node {}, and there is none", corner);
      mesh.triangles.push_back(*vertex);
    }
    if (comments_.origin) set_origin(mesh, *comments_.origin);
    return {};
  }

 private:
  bool integer(std::int64_t& value) { return parse_integer(cursor_.word_anywhere(), value); }
  bool count(std::int64_t& value) { return integer(value) && value >= 0; }

  std::string read_section(const std::string& name) {
    std::string complaint;
    if (name == "MeshFormat") {
      complaint = read_format();
    } else if (name == "Nodes" && !has_nodes_) {
      complaint = version_ == 4 ? read_node_blocks() : read_node_list();
      has_nodes_ = true;
    } else if (name == "Elements" && !has_elements_) {
      complaint = version_ == 4 ? read_element_blocks() : read_element_list();
      has_elements_ = true;
    } else if (name == "Nodes" || name == "Elements") {
      complaint = fmt::format("${} is there twice", name);
    } else {
      return skip_section(name);
    }
    if (!complaint.empty()) return complaint;
    return cursor_.word_anywhere() == "$End" + name ? "" : fmt::format("$End{} is missing", name);
  }

  /// Skips a section without mesh data, or reads its metadata.
  std::string skip_section(const std::string& name) {
    while (!cursor_.at_end()) {
      std::string_view line = cursor_.rest_of_line();
      if (line == "$End" + name) return {};
      if (name == "Comments" && line.starts_with('#')) comments_.read(line.substr(1), mesh.metadata);
    }
    return fmt::format("$End{} is missing: it was cut off", name);
  }

  std::string read_format() {
    const std::string version(cursor_.word_anywhere());
    const std::string_view type = cursor_.word_anywhere();
    cursor_.rest_of_line();
    if (type != "0") return "it is binary: save it as text (gmsh FILE -save -format msh41 -o NEW.msh)";
    version_ = version.starts_with("2") ? 2 : version == "4.1" ? 4 : 0;
    return version_ != 0
               ? ""
               : fmt::format("version {} is not read: save it as 4.1 (gmsh FILE -save -format msh41 -o NEW.msh)",
                             in_quotes(version));
  }

  std::string read_place(std::int64_t more) {
    for (std::int64_t k = 0; k < 3 + more; ++k) {
      double value = 0;
      if (!parse_number(cursor_.word_anywhere(), value) || !std::isfinite(value))
        return "a node needs three finite coordinates";
      if (k < 3) mesh.positions.push_back(value);
    }
    return {};
  }

  std::string read_node_list() {
    std::int64_t nodes = 0, number = 0;
    if (!count(nodes)) return "$Nodes needs their number";
    for (std::int64_t k = 0; k < nodes; ++k) {
      if (!integer(number)) return "a node needs a whole number as its name";
      nodes_.add(number);
      if (std::string complaint = read_place(0); !complaint.empty()) return complaint;
    }
    return {};
  }

  std::string read_node_blocks() {
    std::int64_t blocks = 0, announced = 0, lowest = 0, highest = 0;
    if (!count(blocks) || !count(announced) || !integer(lowest) || !integer(highest))
      return "$Nodes needs four whole numbers";
    std::int64_t read = 0;
    for (std::int64_t block = 0; block < blocks; ++block) {
      std::int64_t dimension = 0, entity = 0, is_parametric = 0, nodes = 0, number = 0;
      if (!count(dimension) || dimension > 3 || !integer(entity) || !count(is_parametric) || !count(nodes))
        return "a block of nodes needs four whole numbers";
      for (std::int64_t k = 0; k < nodes; ++k) {
        if (!integer(number)) return "a node needs a whole number as its name";
        nodes_.add(number);
      }
      for (std::int64_t k = 0; k < nodes; ++k) {
        if (std::string complaint = read_place(is_parametric != 0 ? dimension : 0); !complaint.empty())
          return complaint;
      }
      read += nodes;
    }
    return read == announced ? "" : fmt::format("it announces {} nodes and has {}", announced, read);
  }

  /// Reads the nodes of an element; stores triangles and quadrangles.
  std::string read_corners(std::int64_t type) {
    std::int64_t ids[4] = {};
    const int size = corners_of_gmsh(type);
    if (size == 0)
      return fmt::format("an element of type {} is no triangle, quadrangle, line or point with straight edges", type);
    for (int k = 0; k < size; ++k) {
      if (!integer(ids[k])) return fmt::format("an element of type {} needs {} nodes", type, size);
    }
    for (int k = 2; k < size; ++k) corners_.insert(corners_.end(), {ids[0], ids[k - 1], ids[k]});
    return {};
  }

  std::string read_element_list() {
    std::int64_t elements = 0;
    if (!count(elements)) return "$Elements needs their number";
    for (std::int64_t k = 0; k < elements; ++k) {
      std::int64_t number = 0, type = 0, tags = 0, tag = 0;
      bool good = integer(number) && integer(type) && count(tags);
      for (std::int64_t t = 0; t < tags && good; ++t) good = integer(tag);
      if (!good) return "an element needs its number, its type and its tags";
      if (std::string complaint = read_corners(type); !complaint.empty()) return complaint;
    }
    return {};
  }

  std::string read_element_blocks() {
    std::int64_t blocks = 0, announced = 0, lowest = 0, highest = 0, read = 0;
    if (!count(blocks) || !count(announced) || !integer(lowest) || !integer(highest))
      return "$Elements needs four whole numbers";
    for (std::int64_t block = 0; block < blocks; ++block) {
      std::int64_t dimension = 0, entity = 0, type = 0, elements = 0, number = 0;
      if (!count(dimension) || !integer(entity) || !integer(type) || !count(elements))
        return "a block of elements needs four whole numbers";
      for (std::int64_t k = 0; k < elements; ++k) {
        if (!integer(number)) return "an element needs a whole number as its name";
        if (std::string complaint = read_corners(type); !complaint.empty()) return complaint;
      }
      read += elements;
    }
    return read == announced ? "" : fmt::format("it announces {} elements and has {}", announced, read);
  }

  TextCursor cursor_;
  IdTable nodes_;
  std::vector<std::int64_t> corners_;  // node numbers, three per triangle
  TextComments comments_;
  int version_ = 0;
  bool has_nodes_ = false, has_elements_ = false;
};

}  // namespace

Result<std::vector<std::uint8_t>> encode_msh(const Mesh& mesh, const EncodeOptions& options) {
  const MeshZones none;
  return GmshWriter(mesh, options.zones != nullptr ? *options.zones : none).write();
}

Result<Mesh> decode_msh(std::span<const std::uint8_t> bytes) {
  GmshReader reader(bytes);
  if (std::string why = reader.read(); !why.empty()) return fail(ErrorKind::kInput, std::move(why));
  return std::move(reader.mesh);
}

}  // namespace scarp::io
