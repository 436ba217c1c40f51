// The formats of mesh files: one table, which options, help, completions, messages, writers and readers ask.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#pragma GCC visibility push(default)

namespace scarp {

/// The frame of a mesh if no CRS is chosen.
enum class DefaultFrame {
  kLocal,   ///< around the raster's centre: for viewers, whose numbers are short
  kMetric,  ///< local for degrees, else the raster's own CRS: for files that hold doubles, and a shape in space
  kSource,  ///< the raster's own CRS, degrees too: for files drawn on maps
};

/// In which unit the heights of a field are. Heights without a declared unit are in the unit of the CRS's x and y where
/// that is a length, else in metres.
enum class HeightsIn {
  kFrame,   ///< metres in the local frame of a CRS and in space, else as in the file
  kMetres,  ///< metres in every frame: for files that are in metres by their specification
  kFile,    ///< in the unit of the file
};

/// In the order of the table.
enum class MeshFormat { kGlb, kObj, kPly, kStl, kTin, k2dm, kVtu, kVtp, kLandXml, kDxf, kGpkg, k3mf, kMsh };

/// The facts about a format that do not depend on a mesh. A format with none of a field's features omits the field.
struct MeshFormatTraits {
  MeshFormat format;
  const char* name;             ///< "landxml", for --of; one of the endings
  const char* title;            ///< "LandXML": for sentences
  const char* endings;          ///< "xml landxml": endings of file names, the usual one first
  const char* shared = "";      ///< the ending that files of other kinds have, too: "xml"
  const char* media_type = "";  ///< empty: none is registered
  const char* contents;         ///< parts of a file, in a few words
  const char* read_by;          ///< programs that read it

  // The place of a mesh.
  DefaultFrame frame = DefaultFrame::kMetric;  ///< frame of x and y unless a CRS is asked for
  HeightsIn heights = HeightsIn::kFrame;
  char up = 'z';                     ///< the axis that points up, 'y' or 'z'
  bool has_choice_of_up = false;     ///< --up chooses the axis; `up` is what most readers expect
  bool is_float32 = false;           ///< positions are offsets from the origin, rounded to float32; else doubles
  bool has_lengths_only = false;     ///< refuses degrees
  bool has_projection_file = false;  ///< has no place for a CRS that all its readers use: a .prj file holds it

  // Contents of a file in addition to triangles.
  bool holds_attributes = false;  ///< normals, uvs, colours
  bool holds_zones = false;       ///< materials and node strings: MeshZones
  bool holds_prints = false;      ///< millimetres, to those who print it
  bool holds_solids_only = false;
  bool holds_space = true;  ///< its z need not be the height

  bool is_read = true;                   ///< decode_mesh() reads it; else it is only written
  bool counts_in_int32 = false;          ///< its readers count vertices and triangles in signed 32-bit numbers
  std::uint64_t bytes_per_vertex = 260;  ///< about what writing needs for a vertex and its two triangles, the file's
                                         ///< bytes included
};

/// All formats, in the order of MeshFormat.
std::span<const MeshFormatTraits* const> mesh_formats();
/// REQUIRES: `format` is one of MeshFormat's names.
const MeshFormatTraits& traits_of(MeshFormat format);

/// From a name ("glb", "OBJ", "landxml", …) or from a path's extension (".xml" is LandXML); nothing if unknown.
std::optional<MeshFormat> find_mesh_format(const std::string& name_or_path);
/// The format of a mesh file that decode_mesh() reads, by the ending of its name; where files of other kinds share that
/// ending, by its first bytes as well. Nothing for other files.
std::optional<MeshFormat> find_mesh_file(const std::string& path);

}  // namespace scarp

#pragma GCC visibility pop
