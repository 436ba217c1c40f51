#include "io/mesh/formats.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "io/mesh/mesh_file_text.h"

namespace scarp::io {

// Each writer is defined in the file of its format.
using PlainWriter = Result<std::vector<std::uint8_t>>(const Mesh& mesh);
PlainWriter encode_glb, encode_obj, encode_stl, encode_tin, encode_vtu, encode_vtp, encode_landxml, encode_dxf,
    encode_gpkg, encode_one_3mf;
MeshWriter encode_ply, encode_2dm, encode_msh;
MeshReader decode_glb, decode_obj, decode_ply, decode_stl, decode_tin, decode_2dm, decode_vtk, decode_landxml,
    decode_dxf, decode_3mf, decode_msh;

namespace {

/// Wraps a writer without options.
template <PlainWriter* encode>
Result<std::vector<std::uint8_t>> without_options(const Mesh& mesh, const EncodeOptions& /*options*/) {
  return encode(mesh);
}

constexpr MeshFormatRow kRows[] = {
    {.traits = {.format = MeshFormat::kGlb,
                .name = "glb",
                .title = "GLB",
                .endings = "glb",
                .media_type = "model/gltf-binary",
                .contents = "glTF 2.0 in one file",
                .read_by = "browsers, games, Blender",
                .frame = DefaultFrame::kLocal,
                .heights = HeightsIn::kMetres,
                .up = 'y',
                .is_float32 = true,
                .holds_attributes = true,
                .bytes_per_vertex = 80},
     .mark = "glTF",
     .write = without_options<encode_glb>,
     .read = decode_glb},
    {.traits = {.format = MeshFormat::kObj,
                .name = "obj",
                .title = "OBJ",
                .endings = "obj",
                .media_type = "model/obj",
                .contents = "text",
                .read_by = "nearly everything",
                .frame = DefaultFrame::kLocal,
                .up = 'y',
                .has_choice_of_up = true,
                .holds_attributes = true,
                .holds_prints = true,
                .bytes_per_vertex = 190},
     .write = without_options<encode_obj>,
     .read = decode_obj},
    {.traits = {.format = MeshFormat::kPly,
                .name = "ply",
                .title = "PLY",
                .endings = "ply",
                .contents = "binary arrays behind a header of text",
                .read_by = "MeshLab, CloudCompare, QGIS",
                .frame = DefaultFrame::kLocal,
                .has_choice_of_up = true,
                .holds_attributes = true,
                .holds_prints = true,
                .bytes_per_vertex = 100},
     .write = encode_ply,
     .read = decode_ply},
    {.traits = {.format = MeshFormat::kStl,
                .name = "stl",
                .title = "STL",
                .endings = "stl",
                .media_type = "model/stl",
                .contents = "binary triangles, no shared vertices",
                .read_by = "slicers, CAD",
                .frame = DefaultFrame::kLocal,
                .has_choice_of_up = true,
                .is_float32 = true,
                .holds_prints = true,
                .bytes_per_vertex = 220},
     .write = without_options<encode_stl>,
     .read = decode_stl},
    {.traits = {.format = MeshFormat::kTin,
                .name = "tin",
                .title = "TIN",
                .endings = "tin",
                .contents = "one line per triangle, no shared vertices",
                .read_by = "Scape, Terra",
                .has_projection_file = true,
                .bytes_per_vertex = 400},
     .write = without_options<encode_tin>,
     .read = decode_tin},
    {.traits = {.format = MeshFormat::k2dm,
                .name = "2dm",
                .title = "2DM",
                .endings = "2dm",
                .contents = "`E3T` and `ND` cards, numbered from 1",
                .read_by = "SMS, QGIS (mesh layer), hydraulic models",
                .frame = DefaultFrame::kSource,
                .has_projection_file = true,
                .holds_zones = true,
                .holds_space = false,
                .counts_in_int32 = true},
     .mark = "MESH2D",
     .write = encode_2dm,
     .read = decode_2dm},
    {.traits = {.format = MeshFormat::kVtu,
                .name = "vtu",
                .title = "VTU",
                .endings = "vtu",
                .contents = "VTK's unstructured grid",
                .read_by = "ParaView, VTK, meshio",
                .holds_attributes = true,
                .bytes_per_vertex = 120},
     .mark = "<VTKFile",
     .write = without_options<encode_vtu>,
     .read = decode_vtk},
    {.traits = {.format = MeshFormat::kVtp,
                .name = "vtp",
                .title = "VTP",
                .endings = "vtp",
                .contents = "VTK's polydata",
                .read_by = "ParaView, VTK",
                .holds_attributes = true,
                .bytes_per_vertex = 120},
     .write = without_options<encode_vtp>,
     .read = decode_vtk},
    {.traits = {.format = MeshFormat::kLandXml,
                .name = "landxml",
                .title = "LandXML",
                .endings = "xml landxml",
                .shared = "xml",
                .contents = "one `Surface` of type TIN: `Pnts`, `Faces`",
                .read_by = "Civil 3D, survey and machine control",
                .has_lengths_only = true,
                .has_projection_file = true,
                .holds_space = false,
                .counts_in_int32 = true},
     .mark = "<LandXML",
     .write = without_options<encode_landxml>,
     .read = decode_landxml},
    {.traits = {.format = MeshFormat::kDxf,
                .name = "dxf",
                .title = "DXF",
                .endings = "dxf",
                .shared = "dxf",
                .contents = "`3DFACE`s on the layer TERRAIN, release 12",
                .read_by = "CAD, GDAL",
                .frame = DefaultFrame::kSource,
                .has_projection_file = true,
                .holds_space = false,
                .bytes_per_vertex = 900},
     .write = without_options<encode_dxf>,
     .read = decode_dxf},
    {.traits = {.format = MeshFormat::kGpkg,
                .name = "gpkg",
                .title = "GeoPackage",
                .endings = "gpkg",
                .media_type = "application/geopackage+sqlite3",
                .contents = "a layer `terrain` of polygons with z, one per triangle",
                .read_by = "GDAL, QGIS",
                .frame = DefaultFrame::kSource,
                .holds_space = false,
                .is_read = false,
                .bytes_per_vertex = 1200},
     .write = without_options<encode_gpkg>},
    {.traits = {.format = MeshFormat::k3mf,
                .name = "3mf",
                .title = "3MF",
                .endings = "3mf",
                .media_type = "model/3mf",
                .contents = "closed solids, as XML in an archive",
                .read_by = "slicers",
                .frame = DefaultFrame::kLocal,
                .heights = HeightsIn::kMetres,
                .is_float32 = true,
                .holds_prints = true,
                .holds_solids_only = true,
                .holds_space = false,
                .bytes_per_vertex = 400},
     .write = without_options<encode_one_3mf>,
     .read = decode_3mf},
    {.traits = {.format = MeshFormat::kMsh,
                .name = "msh",
                .title = "MSH",
                .endings = "msh",
                .contents = "Gmsh 4.1 as text: blocks of nodes and elements, physical groups",
                .read_by = "Gmsh, meshio, finite elements",
                .holds_zones = true},
     .mark = "$MeshFormat",
     .write = encode_msh,
     .read = decode_msh},
};

constexpr bool is_in_order() {
  for (std::size_t k = 0; k < std::size(kRows); ++k) {
    const MeshFormatRow& row = kRows[k];
    if (static_cast<std::size_t>(row.traits.format) != k || row.traits.is_read != (row.read != nullptr)) return false;
  }
  return true;
}
static_assert(is_in_order());

constexpr auto kTraits = [] {
  std::array<const MeshFormatTraits*, std::size(kRows)> all{};
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = &kRows[k].traits;
  return all;
}();

bool has_ending(const MeshFormatTraits& traits, std::string_view ending) {
  for (std::string_view rest = traits.endings; !rest.empty();) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    if (rest.substr(0, end) == ending) return true;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return false;
}

/// The extension of a path, or a whole word, in lower case; empty for a path without extension.
std::string ending_of(const std::string& name_or_path) {
  const std::size_t start = name_or_path.find_last_of("./");
  if (start == std::string::npos) return lowered(name_or_path);
  return name_or_path[start] == '.' ? lowered(name_or_path.substr(start + 1)) : "";
}

}  // namespace

}  // namespace scarp::io

namespace scarp {

std::span<const io::MeshFormatRow> io::mesh_format_rows() { return kRows; }

const io::MeshFormatRow& io::row_of(MeshFormat format) { return kRows[static_cast<std::size_t>(format)]; }

std::span<const MeshFormatTraits* const> mesh_formats() { return io::kTraits; }

const MeshFormatTraits& traits_of(MeshFormat format) { return io::row_of(format).traits; }

std::optional<MeshFormat> find_mesh_format(const std::string& name_or_path) {
  const std::string ending = io::ending_of(name_or_path);
  for (const MeshFormatTraits* traits : mesh_formats()) {
    if (io::has_ending(*traits, ending)) return traits->format;
  }
  return {};
}

std::optional<MeshFormat> find_mesh_file(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  const auto format = find_mesh_format(ending);
  if (!format || !traits_of(*format).is_read) return {};
  if (io::ending_of(ending) != traits_of(*format).shared) return format;
  std::vector<char> head(4096);
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(head.data());
  return io::recognise_mesh({bytes, static_cast<std::size_t>(file.gcount())}, "") == format ? format : std::nullopt;
}

}  // namespace scarp
