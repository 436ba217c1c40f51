#include "session/options/tile_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "scarp/tile.h"
#include "session/options/image_options.h"
#include "session/options/memory_options.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

using enum OptionId;

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
    const Result<std::uint64_t> code =
        parse_count(fmt::format("{} {}", kVertical, kEpsg), text.substr(kEpsg.size()), 1);
    if (code && *code < 1'000'000) {
      datum.vertical = Vertical::kEpsg;
      datum.epsg = static_cast<int>(*code);
      return datum;
    }
  }
  return fail(
      ErrorKind::kUsage,
      fmt::format("{} {}: give auto, egm96, egm2008, ellipsoid, none, or EPSG: and the number of a vertical CRS",
                  kVertical, text));
}

/// Parses "1737400,1737400".
Result<Geodetic> parse_ellipsoid(const std::string& text) {
  const std::size_t comma = text.find(',');
  SCARP_TRY(const double a, parse_number(name_of(kEllipsoid), text.substr(0, comma)));
  SCARP_TRY(const double b, comma == std::string::npos ? a : parse_number(name_of(kEllipsoid), text.substr(comma + 1)));
  if (!(a >= 10'000) || !(a <= 1e9) || !(b <= a) || !(b >= a / 2))
    return fail(
        ErrorKind::kUsage,
        fmt::format("{} {} is no ellipsoid of a planet: give its radius at the equator and that to the poles in "
                    "metres, as 3396190,3376200",
                    kEllipsoid, text));
  Geodetic ellipsoid;
  ellipsoid.semi_major = a;
  ellipsoid.inverse_flattening = a == b ? 0 : a / (a - b);
  return ellipsoid;
}

}  // namespace

Result<std::optional<DegreeBox>> parse_box(const GivenOptions& given) {
  const Given& text = given[kOnly];
  if (!text) return std::optional<DegreeBox>();
  std::array<double, 4> sides{};
  std::size_t count = 0;
  for (std::size_t at = 0; at <= text->size(); ++count) {
    const std::size_t end = std::min(text->find(',', at), text->size());
    if (count < sides.size()) {
      SCARP_TRY(sides[count], parse_number(name_of(kOnly), text->substr(at, end - at)));
    }
    at = end + 1;
  }
  DegreeBox box{sides[0], sides[1], sides[2], sides[3]};
  if (box.east < box.west && box.west <= 180 && box.east >= -180) box.east += 360;
  if (count != sides.size() || !(box.east >= box.west) || !(box.north >= box.south) || box.east - box.west > 360)
    return fail(ErrorKind::kUsage,
                fmt::format("{} {}: give west, south, east and north in degrees, as 8.2,46.5,8.9,47", kOnly, *text));
  return std::optional(box);
}

Result<std::optional<GridKind>> parse_grid(const GivenOptions& given) {
  const bool accepts_local = (given.command() & (kTile | kTilePlan)) != 0;
  return accepts_local ? given.choice(kGrid, kGrids) : given.choice(kGrid, kGlobeGrids);
}

std::string vertical_word(const std::string& text) {
  if (text == fmt::format("EPSG:{}", kEgm96Code)) return "egm96";
  return text == fmt::format("EPSG:{}", kEgm2008) ? "egm2008" : text;
}

Result<PyramidSettings> parse_tile_settings(const GivenOptions& given) {
  PyramidSettings settings;
  SCARP_TRY(const auto error, given.number(kMaxError));
  settings.max_error = error.value_or(settings.max_error);
  SCARP_TRY(const auto quality, given.number(kQuality));
  settings.quality = quality.value_or(settings.quality);
  SCARP_TRY(const auto zoom, given.count(kZoom));
  if (zoom) settings.max_zoom = static_cast<int>(*zoom);
  if (given[kMaxTileBytes]) {
    SCARP_TRY(const std::uint64_t bytes, parse_bytes(name_of(kMaxTileBytes), *given[kMaxTileBytes]));
    if (bytes == 0)
      return fail(ErrorKind::kUsage, fmt::format("{} 0 holds no tile: give 1 or more, such as 20k", kMaxTileBytes));
    settings.max_tile_bytes = bytes;
  }
  SCARP_TRY(const auto binds, given.choice(kBound, kBounds));
  settings.binds_samples = binds.value_or(false);
  if (settings.binds_samples) settings.cells *= 2;
  SCARP_TRY(const auto cells, given.choice(kCells, kCellWords));
  settings.cells = cells.value_or(settings.cells);
  SCARP_TRY(const auto effort, given.choice(kEffort, kTileEfforts));
  settings.effort = effort.value_or(given.command() == kServe ? Effort::kFast : Effort::kNormal);
  SCARP_TRY(const auto background, given.number(kBackground));
  if (background) settings.background = static_cast<float>(*background);
  SCARP_TRY(settings.only, parse_box(given));
  return settings;
}

Result<Datum> parse_datum(const GivenOptions& given) {
  SCARP_TRY(Datum datum, parse_vertical(given[kVertical].value_or("auto")));
  if (given[kGeoid]) {
    datum.vertical = Vertical::kGeoid;
    datum.geoid = *given[kGeoid];
  }
  if (given[kEllipsoid]) {
    SCARP_TRY(datum.ellipsoid, parse_ellipsoid(*given[kEllipsoid]));
  }
  return datum;
}

Result<ReadOptions> parse_tile_reading(const GivenOptions& given) {
  SCARP_TRY(ReadOptions options, parse_reading(given));
  SCARP_TRY(const auto asked, given.choice(kNodataPolicy, kTileNodata));
  const TileNodata policy = asked.value_or(TileNodata::kVoids);
  SCARP_TRY(options.fill_distance, parse_fill_distance(given, policy == TileNodata::kFill));
  if (policy == TileNodata::kVoids) options.void_side = kVoidSide;
  return options;
}

Result<WaterFiles> parse_waters(const GivenOptions& given) {
  WaterFiles files{given.all(kWater), given.all(kRivers)};
  SCARP_TRY(const auto share, given.number(kWaterPercentile));
  files.percentile = share.value_or(files.percentile);
  return files;
}

Result<std::optional<TileDrape>> parse_tile_drape(const GivenOptions& given) {
  SCARP_TRY(const ImageFormat image, parse_image_format(given));
  if (!given[kDrape]) return std::optional<TileDrape>();
  return std::optional(stamp_drape(*given[kDrape], image));
}

Result<TileFormat> parse_tile_format(const GivenOptions& given, std::optional<GridKind> grid_of_tiles) {
  SCARP_TRY(const auto format, given.choice(kOf, kTileFormats));
  return format.value_or(grid_of_tiles == GridKind::kLocal ? TileFormat::kGlb : TileFormat::kQuantizedMesh);
}

}  // namespace scarp::cli
