#include "session/options/output_kind.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <optional>

#include "scarp/picture.h"
#include "session/table/option_table.h"
#include "session/text/paths.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

constexpr const char* kNames = "glb, obj, ply, stl, tin, 2dm, vtu, vtp, landxml, dxf, gpkg, 3mf, svg, eps or dem";

/// The facts about a mesh format that the commands need before they write it.
struct MeshRow {
  MeshFormat format;
  const char* name;
  const char* title;
  std::uint64_t bytes_per_vertex;
  bool holds_attributes;
  DefaultFrame frame;
  HeightsIn heights;
  const char* up;
  bool has_choice_of_up;
};
constexpr MeshRow kMeshRows[] = {
    {MeshFormat::kGlb, "glb", "GLB", 80, true, DefaultFrame::kLocal, HeightsIn::kMetres, "y", false},
    {MeshFormat::kObj, "obj", "OBJ", 190, true, DefaultFrame::kLocal, HeightsIn::kFrame, "y", true},
    {MeshFormat::kPly, "ply", "PLY", 100, true, DefaultFrame::kLocal, HeightsIn::kFrame, "z", true},
    {MeshFormat::kStl, "stl", "STL", 220, false, DefaultFrame::kLocal, HeightsIn::kFrame, "z", true},
    {MeshFormat::kTin, "tin", "TIN", 400, false, DefaultFrame::kMetric, HeightsIn::kFrame, "z", false},
    {MeshFormat::k2dm, "2dm", "2DM", 260, false, DefaultFrame::kSource, HeightsIn::kFrame, "z", false},
    {MeshFormat::kVtu, "vtu", "VTU", 120, true, DefaultFrame::kMetric, HeightsIn::kFrame, "z", false},
    {MeshFormat::kVtp, "vtp", "VTP", 120, true, DefaultFrame::kMetric, HeightsIn::kFrame, "z", false},
    {MeshFormat::kLandXml, "landxml", "LandXML", 260, false, DefaultFrame::kMetric, HeightsIn::kFrame, "z", false},
    {MeshFormat::kDxf, "dxf", "DXF", 900, false, DefaultFrame::kSource, HeightsIn::kFrame, "z", false},
    {MeshFormat::kGpkg, "gpkg", "GeoPackage", 1200, false, DefaultFrame::kSource, HeightsIn::kFrame, "z", false},
    {MeshFormat::k3mf, "3mf", "3MF", 400, false, DefaultFrame::kLocal, HeightsIn::kMetres, "z", false}};

const MeshRow& row_of(MeshFormat format) {
  for (const MeshRow& row : kMeshRows) {
    if (row.format == format) return row;
  }
  return kMeshRows[0];
}

std::string lower(std::string word) {
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return word;
}

std::optional<OutputFormat> find_format(const std::string& word) {
  for (const MeshRow& row : kMeshRows) {
    if (word == row.name) return OutputFormat{OutputKind::kMesh, row.format, RasterFormat::kGeoTiff};
  }
  OutputFormat format;
  if (word == "svg") {
    format.kind = OutputKind::kSvg;
  } else if (word == "eps") {
    format.kind = OutputKind::kEps;
  } else if (word == "dem") {
    format.kind = OutputKind::kDem;
  } else {
    return std::nullopt;
  }
  return format;
}

/// The format of an extension: the formats' names, and those of rasters.
std::optional<OutputFormat> find_format_of_extension(const std::string& extension) {
  if (extension.size() < 2 || extension == ".dem") return std::nullopt;
  if (extension == ".xml") return find_format("landxml");
  if (extension == ".tif" || extension == ".tiff") return find_format("dem");
  if (extension == ".pgm") return OutputFormat{OutputKind::kDem, MeshFormat::kGlb, RasterFormat::kPgm};
  return find_format(extension.substr(1));
}

}  // namespace

const char* OutputFormat::name() const {
  switch (kind) {
    case OutputKind::kSvg:
      return "svg";
    case OutputKind::kEps:
      return "eps";
    case OutputKind::kDem:
      return raster == RasterFormat::kPgm ? "pgm" : "tif";
    case OutputKind::kMesh:
      break;
  }
  return row_of(mesh).name;
}

std::string OutputFormat::title() const {
  if (kind == OutputKind::kMesh) return row_of(mesh).title;
  std::string text = name();
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return kind == OutputKind::kDem ? "a raster" : text;
}

std::uint64_t OutputFormat::bytes_per_vertex() const {
  return kind == OutputKind::kMesh ? row_of(mesh).bytes_per_vertex : 300;
}

bool OutputFormat::holds_attributes() const { return is_mesh() && row_of(mesh).holds_attributes; }

bool OutputFormat::holds_prints() const {
  return is_mesh() &&
         (mesh == MeshFormat::kStl || mesh == MeshFormat::k3mf || mesh == MeshFormat::kObj || mesh == MeshFormat::kPly);
}

bool OutputFormat::holds_space() const {
  if (!is_mesh()) return kind == OutputKind::kDem;
  constexpr MeshFormat kOthers[] = {MeshFormat::k2dm, MeshFormat::kLandXml, MeshFormat::kDxf, MeshFormat::kGpkg,
                                    MeshFormat::k3mf};
  return std::find(std::begin(kOthers), std::end(kOthers), mesh) == std::end(kOthers);
}

DefaultFrame OutputFormat::default_frame() const { return is_mesh() ? row_of(mesh).frame : DefaultFrame::kMetric; }

HeightsIn OutputFormat::heights_in() const {
  return is_mesh() ? row_of(mesh).heights : kind == OutputKind::kDem ? HeightsIn::kFile : HeightsIn::kFrame;
}

HeightsIn heights_in(const std::string& mesh_path) {
  const auto format = find_mesh_format(mesh_path);
  return format ? row_of(*format).heights : HeightsIn::kFrame;
}

DefaultFrame default_frame(const std::string& mesh_path) {
  const auto format = find_mesh_format(mesh_path);
  return format ? row_of(*format).frame : DefaultFrame::kMetric;
}

bool OutputFormat::has_projection_beside() const {
  return is_mesh() && (mesh == MeshFormat::k2dm || mesh == MeshFormat::kDxf || mesh == MeshFormat::kTin ||
                       mesh == MeshFormat::kLandXml);
}

Result<bool> parse_up(const Given& up) {
  constexpr Choice<bool> kAxes[] = {{"y", true}, {"z", false}};
  return up ? choose(name_of(OptionId::kUp), *up, kAxes) : Result<bool>(false);
}

Result<bool> choose_y_up(const Given& up, const OutputFormat& format, bool is_print) {
  const MeshRow& row = row_of(format.mesh);
  if (!format.is_mesh()) {
    if (up)
      return fail(ErrorKind::kUsage, fmt::format("{} is for meshes, and OUTPUT is {}", OptionId::kUp, format.title()));
    return false;
  }
  if (!up) return row.has_choice_of_up && !is_print && *row.up == 'y';
  SCARP_TRY(const bool is_y, parse_up(up));
  if (!row.has_choice_of_up && *up != row.up) {
    return fail(ErrorKind::kUsage, fmt::format("{} {}: {} is always {} up; choose .obj, .ply or .stl", OptionId::kUp,
                                               *up, row.title, row.up));
  }
  return row.has_choice_of_up && is_y;
}

Result<OutputFormat> choose_output_format(const Given& of, const std::string& output) {
  if (output.empty()) return fail(ErrorKind::kUsage, "the name of OUTPUT is empty");
  const std::string extension = lower_extension(output);
  if (of) {
    std::optional<OutputFormat> named = find_format(lower(*of));
    if (!named) {
      return fail(ErrorKind::kUsage,
                  fmt::format("{} {} is unknown: choose {}", OptionId::kOf, shell_word(*of), kNames));
    }
    if (named->kind == OutputKind::kDem && extension == ".pgm") named->raster = RasterFormat::kPgm;
    return *named;
  }
  if (const std::optional<OutputFormat> named = find_format_of_extension(extension)) return *named;
  if (is_stdout(output))
    return fail(ErrorKind::kUsage, fmt::format("OUTPUT {} is standard output, whose name tells no format: give {} "
                                               "FORMAT, one of {}",
                                               output, OptionId::kOf, kNames));
  return fail(
      ErrorKind::kUsage,
      fmt::format("cannot tell the format from {}: use .glb, .obj, .ply, .stl, .tin, .2dm, .vtu, .vtp, .xml, .dxf, "
                  ".gpkg, .3mf, .svg, .eps, .tif or .pgm, or {} FORMAT{}",
                  shell_word(output), OptionId::kOf, extension == ".gltf" ? "; glTF is written as .glb" : ""));
}

}  // namespace scarp::cli
