// The formats of OUTPUT in words, for option rows and errors: from the table of mesh formats (scarp/io.h), plus
// drawings and rasters.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scarp/io.h"

namespace scarp::cli {

/// Selects the formats of a list.
using OfFormat = bool (*)(const MeshFormatTraits&);

/// ".glb, .obj and .ply": the usual endings of the selected formats; `last` precedes the last ending.
std::string list_mesh_endings(OfFormat is_so, std::string_view last = "or");
/// The endings of the format's files, with the dot; the usual ending is first.
std::vector<std::string> list_endings(const MeshFormatTraits& traits);
/// "GLB, OBJ or PLY": the readable mesh formats.
std::string list_readable_meshes();
/// "glb, obj, …, svg, eps or dem", as --of names them.
std::string list_output_formats();
/// ".glb, .obj, …, .tif or .pgm": the usual endings of OUTPUT.
std::string list_output_endings();

// Choices of rows: words separated by blanks. They and the result of keep() live as long as the program.
const char* output_formats();
const char* output_endings();
/// All endings of readable meshes.
const char* mesh_endings();
/// Stores the text for the row of an option.
const char* keep(std::string text);

}  // namespace scarp::cli
