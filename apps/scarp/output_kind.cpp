#include "output_kind.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>

#include "scarp/picture.h"
#include "text.h"

namespace scarp::cli {
namespace {

constexpr const char* kNames = "glb, obj, ply, stl, tin, svg, eps or dem";

constexpr Choice<MeshFormat> kMeshFormats[] = {{"glb", MeshFormat::kGlb},
                                               {"obj", MeshFormat::kObj},
                                               {"ply", MeshFormat::kPly},
                                               {"stl", MeshFormat::kStl},
                                               {"tin", MeshFormat::kTin}};

std::string lower(std::string word) {
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return word;
}

std::optional<OutputFormat> find_format(const std::string& word) {
  for (const Choice<MeshFormat>& choice : kMeshFormats) {
    if (word == choice.name) return OutputFormat{OutputKind::kMesh, choice.value, RasterFormat::kGeoTiff};
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

/// What an extension stands for: the formats' names, and those of rasters.
std::optional<OutputFormat> find_format_of_extension(const std::string& extension) {
  if (extension.size() < 2 || extension == ".dem") return std::nullopt;
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
  return name_of(mesh, kMeshFormats);
}

std::string OutputFormat::title() const {
  std::string text = name();
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return kind == OutputKind::kDem ? "a raster" : text;
}

std::uint64_t OutputFormat::bytes_per_vertex() const {
  if (kind != OutputKind::kMesh) return 300;
  switch (mesh) {
    case MeshFormat::kGlb:
      return 80;
    case MeshFormat::kObj:
      return 190;
    case MeshFormat::kPly:
      return 100;
    case MeshFormat::kStl:
      return 220;
    case MeshFormat::kTin:
      return 400;
  }
  return 0;
}

Result<OutputFormat> choose_output_format(const Given& of, const std::string& output) {
  if (output.empty()) return fail(ErrorKind::kUsage, "the name of OUTPUT is empty");
  if (output == "-") {
    return fail(ErrorKind::kUsage, "- is no output: for standard output give /dev/stdout and a format with --of");
  }
  const std::string extension = lower_extension(output);
  if (of) {
    std::optional<OutputFormat> named = find_format(lower(*of));
    if (!named) {
      return fail(ErrorKind::kUsage, fmt::format("--of {} is unknown: choose {}", shell_word(*of), kNames));
    }
    if (named->kind == OutputKind::kDem && extension == ".pgm") named->raster = RasterFormat::kPgm;
    return *named;
  }
  if (const std::optional<OutputFormat> named = find_format_of_extension(extension)) return *named;
  return fail(ErrorKind::kUsage,
              fmt::format("{} does not tell a format: end it in .glb, .obj, .ply, .stl, .tin, .svg, .eps, .tif or "
                          ".pgm, or choose one with --of",
                          shell_word(output)));
}

Result<void> close_with_base(Mesh& mesh, double base) {
  if (add_base(mesh, base)) return {};
  double lowest = mesh.vertex(0)[2];
  for (std::size_t v = 1; v < mesh.vertex_count(); ++v) lowest = std::min(lowest, mesh.vertex(v)[2]);
  return fail(ErrorKind::kUsage,
              fmt::format("--base {:.10g} is not below the lowest vertex, which is at {:.10g}", base, lowest));
}

Result<std::vector<std::uint8_t>> encode_as(const OutputFormat& format, const Mesh& mesh) {
  if (format.kind == OutputKind::kSvg) return encode_svg(mesh);
  if (format.kind == OutputKind::kEps) return encode_eps(mesh);
  return encode_mesh(mesh, format.mesh);
}

}  // namespace scarp::cli
