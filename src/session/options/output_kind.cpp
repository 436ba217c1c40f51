#include "session/options/output_kind.h"

#include <fmt/format.h>

#include <cctype>
#include <optional>

#include "scarp/picture.h"
#include "session/table/format_words.h"
#include "session/table/option_table.h"
#include "session/text/paths.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

std::string lower(std::string word) {
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return word;
}

std::optional<OutputFormat> find_format(const std::string& word) {
  for (const MeshFormatTraits* traits : mesh_formats()) {
    if (word == traits->name) return OutputFormat{OutputKind::kMesh, traits->format, RasterFormat::kGeoTiff};
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

/// The format of an extension, by names of mesh and raster formats.
std::optional<OutputFormat> find_format_of_extension(const std::string& extension) {
  if (extension.size() < 2 || extension == ".dem") return std::nullopt;
  if (const auto mesh = find_mesh_format(extension)) return find_format(traits_of(*mesh).name);
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
  return traits_of(mesh).name;
}

std::string OutputFormat::title() const {
  if (kind == OutputKind::kMesh) return traits_of(mesh).title;
  std::string text = name();
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return kind == OutputKind::kDem ? "a raster" : text;
}

std::uint64_t OutputFormat::bytes_per_vertex() const { return is_mesh() ? traits_of(mesh).bytes_per_vertex : 300; }

bool OutputFormat::holds_space() const { return is_mesh() ? traits_of(mesh).holds_space : kind == OutputKind::kDem; }

DefaultFrame OutputFormat::default_frame() const { return is_mesh() ? traits_of(mesh).frame : DefaultFrame::kMetric; }

HeightsIn OutputFormat::heights_in() const {
  return is_mesh() ? traits_of(mesh).heights : kind == OutputKind::kDem ? HeightsIn::kFile : HeightsIn::kFrame;
}

HeightsIn heights_in(const std::string& mesh_path) {
  const auto format = find_mesh_format(mesh_path);
  return format ? traits_of(*format).heights : HeightsIn::kFrame;
}

DefaultFrame default_frame(const std::string& mesh_path) {
  const auto format = find_mesh_format(mesh_path);
  return format ? traits_of(*format).frame : DefaultFrame::kMetric;
}

Result<bool> parse_up(const Given& up) {
  constexpr Choice<bool> kAxes[] = {{"y", true}, {"z", false}};
  return up ? choose(name_of(OptionId::kUp), *up, kAxes) : Result<bool>(false);
}

Result<bool> choose_y_up(const Given& up, const OutputFormat& format, bool is_print) {
  if (!format.is_mesh()) {
    if (up)
      return fail(ErrorKind::kUsage, fmt::format("{} is for meshes, and OUTPUT is {}", OptionId::kUp, format.title()));
    return false;
  }
  const MeshFormatTraits& traits = traits_of(format.mesh);
  if (!up) return traits.has_choice_of_up && !is_print && traits.up == 'y';
  SCARP_TRY(const bool is_y, parse_up(up));
  if (!traits.has_choice_of_up && is_y != (traits.up == 'y'))
    return fail(ErrorKind::kUsage, fmt::format("{} {}: {} is always {} up; choose .obj, .ply or .stl", OptionId::kUp,
                                               *up, traits.title, traits.up));
  return traits.has_choice_of_up && is_y;
}

Result<OutputFormat> choose_output_format(const Given& of, const std::string& output) {
  if (output.empty()) return fail(ErrorKind::kUsage, "the name of OUTPUT is empty");
  const std::string extension = lower_extension(output);
  if (of) {
    std::optional<OutputFormat> named = find_format(lower(*of));
    if (!named) {
      return fail(ErrorKind::kUsage,
                  fmt::format("{} {} is unknown: choose {}", OptionId::kOf, shell_word(*of), list_output_formats()));
    }
    if (named->kind == OutputKind::kDem && extension == ".pgm") named->raster = RasterFormat::kPgm;
    return *named;
  }
  if (const std::optional<OutputFormat> named = find_format_of_extension(extension)) return *named;
  if (is_stdout(output))
    return fail(ErrorKind::kUsage, fmt::format("OUTPUT {} is standard output, whose name tells no format: give {} "
                                               "FORMAT, one of {}",
                                               output, OptionId::kOf, list_output_formats()));
  return fail(ErrorKind::kUsage,
              fmt::format("cannot tell the format from {}: use {}, or {} FORMAT{}", shell_word(output),
                          list_output_endings(), OptionId::kOf, extension == ".gltf" ? "; glTF is written as .glb" : ""));
}

}  // namespace scarp::cli
