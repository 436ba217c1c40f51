#include "commands/generate_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <utility>

#include "scarp/generate.h"
#include "scarp/io.h"
#include "session/plan/outputs.h"
#include "session/table/option_table.h"
#include "session/text/paths.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

/// "tif", "tiff" or "pgm", of a name or of a path's extension.
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
              asked ? fmt::format("--of {} is unknown: choose tif or pgm", shell_word(*asked))
                    : fmt::format("the extension of OUTPUT {} tells no format: end it in .tif or .pgm, or give --of",
                                  shell_word(output)));
}

Result<int> parse_side(std::string_view option, const std::string& text) {
  SCARP_TRY(const std::uint64_t side, parse_count(option, text, 2));
  return static_cast<int>(std::min<std::uint64_t>(side, 1 << 30));
}

/// A number above 0.
Result<double> parse_positive(std::string_view option, const std::string& text) {
  const Result<double> value = parse_number(option, text);
  if (value && !(*value > 0)) {
    return fail(ErrorKind::kUsage, fmt::format("{} {} must be above 0", option, shell_word(text)));
  }
  return value;
}

/// Heights from 0 to `range`.
void stretch(OwnedHeightField& field, double range) {
  const double least = field.info.min, relief = field.info.max - field.info.min;
  for (float& z : field.samples) {
    z = relief > 0 ? static_cast<float>((static_cast<double>(z) - least) / relief * range) : 0.0f;
  }
  const HeightRange heights = height_range(field);
  field.info.min = heights.min;
  field.info.max = heights.max;
}

/// The first sample's corner at the origin, rows going down.
void place(OwnedHeightField& field, double size) {
  RasterInfo& info = field.info;
  info.has_georeference = true;
  info.geotransform = {0, size, 0, size * field.rows, 0, -size};
  info.cell_x = info.cell_y = size;
}

}  // namespace

GenerateCommand::GenerateCommand(CLI::App& program) : command_(add_command(program, kGenerate)) {
  add_option(*command_, OptionId::kStyle, style_);
  add_option(*command_, OptionId::kCols, cols_);
  add_option(*command_, OptionId::kRows, rows_);
  add_option(*command_, OptionId::kOutput, output_);
  add_option(*command_, OptionId::kSeed, seed_);
  add_option(*command_, OptionId::kRange, range_);
  add_option(*command_, OptionId::kSize, size_);
  add_option(*command_, OptionId::kOf, format_);
  add_flag(*command_, OptionId::kOverwrite, overwrite_);
  add_flag(*command_, OptionId::kQuiet, quiet_);
}

Result<void> GenerateCommand::run() const {
  const std::optional<FieldStyle> style = find_field_style(style_);
  if (!style) {
    return fail(ErrorKind::kUsage, fmt::format("STYLE {} is unknown: choose {}", shell_word(style_),
                                               fmt::join(field_style_names(), ", ")));
  }
  SCARP_TRY(const int cols, parse_side("COLS", cols_));
  SCARP_TRY(const int rows, parse_side("ROWS", rows_));
  SCARP_TRY(const std::uint64_t seed, parse_count("--seed", seed_.value_or("0"), 0));
  if (seed_ && *style != FieldStyle::kFractal && *style != FieldStyle::kSmooth) {
    return fail(ErrorKind::kUsage, fmt::format("--seed is for fractal and smooth only: {} is always the same", style_));
  }
  SCARP_TRY(const double range, parse_positive("--range", range_.value_or("1")));
  SCARP_TRY(const double size, parse_positive("--size", size_.value_or("1")));
  SCARP_TRY(const RasterFormat format, choose_format(format_, output_));
  if (size_ && format == RasterFormat::kPgm) {
    return fail(ErrorKind::kUsage, "--size needs a GeoTIFF: PGM has no room for coordinates");
  }
  SCARP_RETURN_IF_ERROR(check_outputs({{"OUTPUT", output_}}, {}, overwrite_));

  SCARP_TRY(OwnedHeightField field, generate_field(*style, cols, rows, seed));
  if (range_) stretch(field, range);
  if (size_) place(field, size);
  const Result<std::vector<std::uint8_t>> bytes =
      encode_raster({field.samples, field.cols, field.rows, &field.info}, format);
  if (!bytes) {
    return fail(bytes.error().kind, fmt::format("{} cannot be written: {}", output_, bytes.error().message));
  }
  const Result<void> written = write_file(output_, *bytes, overwrite_);
  if (!written || quiet_) return written;
  const std::string summary =
      fmt::format("{}: {} columns x {} rows, heights {} to {}\n{}: {}\n", field.info.path, field.cols, field.rows,
                  format_number(field.info.min), format_number(field.info.max), output_, format_bytes(bytes->size()));
  if (is_stdout(output_)) {
    print_to_stderr(summary);
    return {};
  }
  return print_summary(summary);
}

}  // namespace scarp::cli
