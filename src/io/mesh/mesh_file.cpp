#include "io/mesh/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/caught.h"
#include "io/lent.h"
#include "io/mesh/mesh_file_text.h"
#include "io/mesh/xml_reader.h"
#include "scarp/height_field.h"
#include "scarp/io.h"

namespace scarp {
namespace {

constexpr char kHexDigits[] = "0123456789ABCDEF";

std::string escape(const std::string& text, bool key, bool ascii) {
  std::string line;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 32 || c == '%' || c == '\\' || (key && c == ':') || (ascii && byte > 126)) {
      line += {'%', kHexDigits[byte >> 4], kHexDigits[byte & 15]};
    } else {
      line += c;
    }
  }
  return line;
}

int hex_value(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::string unescape(std::string_view line) {
  std::string text;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '%' && i + 2 < line.size() && hex_value(line[i + 1]) >= 0 && hex_value(line[i + 2]) >= 0) {
      text += static_cast<char>(hex_value(line[i + 1]) * 16 + hex_value(line[i + 2]));
      i += 2;
    } else {
      text += line[i];
    }
  }
  return text;
}

bool starts_with(std::span<const std::uint8_t> bytes, std::string_view text) {
  if (bytes.size() < text.size()) return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (static_cast<char>(bytes[i]) != text[i]) return false;
  }
  return true;
}

bool looks_like_text(std::span<const std::uint8_t> bytes) {
  for (const std::uint8_t byte : bytes.first(std::min<std::size_t>(bytes.size(), 4096))) {
    if (byte < 32 && !(byte >= 9 && byte <= 13)) return false;
  }
  return true;
}

std::string lower_extension(const std::string& name_or_path) {
  const std::size_t start = name_or_path.find_last_of("./");
  if (start == std::string::npos) return lowered(name_or_path);
  return name_or_path[start] == '.' ? lowered(name_or_path.substr(start + 1)) : "";
}

/// The facts about a format. Readers that serve two formats stand in both rows.
struct FormatRow {
  MeshFormat format;
  std::string_view extension;
  Result<std::vector<std::uint8_t>> (*encode)(const Mesh&);
  Result<Mesh> (*decode)(std::span<const std::uint8_t>);  ///< null where files are written only
  bool as_float;                                          ///< positions are rounded to float32
};
constexpr FormatRow kFormats[] = {{MeshFormat::kGlb, "glb", encode_glb, decode_glb, true},
                                  {MeshFormat::kObj, "obj", encode_obj, decode_obj, false},
                                  {MeshFormat::kPly, "ply", nullptr, decode_ply, false},
                                  {MeshFormat::kStl, "stl", encode_stl, decode_stl, true},
                                  {MeshFormat::kTin, "tin", encode_tin, decode_tin, false},
                                  {MeshFormat::k2dm, "2dm", encode_2dm, decode_2dm, false},
                                  {MeshFormat::kVtu, "vtu", encode_vtu, decode_vtk, false},
                                  {MeshFormat::kVtp, "vtp", encode_vtp, decode_vtk, false},
                                  {MeshFormat::kLandXml, "landxml", encode_landxml, decode_landxml, false},
                                  {MeshFormat::kDxf, "dxf", encode_dxf, decode_dxf, false},
                                  {MeshFormat::kGpkg, "gpkg", encode_gpkg, nullptr, false},
                                  {MeshFormat::k3mf, "3mf", encode_one_3mf, decode_3mf, true}};

/// Neither fixed by a standard nor by all who use it.
bool has_up_axis(MeshFormat format) {
  return format == MeshFormat::kObj || format == MeshFormat::kPly || format == MeshFormat::kStl;
}

/// The up axis of a mesh as its reader returned it. Scarp's own files declare what is y up, and do not declare what is
/// z up.
char find_up(MeshFormat format, std::span<const std::uint8_t> bytes, const Mesh& mesh) {
  if (format == MeshFormat::kGlb) return 'y';
  if (!has_up_axis(format)) return 'z';
  if (mesh.metadata.contains("up")) return is_y_up(mesh) ? 'y' : 'z';
  const auto generator = mesh.metadata.find("generator");
  const bool is_own = generator != mesh.metadata.end() && generator->second.starts_with("Scarp");
  return is_own || (format == MeshFormat::kStl && starts_with(bytes, "scarp ")) ? 'z' : '\0';
}

const FormatRow* find_row(MeshFormat format) {
  for (const FormatRow& row : kFormats) {
    if (row.format == format) return &row;
  }
  return nullptr;
}

/// By the root element; nothing if the bytes are no XML, or another's.
std::optional<MeshFormat> recognise_xml(std::span<const std::uint8_t> bytes) {
  const bool may_be = starts_with(bytes, "<") || starts_with(bytes, "\xEF\xBB\xBF<");
  if (!may_be) return {};
  XmlReader xml(bytes);
  for (;;) {
    const XmlReader::Event event = xml.next();
    if (event == XmlReader::Event::kComment) continue;
    if (event != XmlReader::Event::kStart) return {};
    if (xml.name() == "VTKFile") return MeshFormat::kVtu;
    return xml.name() == "LandXML" ? std::optional(MeshFormat::kLandXml) : std::nullopt;
  }
}

/// By content; the name decides only where bytes alone do not, as in an STL file that was cut off.
std::optional<MeshFormat> recognise(std::span<const std::uint8_t> bytes, const std::string& name) {
  if (starts_with(bytes, "glTF")) return MeshFormat::kGlb;
  if (starts_with(bytes, "ply\n") || starts_with(bytes, "ply\r")) return MeshFormat::kPly;
  if (starts_with(bytes, "SQLite format 3")) return MeshFormat::kGpkg;
  if (starts_with(bytes, "PK\3\4")) return MeshFormat::k3mf;
  if (const auto xml = recognise_xml(bytes)) return xml;
  if (is_binary_stl(bytes)) return MeshFormat::kStl;
  if (!looks_like_text(bytes)) {
    const auto named = find_mesh_format(name);
    return named == MeshFormat::kStl ? named : std::nullopt;
  }
  if (starts_with(bytes, "solid")) return MeshFormat::kStl;
  if (starts_with(bytes, "MESH2D")) return MeshFormat::k2dm;
  if (is_dxf(bytes)) return MeshFormat::kDxf;
  TextCursor cursor(bytes);
  for (int line = 0; line < 10000 && !cursor.at_end(); ++line) {
    const std::string_view word = cursor.word();
    if (word == "t") return MeshFormat::kTin;
    if (word == "v" || word == "f" || word == "vn" || word == "vt" || word == "mtllib" || word == "o" || word == "g") {
      return MeshFormat::kObj;
    }
    cursor.rest_of_line();
  }
  return std::nullopt;
}

}  // namespace

std::string find_unwritable(const Mesh& mesh, bool as_float) {
  const std::size_t count = mesh.vertex_count();
  if (mesh.triangles.empty()) return "the mesh has no triangles";
  if (mesh.positions.size() % 3 != 0 || mesh.triangles.size() % 3 != 0 ||
      (!mesh.normals.empty() && mesh.normals.size() != mesh.positions.size()) ||
      (!mesh.uvs.empty() && mesh.uvs.size() != 2 * count) ||
      (!mesh.colors.empty() && mesh.colors.size() != 3 * count) || mesh.channel_count < 0 ||
      mesh.channels.size() != static_cast<std::size_t>(mesh.channel_count) * count) {
    return "the sizes of the mesh's arrays do not agree";
  }
  if (mesh.channel_count > kMaxChannels) {
    return fmt::format("the mesh has {} channels, and a mesh file holds at most {}", mesh.channel_count, kMaxChannels);
  }
  if (count > std::numeric_limits<std::uint32_t>::max()) return "the mesh has more vertices than 32 bits can number";
  // Without branches first, which compilers make vectors of.
  std::uint32_t largest = 0;
  for (const std::uint32_t v : mesh.triangles) largest = std::max(largest, v);
  for (std::size_t i = 0; largest >= count && i < mesh.triangles.size(); ++i) {
    if (mesh.triangles[i] >= count) {
      return fmt::format("triangle {} names vertex {}, and the mesh has {}", i / 3, mesh.triangles[i], count);
    }
  }
  const double limit =
      as_float ? static_cast<double>(std::numeric_limits<float>::max()) : std::numeric_limits<double>::max() / 4;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    if (!(std::fabs(mesh.positions[i]) <= limit)) {
      return fmt::format("vertex {} has the coordinate {}, which the format cannot hold", i / 3, mesh.positions[i]);
    }
  }
  for (std::size_t i = 0; i < mesh.uvs.size(); ++i) {
    if (!std::isfinite(mesh.uvs[i])) return fmt::format("the place in the image of vertex {} is not finite", i / 2);
  }
  for (const double coordinate : mesh.origin) {
    if (!(std::fabs(coordinate) <= std::numeric_limits<double>::max() / 4)) return "the mesh's origin is not finite";
  }
  return {};
}

void drop_partial_attributes(Mesh& mesh) {
  const std::size_t count = mesh.vertex_count();
  if (mesh.normals.size() != 3 * count) mesh.normals.clear();
  if (mesh.uvs.size() != 2 * count) mesh.uvs.clear();
  if (mesh.colors.size() != 3 * count) mesh.colors.clear();
  if (mesh.channel_count <= 0 || mesh.channels.size() != static_cast<std::size_t>(mesh.channel_count) * count) {
    mesh.channel_count = 0;
    mesh.channels.clear();
  }
}

std::string find_unreadable(const Mesh& mesh) {
  const std::size_t count = mesh.vertex_count();
  if (count > std::numeric_limits<std::uint32_t>::max()) return "it has more vertices than 32 bits can number";
  if (mesh.triangles.empty()) return "it holds no triangles";
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (mesh.triangles[i] >= count) {
      return fmt::format("triangle {} names vertex {}, but there are only {} (counting from 0)", i / 3,
                         mesh.triangles[i], count);
    }
  }
  for (std::size_t v = 0; v < count; ++v) {
    for (const double coordinate : mesh.vertex(v)) {
      if (!std::isfinite(coordinate)) return fmt::format("vertex {} is not a finite number (counting from 0)", v);
    }
  }
  return {};
}

std::string find_beyond_int32(const Mesh& mesh, const char* what) {
  constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max();
  const std::size_t count = std::max(mesh.vertex_count(), mesh.triangle_count());
  if (count <= kMost) return {};
  return fmt::format("{} numbers at most {} vertices and triangles, and these are {}; write PLY", what, kMost, count);
}

std::string metadata_line(const std::string& key, const std::string& value) {
  return escape(key, true, false) + ": " + escape(value, false, false);
}

std::string ascii_metadata_line(const std::string& key, const std::string& value) {
  return escape(key, true, true) + ": " + escape(value, false, true);
}

std::string ascii_text(const std::string& text) { return escape(text, false, true); }

std::string undo_ascii_text(std::string_view text) { return unescape(text); }

bool parse_metadata_line(std::string_view line, std::map<std::string, std::string>& metadata) {
  const std::size_t separator = line.find(": ");
  if (separator == std::string_view::npos || separator == 0) return false;
  metadata[unescape(line.substr(0, separator))] = unescape(line.substr(separator + 2));
  return true;
}

std::string origin_text(const std::array<double, 3>& origin) {
  return fmt::format("{} {} {}", origin[0], origin[1], origin[2]);
}

std::optional<std::array<double, 3>> parse_origin(std::string_view text) {
  TextCursor cursor({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  std::array<double, 3> origin{};
  for (double& coordinate : origin) {
    if (!cursor.number(coordinate) || !std::isfinite(coordinate)) return {};
  }
  return origin;
}

const char* axes_text(const Mesh& mesh) { return is_y_up(mesh) ? "x east, y up, z south" : "x east, y north, z up"; }

void set_origin(Mesh& mesh, const std::array<double, 3>& origin) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const double base = origin[i % 3], absolute = mesh.positions[i];
    if (base + (absolute - base) != absolute) return;
  }
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) mesh.positions[i] -= origin[i % 3];
  mesh.origin = origin;
}

std::string append_fan(std::span<const std::uint32_t> corners, std::vector<std::uint32_t>& triangles) {
  constexpr std::size_t kMostCorners = 16'384;
  if (corners.size() > kMostCorners)
    return fmt::format("a polygon has {} corners, more than {}: cut it into triangles first", corners.size(),
                       kMostCorners);
  for (std::size_t k = 2; k < corners.size(); ++k) {
    triangles.insert(triangles.end(), {corners[0], corners[k - 1], corners[k]});
  }
  return {};
}

std::optional<MeshFormat> find_mesh_format(const std::string& name_or_path) {
  const std::string extension = lower_extension(name_or_path);
  for (const FormatRow& row : kFormats) {
    if (extension == row.extension) return row.format;
  }
  if (extension == "xml") return MeshFormat::kLandXml;
  return {};
}

Result<std::vector<std::uint8_t>> encode_mesh(const Mesh& mesh, MeshFormat format, bool double_positions) {
  const FormatRow* row = find_row(format);
  if (row == nullptr) return fail(ErrorKind::kInternal, "encode_mesh() was given no format");
  if (is_y_up(mesh) && !has_up_axis(format)) {
    return fail(ErrorKind::kOutput, "the mesh is y up, which OBJ, PLY and STL may be; undo_y_up() turns it back");
  }
  if (std::string why = find_unwritable(mesh, row->as_float); !why.empty()) {
    return fail(ErrorKind::kOutput, std::move(why));
  }
  try {
    return format == MeshFormat::kPly ? encode_ply(mesh, double_positions) : row->encode(mesh);
  } catch (...) {
    return caught(ErrorKind::kOutput, "encode the mesh");
  }
}

Result<Mesh> decode_mesh(std::span<const std::uint8_t> bytes, const std::string& name_for_errors, MeshFileAxes* axes) {
  const auto unusable = [&](const std::string& why) {
    return fail(ErrorKind::kInput, fmt::format("{} is not a usable mesh: {}", name_for_errors, why));
  };
  if (bytes.empty()) return unusable("the file is empty");
  const auto format = recognise(bytes, name_for_errors);
  if (!format) {
    return unusable("it is neither GLB nor OBJ, PLY, STL, TIN, 2DM, VTU, VTP, LandXML, DXF or 3MF");
  }
  const FormatRow& row = *find_row(*format);
  if (row.decode == nullptr) return unusable("it is a GeoPackage, which Scarp writes and does not read");
  try {
    Result<Mesh> mesh = row.decode(bytes);
    if (!mesh) return unusable(mesh.error().message);
    drop_partial_attributes(*mesh);
    if (!has_up_axis(*format)) mesh->metadata.erase("up");
    if (axes != nullptr) *axes = {find_up(*format, bytes, *mesh), row.as_float};
    undo_y_up(*mesh);
    if (const std::string why = find_unreadable(*mesh); !why.empty()) return unusable(why);
    return mesh;
  } catch (...) {
    return caught(ErrorKind::kInput, "decode " + name_for_errors);
  }
}

Result<void> write_mesh(const Mesh& mesh, const std::string& path, std::optional<MeshFormat> format, bool overwrite) {
  if (!format) format = find_mesh_format(path);
  if (!format) {
    return fail(ErrorKind::kOutput,
                fmt::format("the name {} does not tell a mesh format: end it in .glb, .obj, .ply, "
                            ".stl, .tin, .2dm, .vtu, .vtp, .xml, .dxf, .gpkg or .3mf, or name the format",
                            path));
  }
  auto bytes = encode_mesh(mesh, *format);
  if (!bytes) return fail(bytes.error().kind, fmt::format("cannot write {}: {}", path, bytes.error().message));
  return write_file(path, *bytes, overwrite);
}

Result<Mesh> read_mesh(const std::string& path, MeshFileAxes* axes) {
  if (const Mesh* lent = find_lent_mesh(path)) return *lent;
  SCARP_TRY(auto&& bytes, read_file(path));
  return decode_mesh(bytes, path, axes);
}

}  // namespace scarp
