// The formats of OUTPUT in words, for the rows of options and for errors: all of it from the table of mesh formats
// (scarp/io.h), to which drawings and rasters are added.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scarp/io.h"

namespace scarp::cli {

/// Selects the formats of a list.
using OfFormat = bool (*)(const MeshFormatTraits&);

/// ".glb, .obj and .ply" of the formats that are so, each by its usual ending; `last` stands before the last one.
std::string list_mesh_endings(OfFormat is_so, std::string_view last = "or");
/// The endings of the format's files, with their points, the usual one first.
std::vector<std::string> list_endings(const MeshFormatTraits& traits);
/// "GLB, OBJ or PLY" of the meshes that are read.
std::string list_readable_meshes();
/// "glb, obj, …, svg, eps or dem", as --of names them.
std::string list_output_formats();
/// ".glb, .obj, …, .tif or .pgm": the usual endings of OUTPUT.
std::string list_output_endings();

// Choices of rows: words separated by blanks. These and keep() live as long as the program.
const char* output_formats();
const char* output_endings();
/// All endings of the meshes that are read.
const char* mesh_endings();
/// The text, for the row of an option.
const char* keep(std::string text);

}  // namespace scarp::cli
