// The table of mesh formats with their writers and readers. A new format needs a name in scarp/io.h, a row here, and a
// file with its writer and reader.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scarp/io.h"
#include "scarp/mesh.h"
#include "scarp/result.h"

namespace scarp::io {

/// REQUIRES: find_unwritable() is empty.
using MeshWriter = Result<std::vector<std::uint8_t>>(const Mesh& mesh, const EncodeOptions& options);
/// Fails with a message that the caller completes with the file's name; may throw std::bad_alloc or std::length_error.
using MeshReader = Result<Mesh>(std::span<const std::uint8_t> bytes);

struct MeshFormatRow {
  MeshFormatTraits traits;
  std::string_view mark = {};  ///< the first bytes of a file, or an XML root element ("<LandXML"), if unique to the
                               ///< format
  MeshWriter* write;
  MeshReader* read = nullptr;
};

std::span<const MeshFormatRow> mesh_format_rows();
/// REQUIRES: `format` is one of MeshFormat's names.
const MeshFormatRow& row_of(MeshFormat format);

/// The format by content; the name decides only if bytes are ambiguous, as in a truncated STL file.
std::optional<MeshFormat> recognise_mesh(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace scarp::io
