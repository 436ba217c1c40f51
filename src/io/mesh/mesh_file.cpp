#include "io/mesh/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/caught.h"
#include "io/lent.h"
#include "io/mesh/formats.h"
#include "io/mesh/mesh_file_text.h"
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

/// The up axis of a mesh as returned by its reader. Scarp's own files declare y up, but not z up.
char find_up(const MeshFormatTraits& traits, std::span<const std::uint8_t> bytes, const Mesh& mesh) {
  if (!traits.has_choice_of_up) return traits.up;
  if (mesh.metadata.contains("up")) return is_y_up(mesh) ? 'y' : 'z';
  const auto generator = mesh.metadata.find("generator");
  const bool is_own = generator != mesh.metadata.end() && generator->second.starts_with("Scarp");
  return is_own || (traits.format == MeshFormat::kStl && io::begins_with(bytes, "scarp ")) ? 'z' : '\0';
}

/// "GLB, OBJ or PLY" for readable formats, or ".glb, .obj or .ply" for all formats.
std::string list_formats(bool by_ending) {
  std::vector<std::string> words;
  for (const MeshFormatTraits* traits : mesh_formats()) {
    const std::string_view endings = traits->endings;
    if (by_ending) words.push_back("." + std::string(endings.substr(0, endings.find(' '))));
    if (!by_ending && traits->is_read) words.emplace_back(traits->title);
  }
  return fmt::format("{} or {}", fmt::join(words.begin(), words.end() - 1, ", "), words.back());
}

/// The reason why the format cannot store this many vertices and triangles; empty if it can.
std::string find_beyond_int32(const Mesh& mesh, const MeshFormatTraits& traits) {
  constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max();
  const std::size_t count = std::max(mesh.vertex_count(), mesh.triangle_count());
  if (!traits.counts_in_int32 || count <= kMost) return {};
  return fmt::format("a {} file numbers at most {} vertices and triangles, and these are {}; write PLY", traits.title,
                     kMost, count);
}

/// The fault of the zones; empty if there is none, or `zones` is null.
std::string find_unwritable_zones(const Mesh& mesh, const MeshZones* zones, const MeshFormatTraits& traits) {
  if (zones == nullptr) return {};
  if (!traits.holds_zones) return fmt::format("{} has no place for materials and node strings", traits.title);
  if (!zones->materials.empty() && zones->materials.size() != mesh.triangle_count())
    return fmt::format("there are {} materials for {} triangles", zones->materials.size(), mesh.triangle_count());
  for (const NodeString& string : zones->node_strings) {
    for (const std::uint32_t node : string.nodes) {
      if (node >= mesh.vertex_count())
        return fmt::format("the node string {} names vertex {}, and the mesh has {}", string.name, node,
                           mesh.vertex_count());
    }
  }
  return {};
}

}  // namespace

std::string io::find_unwritable(const Mesh& mesh, bool as_float) {
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
  // Branchless first pass, for vectorisation.
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

void io::drop_partial_attributes(Mesh& mesh) {
  const std::size_t count = mesh.vertex_count();
  if (mesh.normals.size() != 3 * count) mesh.normals.clear();
  if (mesh.uvs.size() != 2 * count) mesh.uvs.clear();
  if (mesh.colors.size() != 3 * count) mesh.colors.clear();
  if (mesh.channel_count <= 0 || mesh.channels.size() != static_cast<std::size_t>(mesh.channel_count) * count) {
    mesh.channel_count = 0;
    mesh.channels.clear();
  }
}

std::string io::find_unreadable(const Mesh& mesh) {
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

std::string io::metadata_line(const std::string& key, const std::string& value) {
  return escape(key, true, false) + ": " + escape(value, false, false);
}

std::string io::ascii_metadata_line(const std::string& key, const std::string& value) {
  return escape(key, true, true) + ": " + escape(value, false, true);
}

std::string io::ascii_text(const std::string& text) { return escape(text, false, true); }

std::string io::undo_ascii_text(std::string_view text) { return unescape(text); }

bool io::parse_metadata_line(std::string_view line, std::map<std::string, std::string>& metadata) {
  const std::size_t separator = line.find(": ");
  if (separator == std::string_view::npos || separator == 0) return false;
  metadata[unescape(line.substr(0, separator))] = unescape(line.substr(separator + 2));
  return true;
}

std::string io::origin_text(const std::array<double, 3>& origin) {
  return fmt::format("{} {} {}", origin[0], origin[1], origin[2]);
}

std::optional<std::array<double, 3>> io::parse_origin(std::string_view text) {
  TextCursor cursor({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  std::array<double, 3> origin{};
  for (double& coordinate : origin) {
    if (!cursor.number(coordinate) || !std::isfinite(coordinate)) return {};
  }
  return origin;
}

const char* io::axes_text(const Mesh& mesh) {
  return is_y_up(mesh) ? "x east, y up, z south" : "x east, y north, z up";
}

void io::set_origin(Mesh& mesh, const std::array<double, 3>& origin) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const double base = origin[i % 3], absolute = mesh.positions[i];
    if (base + (absolute - base) != absolute) return;
  }
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) mesh.positions[i] -= origin[i % 3];
  mesh.origin = origin;
}

std::string io::append_fan(std::span<const std::uint32_t> corners, std::vector<std::uint32_t>& triangles) {
  constexpr std::size_t kMostCorners = 16'384;
  if (corners.size() > kMostCorners)
    return fmt::format("a polygon has {} corners, more than {}: cut it into triangles first", corners.size(),
                       kMostCorners);
  for (std::size_t k = 2; k < corners.size(); ++k) {
    triangles.insert(triangles.end(), {corners[0], corners[k - 1], corners[k]});
  }
  return {};
}

Result<std::vector<std::uint8_t>> encode_mesh(const Mesh& mesh, MeshFormat format, const EncodeOptions& options) {
  const io::MeshFormatRow& row = io::row_of(format);
  if (is_y_up(mesh) && !row.traits.has_choice_of_up) {
    return fail(ErrorKind::kOutput, "the mesh is y up, which OBJ, PLY and STL may be; undo_y_up() turns it back");
  }
  if (std::string why = io::find_unwritable(mesh, row.traits.is_float32); !why.empty()) {
    return fail(ErrorKind::kOutput, std::move(why));
  }
  if (std::string why = find_unwritable_zones(mesh, options.zones, row.traits); !why.empty()) {
    return fail(ErrorKind::kUsage, std::move(why));
  }
  if (std::string why = find_beyond_int32(mesh, row.traits); !why.empty()) {
    return fail(ErrorKind::kOutput, std::move(why));
  }
  try {
    return row.write(mesh, options);
  } catch (...) {
    return caught(ErrorKind::kOutput, "encode the mesh");
  }
}

Result<Mesh> decode_mesh(std::span<const std::uint8_t> bytes, const std::string& name_for_errors, MeshFileAxes* axes) {
  const auto unusable = [&](const std::string& why) {
    return fail(ErrorKind::kInput, fmt::format("{} is not a usable mesh: {}", name_for_errors, why));
  };
  if (bytes.empty()) return unusable("the file is empty");
  const auto format = io::recognise_mesh(bytes, name_for_errors);
  if (!format) return unusable(fmt::format("it is none of {}", list_formats(false)));
  const io::MeshFormatRow& row = io::row_of(*format);
  if (row.read == nullptr)
    return unusable(fmt::format("it is a {}, which Scarp writes and does not read", row.traits.title));
  try {
    Result<Mesh> mesh = row.read(bytes);
    if (!mesh) return unusable(mesh.error().message);
    io::drop_partial_attributes(*mesh);
    if (!row.traits.has_choice_of_up) mesh->metadata.erase("up");
    if (axes != nullptr) *axes = {find_up(row.traits, bytes, *mesh), row.traits.is_float32};
    undo_y_up(*mesh);
    if (const std::string why = io::find_unreadable(*mesh); !why.empty()) return unusable(why);
    return mesh;
  } catch (...) {
    return caught(ErrorKind::kInput, "decode " + name_for_errors);
  }
}

Result<void> write_mesh(const Mesh& mesh, const std::string& path, std::optional<MeshFormat> format, bool overwrite) {
  if (!format) format = find_mesh_format(path);
  if (!format) {
    return fail(ErrorKind::kOutput, fmt::format("the name {} does not tell a mesh format: end it in {}, or name the "
                                                "format",
                                                path, list_formats(true)));
  }
  auto bytes = encode_mesh(mesh, *format);
  if (!bytes) return fail(bytes.error().kind, fmt::format("cannot write {}: {}", path, bytes.error().message));
  return write_file(path, *bytes, overwrite);
}

Result<Mesh> read_mesh(const std::string& path, MeshFileAxes* axes) {
  if (const Mesh* lent = io::find_lent_mesh(path)) return *lent;
  SCARP_TRY(auto&& bytes, read_file(path));
  return decode_mesh(bytes, path, axes);
}

}  // namespace scarp
