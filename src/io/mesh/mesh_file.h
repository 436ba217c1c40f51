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

namespace scarp {

/// The sentence that refuses a mesh no format can hold: no triangles, arrays whose sizes disagree, an index out of
/// range, a position that is not finite (or, with `as_float`, beyond float32). Empty if all is well.
std::string find_unwritable(const Mesh& mesh, bool as_float);

/// Metadata as one line of text: "KEY: VALUE". Bytes below 32, '%', '\' and, in keys, ':' become %XX, so that no reader
/// interprets them as line ends, continuations or separators.
std::string metadata_line(const std::string& key, const std::string& value);
/// The reverse of metadata_line(). Returns false if there is no separator.
bool parse_metadata_line(std::string_view line, std::map<std::string, std::string>& metadata);

/// The same in printable ASCII, for formats that declare an encoding, whatever bytes the name of a file has.
std::string ascii_metadata_line(const std::string& key, const std::string& value);
/// Key or value alone: all bytes but printable ASCII, '%' and '\\' become %XX; and the reverse.
std::string ascii_text(const std::string& text);
std::string undo_ascii_text(std::string_view text);

/// "x y z", each the shortest text that reads back to the same double.
std::string origin_text(const std::array<double, 3>& origin);
/// Three finite numbers, or nothing.
std::optional<std::array<double, 3>> parse_origin(std::string_view text);

/// "x east, y north, z up", or what they are in a mesh that is y up.
const char* axes_text(const Mesh& mesh);

/// Expresses absolute positions relative to `origin`, if then vertex(v) is exactly what it was for every v; else does
/// not change them.
void set_origin(Mesh& mesh, const std::array<double, 3>& origin);

/// Appends the polygon as a fan from its first corner; empty, or what is wrong with it: thousands of triangles around
/// one corner cost the judge the square of their number.
std::string append_fan(std::span<const std::uint32_t> corners, std::vector<std::uint32_t>& triangles);

/// Readers collect what vertices carry as they find it: drops normals, uvs, colours and channels that not every vertex
/// has.
void drop_partial_attributes(Mesh& mesh);

/// The last check of every reader: at least one triangle, all indices in range, all positions finite.
/// Returns the sentence, empty if all is well.
std::string find_unreadable(const Mesh& mesh);

/// True if the bytes have the length that a binary STL file's own count asks for.
bool is_binary_stl(std::span<const std::uint8_t> bytes);
/// True if the text begins as a DXF file does: with a comment or a section.
bool is_dxf(std::span<const std::uint8_t> bytes);

}  // namespace scarp
