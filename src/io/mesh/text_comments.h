// Comments of text formats that have no other place for counts, origin and metadata. They end with a mark, since
// truncated text may still be valid.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/mesh/mesh_file_text.h"
#include "scarp/mesh.h"

namespace scarp::io {

struct TextComments {
  std::optional<std::array<double, 3>> origin;
  std::int64_t vertices = -1, triangles = -1;  ///< announced numbers; −1: not announced
  bool has_ended = false;

  static constexpr std::string_view kCounts = "scarp.counts: ", kOrigin = "scarp.origin: ", kEnd = "scarp.end",
                                    kKey = "scarp ";

  /// Parses the text after a "#".
  void read(std::string_view text, std::map<std::string, std::string>& metadata) {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    if (text.starts_with(kCounts)) {
      const std::string_view counts = text.substr(kCounts.size());
      TextCursor words({reinterpret_cast<const std::uint8_t*>(counts.data()), counts.size()});
      std::int64_t first = 0, second = 0;
      if (!parse_integer(words.word(), first) || !parse_integer(words.word(), second)) return;
      vertices = first;
      triangles = second;
    } else if (text.starts_with(kOrigin)) {
      origin = parse_origin(text.substr(kOrigin.size()));
    } else if (text == kEnd) {
      has_ended = true;
    } else if (text.starts_with(kKey)) {
      parse_metadata_line(text.substr(kKey.size()), metadata);
    }
  }

  /// Writes everything except the end mark, at the top of a file.
  static void write(const Mesh& mesh, std::vector<std::uint8_t>& bytes) {
    auto out = std::back_inserter(bytes);
    fmt::format_to(out, "# {}{} {}\n", kCounts, mesh.vertex_count(), mesh.triangle_count());
    if (mesh.origin != std::array<double, 3>{}) fmt::format_to(out, "# {}{}\n", kOrigin, origin_text(mesh.origin));
    for (const auto& [key, value] : mesh.metadata) fmt::format_to(out, "# {}{}\n", kKey, metadata_line(key, value));
  }
  static void write_end(std::vector<std::uint8_t>& bytes) { fmt::format_to(std::back_inserter(bytes), "# {}\n", kEnd); }
};

}  // namespace scarp::io
