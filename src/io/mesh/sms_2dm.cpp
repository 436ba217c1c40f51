// 2DM, the mesh format of SMS and of hydraulic models: text, one card per line. "E3T" is a triangle of numbered nodes
// and its material, "ND" a node, "NS" a string of nodes. Triangles come first, as in files of SMS, so the reader
// resolves their corners at the end.
//
// The format has neither metadata nor an end mark. Lines that begin with '#', which its readers skip, store both. If
// the file announces its counts, the reader requires them and the mark.

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <limits>

#include "io/mesh/id_table.h"
#include "io/mesh/mesh_file.h"
#include "io/mesh/mesh_file_text.h"
#include "io/mesh/text_comments.h"
#include "scarp/io.h"

namespace scarp::io {
namespace {

struct Sms2dmReader {
  explicit Sms2dmReader(std::span<const std::uint8_t> bytes) : cursor(bytes) {}

  TextCursor cursor;
  Mesh mesh;
  IdTable nodes;
  std::vector<std::int64_t> corners;  // node numbers, three per triangle
  TextComments comments;

  /// Returns a complaint, or an empty string.
  std::string read_node() {
    std::int64_t number = 0;
    if (!parse_integer(cursor.word(), number)) return "a node needs a whole number as its name";
    nodes.add(number);
    for (int k = 0; k < 3; ++k) {
      double value = 0;
      if (!cursor.number(value) || !std::isfinite(value)) return "a node needs three finite coordinates";
      mesh.positions.push_back(value);
    }
    return {};
  }

  std::string read_element(int count) {
    std::int64_t number = 0, ids[4] = {};
    bool good = parse_integer(cursor.word(), number);
    for (int k = 0; k < count && good; ++k) good = parse_integer(cursor.word(), ids[k]);
    if (!good) return fmt::format("an element needs its number and those of its {} nodes", count);
    for (int k = 2; k < count; ++k) corners.insert(corners.end(), {ids[0], ids[k - 1], ids[k]});
    return {};
  }

  std::string read_line() {
    const std::string_view word = cursor.word();
    std::string complaint;
    if (word == "ND") {
      complaint = read_node();
    } else if (word == "E3T") {
      complaint = read_element(3);
    } else if (word == "E4Q") {
      complaint = read_element(4);
    } else if (word == "E6T" || word == "E8Q" || word == "E9Q") {
      complaint = fmt::format("{} is an element with curved edges, which no triangle is", word);
    } else if (word == "#") {
      comments.read(cursor.rest_of_line(), mesh.metadata);
      return {};
    }
    if (complaint.empty()) cursor.rest_of_line();
    return complaint;
  }

  std::string read() {
    while (!cursor.at_end()) {
      const std::size_t line = cursor.line();
      if (std::string complaint = read_line(); !complaint.empty()) return fmt::format("line {}: {}", line, complaint);
    }
    if (comments.vertices >= 0 &&
        (!comments.has_ended || comments.vertices != static_cast<std::int64_t>(mesh.vertex_count()) ||
         comments.triangles != static_cast<std::int64_t>(corners.size() / 3))) {
      return fmt::format("it announces {} nodes and {} triangles and ends with {} and {}: it was cut off",
                         comments.vertices, comments.triangles, mesh.vertex_count(), corners.size() / 3);
    }
    if (mesh.vertex_count() > std::numeric_limits<std::uint32_t>::max()) return "it has more nodes than 32 bits number";
    if (const auto twice = nodes.finish(0)) return fmt::format("two of its nodes have the number {}", *twice);
    mesh.triangles.reserve(corners.size());
    for (const std::int64_t corner : corners) {
      const auto vertex = nodes.find(corner);
      if (!vertex) return fmt::format("an element names node {}, and there is none", corner);
      mesh.triangles.push_back(*vertex);
    }
    if (comments.origin) set_origin(mesh, *comments.origin);
    return {};
  }
};

}  // namespace

Result<std::vector<std::uint8_t>> encode_2dm(const Mesh& mesh, const EncodeOptions& options) {
  const MeshZones none;
  const MeshZones& zones = options.zones != nullptr ? *options.zones : none;
  std::vector<std::uint8_t> bytes;
  bytes.reserve(mesh.positions.size() * 16 + mesh.triangles.size() * 11);
  auto out = std::back_inserter(bytes);
  fmt::format_to(out, "MESH2D\nMESHNAME \"terrain\"\nNUM_MATERIALS_PER_ELEM 1\n");
  fmt::format_to(out, "# Terrain by Scarp: x east, y north, z up; elements counter-clockwise from above\n");
  TextComments::write(mesh, bytes);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const std::uint32_t* corners = &mesh.triangles[3 * t];
    fmt::format_to(out, "E3T {} {} {} {} {}\n", t + 1, corners[0] + 1, corners[1] + 1, corners[2] + 1,
                   zones.materials.empty() ? 1 : zones.materials[t]);
  }
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const auto p = mesh.vertex(v);
    fmt::format_to(out, "ND {} {} {} {}\n", v + 1, p[0], p[1], p[2]);
  }
  for (std::size_t s = 0; s < zones.node_strings.size(); ++s) {
    const std::vector<std::uint32_t>& nodes = zones.node_strings[s].nodes;
    constexpr std::size_t kNodesPerCard = 10;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      if (k % kNodesPerCard == 0) fmt::format_to(out, "NS");
      const bool is_last = k + 1 == nodes.size();
      fmt::format_to(out, " {}{}", is_last ? "-" : "", nodes[k] + 1);
      if (is_last) fmt::format_to(out, " {}", s + 1);
      if (is_last || (k + 1) % kNodesPerCard == 0) fmt::format_to(out, "\n");
    }
  }
  TextComments::write_end(bytes);
  return bytes;
}

Result<Mesh> decode_2dm(std::span<const std::uint8_t> bytes) {
  Sms2dmReader reader(bytes);
  if (std::string why = reader.read(); !why.empty()) return fail(ErrorKind::kInput, std::move(why));
  return std::move(reader.mesh);
}

}  // namespace scarp::io
