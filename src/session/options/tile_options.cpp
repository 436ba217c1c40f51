#include "session/options/tile_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "scarp/pyramid.h"
#include "session/options/image_options.h"
#include "session/options/memory_options.h"
#include "session/table/option_table.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

constexpr Choice<Effort> kTileEfforts[] = {
    {"fast", Effort::kFast}, {"normal", Effort::kNormal}, {"high", Effort::kHigh}};
constexpr Choice<GridKind> kGrids[] = {
    {"geographic", GridKind::kGeographic}, {"mercator", GridKind::kMercator}, {"local", GridKind::kLocal}};
constexpr Choice<GridKind> kGlobeGrids[] = {{"geographic", GridKind::kGeographic}, {"mercator", GridKind::kMercator}};
constexpr Choice<bool> kBounds[] = {{"nodes", false}, {"samples", true}};

enum class TileNodata { kVoids, kBackground, kFill };
constexpr Choice<TileNodata> kTileNodata[] = {
    {"voids", TileNodata::kVoids}, {"background", TileNodata::kBackground}, {"fill", TileNodata::kFill}};
constexpr Choice<int> kCellWords[] = {{"16", 16}, {"32", 32}, {"64", 64}, {"128", 128}, {"256", 256}};
constexpr int kEgm2008 = 3855;

struct DatumWord {
  const char* word;
  Vertical vertical;
  int epsg = 0;
};
constexpr int kEgm96Code = 5773;
constexpr DatumWord kDatums[] = {{"auto", Vertical::kAuto},
                                 {"egm96", Vertical::kEgm96},
                                 {"egm2008", Vertical::kEpsg, kEgm2008},
                                 {"ellipsoid", Vertical::kEllipsoid},
                                 {"none", Vertical::kNone}};

constexpr Choice<TileFormat> kTileFormats[] = {{"qm", TileFormat::kQuantizedMesh}, {"3dtiles", TileFormat::kGlb}};

Result<Datum> parse_vertical(const std::string& text) {
  Datum datum;
  for (const DatumWord& one : kDatums) {
    if (text != one.word) continue;
    datum.vertical = one.vertical;
    datum.epsg = one.epsg;
    return datum;
  }
  constexpr std::string_view kEpsg = "EPSG:";
  if (text.starts_with(kEpsg)) {
    const Result<std::uint64_t> code = parse_count("--vertical EPSG:", text.substr(kEpsg.size()), 1);
    if (code && *code < 1'000'000) {
      datum.vertical = Vertical::kEpsg;
      datum.epsg = static_cast<int>(*code);
      return datum;
    }
  }
  return fail(ErrorKind::kUsage,
              fmt::format("--vertical {}: give auto, egm96, egm2008, ellipsoid, none, or EPSG: and the number of a "
                          "vertical CRS",
                          text));
}

/// "1737400,1737400".
Result<Geodetic> parse_ellipsoid(const std::string& text) {
  const std::size_t comma = text.find(',');
  SCARP_TRY(const double a, parse_number("--ellipsoid", text.substr(0, comma)));
  SCARP_TRY(const double b, comma == std::string::npos ? a : parse_number("--ellipsoid", text.substr(comma + 1)));
  if (!(a >= 10'000) || !(a <= 1e9) || !(b <= a) || !(b >= a / 2))
    return fail(
        ErrorKind::kUsage,
        fmt::format("--ellipsoid {} is no ellipsoid of a planet: give its radius at the equator and that to the "
                    "poles in metres, as 3396190,3376200",
                    text));
  Geodetic ellipsoid;
  ellipsoid.semi_major = a;
  ellipsoid.inverse_flattening = a == b ? 0 : a / (a - b);
  return ellipsoid;
}

}  // namespace

Result<std::optional<DegreeBox>> parse_box(const Given& text) {
  if (!text) return std::optional<DegreeBox>();
  std::array<double, 4> sides{};
  std::size_t count = 0;
  for (std::size_t at = 0; at <= text->size(); ++count) {
    const std::size_t end = std::min(text->find(',', at), text->size());
    if (count < sides.size()) {
      SCARP_TRY(sides[count], parse_number("--only", text->substr(at, end - at)));
    }
    at = end + 1;
  }
  DegreeBox box{sides[0], sides[1], sides[2], sides[3]};
  if (box.east < box.west && box.west <= 180 && box.east >= -180) box.east += 360;
  if (count != sides.size() || !(box.east >= box.west) || !(box.north >= box.south) || box.east - box.west > 360)
    return fail(ErrorKind::kUsage,
                fmt::format("--only {}: give west, south, east and north in degrees, as 8.2,46.5,8.9,47", *text));
  return std::optional(box);
}

Result<GridKind> parse_grid(const std::string& text, bool takes_local) {
  return takes_local ? choose("--grid", text, kGrids) : choose("--grid", text, kGlobeGrids);
}

std::string vertical_word(const std::string& text) {
  if (text == fmt::format("EPSG:{}", kEgm96Code)) return "egm96";
  return text == fmt::format("EPSG:{}", kEgm2008) ? "egm2008" : text;
}

void TileArguments::add_nodes_to(CLI::App& command) {
  add_option(command, OptionId::kBand, raster.band);
  add_numbers(command, OptionId::kExtent, raster.extent, 4);
  add_option(command, OptionId::kResolution, raster.resolution);
  add_option(command, OptionId::kDecode, raster.decode);
  add_option(command, OptionId::kZScale, raster.z_scale);
  add_option(command, OptionId::kZOffset, raster.z_offset);
  add_option(command, OptionId::kZUnit, raster.z_unit);
  if (command.get_name() != "serve") add_option(command, OptionId::kCellSize, raster.cell_size);
  add_option(command, OptionId::kVertical, vertical);
  add_option(command, OptionId::kGeoid, geoid);
  add_option(command, OptionId::kEllipsoid, ellipsoid);
  add_option(command, OptionId::kCells, cells);
  add_option(command, OptionId::kNodata, raster.nodata);
  add_option(command, OptionId::kNodataPolicy, nodata_policy);
  add_option(command, OptionId::kFillDistance, fill_distance);
  add_option(command, OptionId::kBackground, background);
}

void TileArguments::add_to(CLI::App& command) {
  if (command.get_name() != "serve") {
    add_option(command, OptionId::kBound, bound);
    add_option(command, OptionId::kOf, format);
    add_option(command, OptionId::kDrape, drape);
    add_option(command, OptionId::kDrapeFormat, drape_format);
  }
  add_nodes_to(command);
  add_option(command, OptionId::kEffort, effort);
  add_option(command, OptionId::kMaxError, max_error);
  add_option(command, OptionId::kQuality, quality);
  add_option(command, OptionId::kZoom, zoom);
  add_option(command, OptionId::kGrid, grid);
  add_option(command, OptionId::kWater, water);
  add_flag(command, OptionId::kWaterMask, has_water_mask);
  add_option(command, OptionId::kWaterPercentile, percentile);
  add_option(command, OptionId::kRivers, rivers);
  add_option(command, OptionId::kMaxTileBytes, max_tile_bytes);
  add_option(command, OptionId::kBreaklines, breaklines);
  if (command.get_name() != "serve") add_option(command, OptionId::kOnly, only);
}

Result<PyramidSettings> TileArguments::parse_settings() const {
  PyramidSettings settings;
  settings.effort = default_effort;
  if (max_error) {
    SCARP_TRY(const double error, parse_number("--max-error", *max_error));
    if (!(error > 0)) return fail(ErrorKind::kUsage, fmt::format("--max-error {} must be above 0", *max_error));
    settings.max_error = error;
  }
  if (quality) {
    SCARP_TRY(settings.quality, parse_number("--quality", *quality));
  }
  if (zoom) {
    SCARP_TRY(const std::uint64_t level, parse_count("--zoom", *zoom, 0));
    settings.max_zoom = static_cast<int>(std::min<std::uint64_t>(level, kMaxTileLevel + 1));
  }
  if (max_tile_bytes) {
    SCARP_TRY(const std::uint64_t bytes, parse_bytes("--max-tile-bytes", *max_tile_bytes));
    if (bytes == 0) return fail(ErrorKind::kUsage, "--max-tile-bytes 0 holds no tile: give 1 or more, such as 20k");
    settings.max_tile_bytes = bytes;
  }
  SCARP_TRY(const bool binds, choose("--bound", bound.value_or("nodes"), kBounds));
  settings.binds_samples = binds;
  if (binds) settings.cells *= 2;
  if (cells) {
    SCARP_TRY(settings.cells, choose("--cells", *cells, kCellWords));
  }
  if (effort) {
    SCARP_TRY(settings.effort, choose("--effort", *effort, kTileEfforts));
  }
  if (background) {
    SCARP_TRY(const double height, parse_number("--background", *background));
    settings.background = static_cast<float>(height);
  }
  SCARP_TRY(settings.only, parse_box(only));
  return settings;
}

Result<Datum> TileArguments::parse_datum() const {
  SCARP_TRY(Datum datum, parse_vertical(vertical.value_or("auto")));
  if (geoid) {
    datum.vertical = Vertical::kGeoid;
    datum.geoid = *geoid;
  }
  if (ellipsoid) {
    SCARP_TRY(datum.ellipsoid, parse_ellipsoid(*ellipsoid));
  }
  return datum;
}

Result<ReadOptions> TileArguments::parse_reading() const {
  SCARP_TRY(ReadOptions options, raster.parse());
  SCARP_TRY(const TileNodata policy, choose("--nodata-policy", nodata_policy.value_or("voids"), kTileNodata));
  SCARP_TRY(options.fill_distance, parse_fill_distance(fill_distance, policy == TileNodata::kFill));
  if (policy == TileNodata::kVoids) options.void_side = kVoidSide;
  return options;
}

Result<WaterFiles> TileArguments::parse_waters() const {
  WaterFiles files{water, rivers};
  if (has_water_mask && water.empty())
    return fail(ErrorKind::kUsage, "--watermask needs --water: it shows the lakes that are given there");
  if (!percentile) return files;
  if (water.empty()) return fail(ErrorKind::kUsage, "--water-percentile needs --water: there is no lake without");
  SCARP_TRY(const double share, parse_non_negative("--water-percentile", *percentile));
  if (share > 100)
    return fail(ErrorKind::kUsage, fmt::format("--water-percentile {} is above 100", shell_word(*percentile)));
  files.percentile = share;
  return files;
}

Result<std::optional<TileDrape>> TileArguments::parse_drape() const {
  SCARP_TRY(const ImageFormat image, parse_image_format(drape_format));
  if (drape_format && !drape) return fail(ErrorKind::kUsage, "--drape-format needs an image: --drape FILE");
  if (!drape) return std::optional<TileDrape>();
  return std::optional(stamp_drape(*drape, image));
}

Result<std::optional<GridKind>> TileArguments::parse_kind() const {
  if (!grid) return std::optional<GridKind>();
  SCARP_TRY(const GridKind given, parse_grid(*grid, takes_local));
  return std::optional(given);
}

Result<TileFormat> TileArguments::parse_format(std::optional<GridKind> grid_of_tiles) const {
  const char* const by_default = grid_of_tiles == GridKind::kLocal ? "3dtiles" : "qm";
  return choose("--of", format.value_or(by_default), kTileFormats);
}

}  // namespace scarp::cli
