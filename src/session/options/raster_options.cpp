#include "session/options/raster_options.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>

#include "session/text/text.h"

namespace scarp::cli {
namespace {

using enum OptionId;

constexpr Choice<Decode> kDecodes[] = {{"terrarium", Decode::kTerrarium}, {"mapbox", Decode::kMapbox}};

/// Parses scale, offset and unit of the heights, and the cell size.
Result<void> parse_heights(const GivenOptions& given, ReadOptions& options) {
  SCARP_TRY(const auto scale, given.number(kZScale));
  SCARP_TRY(const auto offset, given.number(kZOffset));
  options.z_scale = scale.value_or(1);
  options.z_offset = offset.value_or(0);
  if (options.z_scale == 0)
    return fail(ErrorKind::kUsage, fmt::format("{} 0 makes all heights equal: give a factor other than 0", kZScale));
  if (given[kZUnit] == "") return fail(ErrorKind::kUsage, fmt::format("the unit of {} is empty", kZUnit));
  options.z_unit = given[kZUnit].value_or("");
  SCARP_TRY(options.cell_size, given.number(kCellSize));
  return {};
}

Result<void> parse_extent(const GivenOptions& given, ReadOptions& options) {
  const std::vector<std::string>& sides = given.all(kExtent);
  if (sides.empty()) return {};
  std::array<double, 4> box{};
  for (std::size_t k = 0; k < box.size(); ++k) {
    SCARP_TRY(box[k], parse_number(name_of(kExtent), sides[k]));
  }
  if (!(box[0] < box[2]) || !(box[1] < box[3]))
    return fail(ErrorKind::kUsage,
                fmt::format("{} {} is empty: its order is XMIN YMIN XMAX YMAX", kExtent, fmt::join(sides, " ")));
  options.view.extent = box;
  return {};
}

}  // namespace

Result<std::optional<double>> parse_nodata(const GivenOptions& given) {
  const Given& text = given[kNodata];
  if (!text) return std::optional<double>();
  const std::optional<double> value = find_number(*text);
  SCARP_RETURN_IF_ERROR(check_size(name_of(kNodata), *text, value));
  if (!value) return fail(ErrorKind::kUsage, fmt::format("{} {} is not a number or nan", kNodata, shell_word(*text)));
  return value;
}

Result<double> parse_fill_distance(const GivenOptions& given, bool is_filled) {
  SCARP_TRY(const auto distance, given.number(kFillDistance));
  return distance.value_or(is_filled ? 100 : 0);
}

Error explain_reading(const GivenOptions& given, Error error) {
  if (error.kind != ErrorKind::kInput) return error;
  const std::string& path = given.input();
  if (given.inputs().size() == 1 && path == "-" && error.message.starts_with("standard input"))
    error.message += fmt::format("; it is read as a raster, with {} as points or lines, never as a mesh", kPoints);
  else if (error.message.starts_with(path + ": holds vector data"))
    error.message += fmt::format("; {} reads it as points or lines", kPoints);
  return error;
}

Result<ReadOptions> parse_reading(const GivenOptions& given) {
  ReadOptions options;
  const std::vector<std::string>& paths = given.inputs();
  for (const std::string& path : paths) {
    if (path.empty()) return fail(ErrorKind::kUsage, "the name of the raster is empty");
  }
  if (!paths.empty()) options.view.more.assign(paths.begin() + 1, paths.end());
  SCARP_RETURN_IF_ERROR(parse_extent(given, options));
  SCARP_TRY(options.view.resolution, given.number(kResolution));
  SCARP_TRY(const auto band, given.count(kBand));
  options.band = static_cast<int>(band.value_or(1));
  SCARP_TRY(options.nodata, parse_nodata(given));
  SCARP_TRY(const auto decode, given.choice(kDecode, kDecodes));
  options.decode = decode.value_or(options.decode);
  if (given[kCrs] == "")
    return fail(ErrorKind::kUsage, fmt::format("{} is empty: choose source, local, grid or a CRS", kCrs));
  options.crs = given[kCrs].value_or("");
  SCARP_RETURN_IF_ERROR(parse_heights(given, options));
  return options;
}

}  // namespace scarp::cli
