#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <utility>

#include "commands/commands.h"
#include "grid/generate.h"
#include "scarp/io.h"
#include "session/plan/outputs.h"
#include "session/table/option_table.h"
#include "session/text/paths.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

using enum OptionId;

/// The format by name or extension: "tif", "tiff" or "pgm".
std::optional<RasterFormat> find_raster_format(std::string name) {
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (name == "tif" || name == "tiff") return RasterFormat::kGeoTiff;
  if (name == "pgm") return RasterFormat::kPgm;
  return std::nullopt;
}

Result<RasterFormat> choose_format(const Given& asked, const std::string& output) {
  std::string name = asked.value_or(std::filesystem::path(output).extension().string());
  if (!asked && !name.empty()) name.erase(0, 1);
  if (const auto format = find_raster_format(name)) return *format;
  return fail(ErrorKind::kUsage,
              asked ? fmt::format("{} {} is unknown: choose tif or pgm", kOf, shell_word(*asked))
                    : fmt::format("the extension of OUTPUT {} tells no format: end it in .tif or .pgm, or give {}",
                                  shell_word(output), kOf));
}

/// Scales heights to 0 … `range`.
void stretch(OwnedHeightField& field, double range) {
  const double least = field.info.min, relief = field.info.max - field.info.min;
  for (float& z : field.samples) {
    z = relief > 0 ? static_cast<float>((static_cast<double>(z) - least) / relief * range) : 0.0f;
  }
  const HeightRange heights = height_range(field);
  field.info.min = heights.min;
  field.info.max = heights.max;
}

/// Places the lower left corner at the origin.
void place(OwnedHeightField& field, double size) {
  RasterInfo& info = field.info;
  info.has_georeference = true;
  info.geotransform = {0, size, 0, size * field.rows, 0, -size};
  info.cell_x = info.cell_y = size;
}

}  // namespace

Result<void> run_generate(const GivenOptions& given, const std::string&) {
  const std::optional<grid::FieldStyle> style = grid::find_field_style(*given[kStyle]);
  if (!style) {
    return fail(ErrorKind::kUsage, fmt::format("STYLE {} is unknown: choose {}", shell_word(*given[kStyle]),
                                               fmt::join(grid::field_style_names(), ", ")));
  }
  SCARP_TRY(const auto cols, given.count(kCols));
  SCARP_TRY(const auto rows, given.count(OptionId::kRows));
  SCARP_TRY(const auto seed, given.count(kSeed));
  if (seed && *style != grid::FieldStyle::kFractal && *style != grid::FieldStyle::kSmooth)
    return fail(ErrorKind::kUsage,
                fmt::format("{} is for fractal and smooth only: {} is always the same", kSeed, *given[kStyle]));
  SCARP_TRY(const auto range, given.number(OptionId::kRange));
  SCARP_TRY(const auto size, given.number(kSize));
  SCARP_TRY(const RasterFormat format, choose_format(given[kOf], *given[kOutput]));
  if (size && format == RasterFormat::kPgm) {
    return fail(ErrorKind::kUsage, fmt::format("{} needs a GeoTIFF: PGM has no room for coordinates", kSize));
  }
  SCARP_RETURN_IF_ERROR(check_outputs({{name_of(kOutput), *given[kOutput]}}, {}, given.has(kOverwrite)));

  SCARP_TRY(OwnedHeightField field,
            grid::generate_field(*style, static_cast<int>(*cols), static_cast<int>(*rows), seed.value_or(0)));
  if (range) stretch(field, *range);
  if (size) place(field, *size);
  const Result<std::vector<std::uint8_t>> bytes =
      encode_raster({field.samples, field.cols, field.rows, &field.info}, format);
  if (!bytes) {
    return fail(bytes.error().kind, fmt::format("{} cannot be written: {}", *given[kOutput], bytes.error().message));
  }
  const Result<void> written = write_file(*given[kOutput], *bytes, given.has(kOverwrite));
  if (!written || given.has(kQuiet)) return written;
  const std::string summary = fmt::format("{}: {} columns x {} rows, heights {} to {}\n{}: {}\n", field.info.path,
                                          field.cols, field.rows, format_number(field.info.min),
                                          format_number(field.info.max), *given[kOutput], format_bytes(bytes->size()));
  if (is_stdout(*given[kOutput])) {
    print_to_stderr(summary);
    return {};
  }
  return print_summary(summary);
}

}  // namespace scarp::cli
