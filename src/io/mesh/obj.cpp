// OBJ: text. Positions are absolute. Each number is the shortest text that parses to the same double.
//
// Truncated text may still be valid. So the file announces its counts at the top and ends with a mark. If counts are
// announced, the reader requires them and the mark.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "io/mesh/mesh_file.h"
#include "io/mesh/mesh_file_text.h"
#include "io/mesh/text_comments.h"

namespace scarp::io {
namespace {

struct ObjReader {
  explicit ObjReader(std::span<const std::uint8_t> bytes) : cursor(bytes) {}

  TextCursor cursor;
  Mesh mesh;
  std::vector<float> normals, uvs;     // in file order
  bool normals_match = true;           // every corner's normal has its vertex's index
  bool uvs_match = true;               // likewise texture coordinates
  std::vector<double> colors;          // colours of the vertices that have them
  std::vector<std::uint32_t> corners;  // corners of the current face
  TextComments comments;

  /// Reads "7", "7/1", "7//3" or "7/1/3". Indices are 1-based; negative ones count back from the newest.
  bool read_corner(std::string_view word) {
    const std::size_t slash = word.find('/');
    std::int64_t number = 0, normal = 0;
    if (!parse_integer(word.substr(0, slash), number)) return false;
    const auto count = static_cast<std::int64_t>(mesh.vertex_count());
    if (number < 0) number += count + 1;
    if (number < 1 || number > 0xFFFFFFFF) return false;
    const std::size_t second = slash == std::string_view::npos ? slash : word.find('/', slash + 1);
    std::int64_t uv = 0;
    if (slash == std::string_view::npos || !parse_integer(word.substr(slash + 1, second - slash - 1), uv)) {
      uvs_match = false;
    } else {
      if (uv < 0) uv += static_cast<std::int64_t>(uvs.size() / 2) + 1;
      uvs_match = uvs_match && uv == number;
    }
    if (second == std::string_view::npos || !parse_integer(word.substr(second + 1), normal)) {
      normals_match = false;
    } else {
      if (normal < 0) normal += static_cast<std::int64_t>(normals.size() / 3) + 1;
      normals_match = normals_match && normal == number;
    }
    corners.push_back(static_cast<std::uint32_t>(number - 1));
    return true;
  }

  static bool is_float(double value) { return std::fabs(value) <= std::numeric_limits<float>::max(); }

  /// Reads the values after a vertex: nothing, its weight, or red, green and blue.
  void read_color() {
    double rgb[3];
    for (double& part : rgb) {
      if (!cursor.number(part) || !(part >= 0 && part <= 255)) return;
    }
    colors.insert(colors.end(), rgb, rgb + 3);
  }

  /// Colours are 0 … 1, or bytes if a value in the file is larger.
  void take_colors() {
    if (colors.size() != mesh.positions.size()) return;
    const bool bytes = std::any_of(colors.begin(), colors.end(), [](double part) { return part > 1; });
    for (const double part : colors)
      mesh.colors.push_back(static_cast<std::uint8_t>((bytes ? part : part * 255) + 0.5));
  }

  /// Returns a complaint about this line, or an empty string.
  std::string read_line() {
    const std::string_view word = cursor.word();
    if (word == "v") {
      for (int k = 0; k < 3; ++k) {
        double value = 0;
        if (!cursor.number(value) || !std::isfinite(value)) return "a vertex needs three finite numbers";
        mesh.positions.push_back(value);
      }
      read_color();
    } else if (word == "vt") {
      double u = 0, v = 0;
      if (!cursor.number(u) || !is_float(u)) return "a place in an image needs finite numbers";
      if (const std::string_view second = cursor.word();
          !second.empty() && (!parse_number(second, v) || !is_float(v))) {
        return "a place in an image needs finite numbers";
      }
      uvs.push_back(static_cast<float>(u));
      uvs.push_back(static_cast<float>(1 - v));  // OBJ's images start at the bottom
    } else if (word == "vn") {
      for (int k = 0; k < 3; ++k) {
        double value = 0;
        if (!cursor.number(value) || !is_float(value)) {
          return "a normal needs three finite numbers";
        }
        normals.push_back(static_cast<float>(value));
      }
    } else if (word == "f") {
      corners.clear();
      for (std::string_view corner = cursor.word(); !corner.empty(); corner = cursor.word()) {
        if (!read_corner(corner)) return fmt::format("a face has the corner '{}'", corner.substr(0, 40));
      }
      if (corners.size() < 3) return "a face needs at least three corners";
      if (auto wrong = append_fan(corners, mesh.triangles); !wrong.empty()) return wrong;
    } else if (word == "#") {
      comments.read(cursor.rest_of_line(), mesh.metadata);
      return {};
    }
    cursor.rest_of_line();
    return {};
  }

  std::string read() {
    while (!cursor.at_end()) {
      const std::size_t line = cursor.line();
      if (std::string complaint = read_line(); !complaint.empty()) return fmt::format("line {}: {}", line, complaint);
    }
    const auto vertices = static_cast<std::int64_t>(mesh.vertex_count());
    const auto triangles = static_cast<std::int64_t>(mesh.triangle_count());
    if (comments.vertices >= 0 && !comments.has_ended) {
      return fmt::format(
          "it announces {} vertices and {} triangles and ends without an end mark after {} and {}: it was "
          "cut off",
          comments.vertices, comments.triangles, vertices, triangles);
    }
    if (normals_match && normals.size() == mesh.positions.size()) mesh.normals = std::move(normals);
    if (uvs_match && uvs.size() == 2 * mesh.vertex_count()) mesh.uvs = std::move(uvs);
    take_colors();
    // Only valid positions can be moved; the caller repeats this check for every format.
    if (comments.origin && find_unreadable(mesh).empty()) set_origin(mesh, *comments.origin);
    return {};
  }
};

}  // namespace

Result<std::vector<std::uint8_t>> encode_obj(const Mesh& mesh) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(mesh.positions.size() * 14 + mesh.normals.size() * 12 + mesh.triangles.size() * 8);
  auto out = std::back_inserter(bytes);
  fmt::format_to(out, "# Terrain by Scarp. Right-handed, {}; faces counter-clockwise from above.\n", axes_text(mesh));
  TextComments::write(mesh, bytes);
  fmt::format_to(out, "o terrain\n");
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const auto p = mesh.vertex(v);
    fmt::format_to(out, "v {} {} {}", p[0], p[1], p[2]);
    for (std::size_t k = 0; k < 3 && !mesh.colors.empty(); ++k) {
      fmt::format_to(out, " {}", static_cast<float>(mesh.colors[3 * v + k]) / 255);
    }
    bytes.push_back('\n');
  }
  for (std::size_t i = 0; i < mesh.uvs.size(); i += 2) {
    fmt::format_to(out, "vt {} {}\n", mesh.uvs[i], 1 - double{mesh.uvs[i + 1]});
  }
  for (std::size_t i = 0; i < mesh.normals.size(); i += 3) {
    fmt::format_to(out, "vn {} {} {}\n", mesh.normals[i], mesh.normals[i + 1], mesh.normals[i + 2]);
  }
  const bool with_uvs = !mesh.uvs.empty(), with_normals = !mesh.normals.empty();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::uint64_t number = std::uint64_t{mesh.triangles[i]} + 1;
    fmt::format_to(out, "{}{}", i % 3 == 0 ? "f " : " ", number);
    if (with_uvs) fmt::format_to(out, "/{}", number);
    if (with_normals) fmt::format_to(out, "{}{}", with_uvs ? "/" : "//", number);
    if (i % 3 == 2) bytes.push_back('\n');
  }
  TextComments::write_end(bytes);
  return bytes;
}

Result<Mesh> decode_obj(std::span<const std::uint8_t> bytes) {
  ObjReader reader(bytes);
  if (std::string why = reader.read(); !why.empty()) return fail(ErrorKind::kInput, std::move(why));
  return std::move(reader.mesh);
}

}  // namespace scarp::io
