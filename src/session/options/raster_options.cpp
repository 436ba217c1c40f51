#include "session/options/raster_options.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <tuple>

#include "session/table/option_table.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

/// --z-scale, --z-offset, --z-unit and --cell-size.
Result<void> parse_heights(const RasterArguments& given, ReadOptions& options) {
  for (const auto& [name, text, value] : {std::tuple{"--z-scale", &given.z_scale, &options.z_scale},
                                          std::tuple{"--z-offset", &given.z_offset, &options.z_offset}}) {
    if (!*text) continue;
    SCARP_TRY(*value, parse_number(name, **text));
  }
  if (options.z_scale == 0)
    return fail(ErrorKind::kUsage, "--z-scale 0 makes all heights equal: give a factor other than 0");
  if (given.z_unit && given.z_unit->empty()) return fail(ErrorKind::kUsage, "the unit of --z-unit is empty");
  options.z_unit = given.z_unit.value_or("");
  if (!given.cell_size) return {};
  SCARP_TRY(const double cell, parse_number("--cell-size", *given.cell_size));
  if (cell <= 0)
    return fail(ErrorKind::kUsage,
                fmt::format("--cell-size {} is not above 0: give the width of a cell", *given.cell_size));
  options.cell_size = cell;
  return {};
}

}  // namespace

Result<std::optional<double>> parse_nodata(const Given& nodata) {
  if (!nodata) return std::optional<double>();
  const std::optional<double> value = find_number(*nodata);
  SCARP_RETURN_IF_ERROR(check_size("--nodata", *nodata, value));
  if (!value) return fail(ErrorKind::kUsage, fmt::format("--nodata {} is not a number or nan", shell_word(*nodata)));
  return value;
}

Result<double> parse_fill_distance(const Given& text, bool is_filled) {
  if (!text) return is_filled ? 100.0 : 0.0;
  if (!is_filled) return fail(ErrorKind::kUsage, "--fill-distance needs --nodata-policy fill");
  const Result<double> distance = parse_number("--fill-distance", *text);
  if (distance && *distance <= 0)
    return fail(ErrorKind::kUsage, fmt::format("--fill-distance {} is not above 0", shell_word(*text)));
  return distance;
}

void RasterArguments::add_to(CLI::App& command) {
  add_option(command, OptionId::kBand, band);
  add_option(command, OptionId::kNodata, nodata);
  add_option(command, OptionId::kDecode, decode);
  add_option(command, OptionId::kCrs, crs);
  add_option(command, OptionId::kZScale, z_scale);
  add_option(command, OptionId::kZOffset, z_offset);
  add_option(command, OptionId::kZUnit, z_unit);
  add_option(command, OptionId::kCellSize, cell_size);
  add_numbers(command, OptionId::kExtent, extent, 4);
  add_option(command, OptionId::kResolution, resolution);
}

std::string RasterArguments::canonical() const {
  return canonical_option("--band", band) + canonical_option("--nodata", nodata) +
         canonical_option("--decode", decode) + canonical_option("--crs", crs) +
         canonical_option("--z-scale", z_scale) + canonical_option("--z-offset", z_offset) +
         canonical_option("--z-unit", z_unit) + canonical_option("--cell-size", cell_size) +
         (extent.empty() ? "" : fmt::format(" --te {}", fmt::join(extent, " "))) +
         canonical_option("--resolution", resolution);
}

Error RasterArguments::explain(Error error) const {
  if (error.kind != ErrorKind::kInput) return error;
  if (paths.size() == 1 && path() == "-" && error.message.starts_with("standard input"))
    error.message += "; it is read as a raster, with --points as points or lines, never as a mesh";
  else if (error.message.starts_with(path() + ": holds vector data"))
    error.message += "; --points takes it for points or lines";
  return error;
}

Result<ReadOptions> RasterArguments::parse() const {
  ReadOptions options;
  for (const std::string& path : paths) {
    if (path.empty()) return fail(ErrorKind::kUsage, "the name of the raster is empty");
  }
  options.view.more.assign(paths.begin() + 1, paths.end());
  if (!extent.empty()) {
    std::array<double, 4> box{};
    for (std::size_t k = 0; k < box.size(); ++k) {
      SCARP_TRY(box[k], parse_number("--te", extent[k]));
    }
    if (!(box[0] < box[2]) || !(box[1] < box[3])) {
      return fail(ErrorKind::kUsage, fmt::format("--te {} {} {} {} is empty: its order is XMIN YMIN XMAX YMAX",
                                                 extent[0], extent[1], extent[2], extent[3]));
    }
    options.view.extent = box;
  }
  if (resolution) {
    SCARP_TRY(const double value, parse_number("--resolution", *resolution));
    if (!(value > 0)) return fail(ErrorKind::kUsage, fmt::format("--resolution {} is not above 0", *resolution));
    if (decode) {
      return fail(ErrorKind::kUsage,
                  "--resolution cannot be combined with --decode: means of packed colours are no heights");
    }
    options.view.resolution = value;
  }
  if (band) {
    SCARP_TRY(const std::uint64_t number, parse_count("--band", *band, 1));
    if (number > 65535) {
      return fail(ErrorKind::kUsage, fmt::format("--band {} is more than any raster has (65535)", *band));
    }
    options.band = static_cast<int>(number);
  }
  SCARP_TRY(options.nodata, parse_nodata(nodata));
  if (decode) {
    if (*decode == "terrarium") {
      options.decode = Decode::kTerrarium;
    } else if (*decode == "mapbox") {
      options.decode = Decode::kMapbox;
    } else {
      return fail(ErrorKind::kUsage,
                  fmt::format("--decode {} is unknown: choose terrarium or mapbox", shell_word(*decode)));
    }
    if (band) {
      return fail(ErrorKind::kUsage, "--decode cannot be combined with --band: decoding takes bands 1, 2 and 3");
    }
  }
  if (crs) {
    if (crs->empty()) return fail(ErrorKind::kUsage, "--crs is empty: choose source, local, grid or a CRS");
    options.crs = *crs;
  }
  SCARP_RETURN_IF_ERROR(parse_heights(*this, options));
  return options;
}

}  // namespace scarp::cli
