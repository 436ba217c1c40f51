// TIN, the format of Scape and Terra: a line "t" and nine numbers for each triangle, nothing else. It has no origin,
// metadata or end mark, so a file truncated between two lines is a valid, smaller mesh.

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "io/mesh/mesh_file.h"
#include "io/mesh/mesh_file_text.h"
#include "io/mesh/welder.h"

namespace scarp::io {

Result<std::vector<std::uint8_t>> encode_tin(const Mesh& mesh) {
  std::vector<std::uint8_t> bytes;
  auto out = std::back_inserter(bytes);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto p = mesh.vertex(mesh.triangles[i]);
    fmt::format_to(out, "{}{} {} {}{}", i % 3 == 0 ? "t " : " ", p[0], p[1], p[2], i % 3 == 2 ? "\n" : "");
  }
  return bytes;
}

Result<Mesh> decode_tin(std::span<const std::uint8_t> bytes) {
  Mesh mesh;
  std::vector<double> corners;
  TextCursor cursor(bytes);
  while (!cursor.at_end()) {
    const std::size_t line = cursor.line();
    const std::string_view word = cursor.word();
    if (word == "t") {
      for (int k = 0; k < 9; ++k) {
        double value = 0;
        if (!cursor.number(value) || !std::isfinite(value)) {
          return fail(ErrorKind::kInput, fmt::format("line {}: a triangle needs nine finite numbers", line));
        }
        corners.push_back(value);
      }
    }
    const bool is_odd = !word.empty() && word != "t" && !word.starts_with('#');
    if (is_odd || (word == "t" && !cursor.word().empty())) {
      return fail(ErrorKind::kInput, fmt::format("line {}: not 't' and nine numbers, as a TIN's lines are", line));
    }
    cursor.rest_of_line();
  }
  Welder welder(mesh.positions, corners.size() / 3);
  mesh.triangles.reserve(corners.size() / 3);
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    mesh.triangles.push_back(welder.find_or_add(corners[i], corners[i + 1], corners[i + 2]));
  }
  return mesh;
}

}  // namespace scarp::io
