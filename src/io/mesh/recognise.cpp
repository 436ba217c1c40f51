// The format of a mesh file, by its content.
#include <algorithm>

#include "io/mesh/formats.h"
#include "io/mesh/mesh_file.h"
#include "io/mesh/mesh_file_text.h"
#include "io/mesh/xml_reader.h"

namespace scarp::io {
namespace {

bool looks_like_text(std::span<const std::uint8_t> bytes) {
  const auto head = bytes.first(std::min<std::size_t>(bytes.size(), 4096));
  return std::none_of(head.begin(), head.end(), [](std::uint8_t byte) { return byte < 32 && (byte < 9 || byte > 13); });
}

/// "<" and the name of the root element; empty if the bytes are not XML.
std::string root_of_xml(std::span<const std::uint8_t> bytes) {
  const bool may_be = begins_with(bytes, "<") || begins_with(bytes, "\xEF\xBB\xBF<");
  if (!may_be) return {};
  XmlReader xml(bytes);
  XmlReader::Event event = xml.next();
  while (event == XmlReader::Event::kComment) event = xml.next();
  return event == XmlReader::Event::kStart ? "<" + std::string(xml.name()) : std::string();
}

std::optional<MeshFormat> find_mark(std::span<const std::uint8_t> bytes) {
  const std::string root = root_of_xml(bytes);
  for (const MeshFormatRow& row : mesh_format_rows()) {
    if (row.mark.empty()) continue;
    if (row.mark.starts_with('<') ? row.mark == root : begins_with(bytes, row.mark)) return row.traits.format;
  }
  return {};
}

/// Recognises a text format by the first word of a line.
std::optional<MeshFormat> recognise_lines(std::span<const std::uint8_t> bytes) {
  TextCursor cursor(bytes);
  for (int line = 0; line < 10000 && !cursor.at_end(); ++line) {
    const std::string_view word = cursor.word();
    if (word == "t") return MeshFormat::kTin;
    for (const std::string_view of_obj : {"v", "f", "vn", "vt", "mtllib", "o", "g"}) {
      if (word == of_obj) return MeshFormat::kObj;
    }
    cursor.rest_of_line();
  }
  return {};
}

}  // namespace

std::optional<MeshFormat> recognise_mesh(std::span<const std::uint8_t> bytes, const std::string& name) {
  if (const auto marked = find_mark(bytes)) return marked;
  if (begins_with(bytes, "ply\n") || begins_with(bytes, "ply\r")) return MeshFormat::kPly;
  if (begins_with(bytes, "SQLite format 3")) return MeshFormat::kGpkg;
  if (begins_with(bytes, "PK\3\4")) return MeshFormat::k3mf;
  if (is_binary_stl(bytes)) return MeshFormat::kStl;
  if (!looks_like_text(bytes)) {
    const auto named = find_mesh_format(name);
    return named == MeshFormat::kStl ? named : std::nullopt;
  }
  if (begins_with(bytes, "solid")) return MeshFormat::kStl;
  if (is_dxf(bytes)) return MeshFormat::kDxf;
  return recognise_lines(bytes);
}

}  // namespace scarp::io
