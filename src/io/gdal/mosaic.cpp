#include "io/gdal/mosaic.h"

#include <cpl_string.h>
#include <cpl_vsi.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

#include "io/commands.h"
#include "io/gdal/crs.h"
#include "io/gdal/earth_frame.h"
#include "io/gdal/join.h"
#include "scarp/io.h"

namespace scarp::gdal {
namespace {

constexpr double kMostOffGrid = 1e-3;  // share of a cell

/// A command that creates a new file from the raster. Cells outside it become nodata rather than 0.
std::string gdalwarp(const std::string& options, const Tile& tile) {
  const BandFacts& band = tile.bands.front();
  const bool tells = band.nodata || tile.has_mask(false) || tile.has_alpha() || tile.bands.size() > 1;
  const char* wide = band.type == GDT_Int32 || band.type == GDT_UInt32 ? " -ot Float64" : " -ot Float32";
  return fmt::format("(gdalwarp {}{} {} {})", options,
                     tells ? "" : std::string(GDALDataTypeIsFloating(band.type) ? "" : wide) + " -dstnodata nan",
                     io::file_word(tile.path), io::new_file(".tif"));
}

/// A command that copies the raster with new metadata, since many formats accept no later changes.
std::string edit_command(const std::string& options, const std::string& path) {
  return fmt::format("{} && gdal_edit.py {} {}", io::translate_command("", path), options, io::new_file(".tif"));
}

Result<Tile> look_at(Session& session, const std::string& path) {
  SCARP_TRY(const auto& dataset, open_raster(session, path));
  GDALDatasetH raster = dataset.get();
  Tile tile = describe_raster(raster, path);
  tile.gap = find_wide_gap(raster);
  if (GDALGetGeoTransform(raster, tile.gt.data()) != CE_None) {
    return fail(ErrorKind::kInput,
                path + ": has no georeference, so that it has no place in a mosaic: name the other rasters one by one");
  }
  if (tile.gt[2] != 0 || tile.gt[4] != 0) {
    return fail(ErrorKind::kInput,
                fmt::format("{}: is rotated, so that it has no place in a mosaic: turn it first ({})", path,
                            io::warp_command("", path)));
  }
  return tile;
}

/// Metres per unit of heights; 0 for other units, or none.
double metres_in(const std::string& unit) {
  std::string word;
  for (const char c : unit) word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const char* metre : {"m", "metre", "metres", "meter", "meters"}) {
    if (word == metre) return 1;
  }
  const auto has = [&](const char* part) { return word.find(part) != std::string::npos; };
  if (!has("ft") && !has("foot") && !has("feet")) return 0;
  return has("us") || has("survey") ? 1200.0 / 3937 : 0.3048;
}

/// An unnamed unit means metres.
bool same_unit(const std::string& a, const std::string& b) {
  const auto metres = [](const std::string& unit) { return unit.empty() ? 1 : metres_in(unit); };
  return a == b || (metres(a) == metres(b) && metres(a) != 0);
}

std::string describe_unit_difference(const Tile& first, const Tile& tile, std::size_t k) {
  const BandFacts &a = first.bands[k], &b = tile.bands[k];
  if (a.unit.empty() || b.unit.empty()) {
    const Tile& without = b.unit.empty() ? tile : first;
    const std::string &named = b.unit.empty() ? a.unit : b.unit, says = "heights in " + named;
    return fmt::format("has {}, and {} {}: if {} has the same unit, declare it first ({})",
                       b.unit.empty() ? "no unit" : says, first.path, a.unit.empty() ? "no unit" : says, without.path,
                       edit_command("-units " + io::file_word(named), without.path));
  }
  const double ratio = metres_in(a.unit) == 0 ? 0 : metres_in(b.unit) / metres_in(a.unit);
  const std::string way =
      ratio == 0 ? "give rasters of one unit"
                 : fmt::format("bring it to one unit first ({})",
                               edit_command(fmt::format("-scale {:.17g} -offset {:.17g} -units {}", b.scale * ratio,
                                                        b.offset * ratio, io::file_word(a.unit)),
                                            tile.path));
  return fmt::format("has heights in {}, and {} in {}: {}", b.unit, first.path, a.unit, way);
}

/// The reference of heights, from the CRS.
std::string heights_of(const Tile& tile) { return tile.space.is_ellipsoidal ? "the ellipsoid" : tile.space.vertical; }

/// Advice to convert the raster, with its heights, to the CRS of the first raster.
std::string bring_there(const Tile& first, const Tile& tile) {
  const std::string from = heights_of(tile), to = heights_of(first);
  const std::string with_heights = from.empty() || to.empty() ? "" : name_with_heights(first.space.crs);
  // Without PROJ's grid, gdalwarp silently keeps heights unchanged.
  if (from != to && !from.empty() && !to.empty() &&
      (with_heights.empty() || !Passage(tile.space.crs, first.space.crs, true).usable()))
    return "PROJ knows no way between their heights on this machine: install its grids (projsync, or Debian's "
           "proj-data), or give rasters of one vertical datum";
  const std::string crs = io::file_word(with_heights.empty() ? crs_name(first.crs) : with_heights);
  return "bring it there first " + gdalwarp(fmt::format("-t_srs {} -r bilinear", crs), tile);
}

std::string describe_datum_difference(const Tile& first, const Tile& tile) {
  const std::string a = heights_of(first), b = heights_of(tile);
  const auto say = [](const std::string& datum) {
    return datum.empty() ? "no vertical datum" : "heights above " + datum;
  };
  const Tile& named = a.empty() ? tile : first;
  const Tile& other = a.empty() ? first : tile;
  std::string way = "give rasters of one vertical datum";
  if (!a.empty() && !b.empty()) {
    way = bring_there(first, tile);
  } else if (const std::string crs = name_with_heights(named.space.crs); !crs.empty()) {
    way = fmt::format("if {} has the same, declare it first ({})", other.path,
                      io::translate_command("-a_srs " + io::file_word(crs), other.path));
  }
  return fmt::format("has {}, and {} {}: {}", say(b), first.path, say(a), way);
}

/// A whole turn around the earth in units of x; 0 if x is not periodic.
double turn_of(const Crs& crs) {
  if (!crs) return 0;
  constexpr double kTurn = 2 * std::numbers::pi;
  if (OSRIsGeographic(crs.get()) != 0) return kTurn / OSRGetAngularUnits(crs.get(), nullptr);
  return crs_name(crs) == "EPSG:3857" ? kTurn * OSRGetSemiMajor(crs.get(), nullptr) : 0;
}

/// Distance from an integer.
double off_whole(double number) { return std::abs(number - std::round(number)); }

/// The difference and its remedy, as the second half of a sentence; empty if none.
std::string find_difference(const Tile& first, const Tile& tile) {
  if (!first.crs != !tile.crs || (tile.crs && !same_crs(first.crs, tile.crs))) {
    const auto name = [](const Tile& of) { return of.crs ? short_name(of.crs) : std::string("no CRS"); };
    if (!tile.crs || !first.crs) {
      const Tile& without = tile.crs ? first : tile;
      return fmt::format(
          "is in {}, and {} in {}: if {} is in the same, name it first ({})", name(tile), first.path, name(first),
          without.path,
          io::translate_command("-a_srs " + io::file_word(crs_name((tile.crs ? tile : first).crs)), without.path));
    }
    return fmt::format("is in {}, and {} in {}: {}", name(tile), first.path, name(first), bring_there(first, tile));
  }
  if (heights_of(first) != heights_of(tile)) return describe_datum_difference(first, tile);
  if (tile.bands.size() != first.bands.size()) {
    return fmt::format("has {} bands, and {} has {}: choose one of the bands first ({})", tile.bands.size(), first.path,
                       first.bands.size(), io::translate_command("-b 1", (tile.bands.size() > 1 ? tile : first).path));
  }
  for (std::size_t k = 0; k < tile.bands.size(); ++k) {
    const BandFacts &a = first.bands[k], &b = tile.bands[k];
    const Tile& hard = can_join(b.type) ? first : tile;
    if (!can_join(hard.bands[k].type))
      return fmt::format("and {} make no mosaic, since {} holds {}: give it another type first ({})", first.path,
                         hard.path, GDALGetDataTypeName(hard.bands[k].type),
                         io::translate_command("-ot Float64", hard.path));
    if (a.is_alpha != b.is_alpha) {
      return fmt::format(
          "and {} make no mosaic, since band {} is transparency in one of them alone: give rasters of one "
          "kind",
          first.path, k + 1);
    }
    if (!same_unit(a.unit, b.unit)) return describe_unit_difference(first, tile, k);
  }
  const double dx = first.gt[1], dy = first.gt[5];
  if (dx * tile.gt[1] < 0 || dy * tile.gt[5] < 0) {
    const Tile& turned = tile.gt[1] < 0 || tile.gt[5] > 0 ? tile : first;
    return fmt::format("and {} begin at different sides: make {} north up first {}", first.path, turned.path,
                       fmt::format("(gdalwarp {} {})", io::file_word(turned.path), io::new_file(".tif")));
  }
  const double size = std::max(std::abs(tile.gt[1] - dx) * std::max(tile.cols, first.cols) / std::abs(dx),
                               std::abs(tile.gt[5] - dy) * std::max(tile.rows, first.rows) / std::abs(dy));
  const double col = (tile.gt[0] - first.gt[0]) / dx, row = (tile.gt[3] - first.gt[3]) / dy;
  const double off = std::max(off_whole(col), off_whole(row));
  if (size <= kMostOffGrid && off <= kMostOffGrid) return "";
  const double west = first.gt[0] + std::floor(col + kMostOffGrid) * dx;
  const double north = first.gt[3] + std::floor(row + kMostOffGrid) * dy;
  const double cols = std::ceil(tile.cols * tile.gt[1] / dx + kMostOffGrid);
  const double rows = std::ceil(tile.rows * tile.gt[5] / dy + kMostOffGrid);
  const auto [low, high] = std::minmax({north, north + rows * dy});
  const std::string to_grid =
      gdalwarp(fmt::format("-tr {:.17g} {:.17g} -te {:.17g} {:.17g} {:.17g} {:.17g} -r bilinear", std::abs(dx),
                           std::abs(dy), std::min(west, west + cols * dx), low, std::max(west, west + cols * dx), high),
               tile);
  if (size > kMostOffGrid)
    return fmt::format("has cells of {:.10g} x {:.10g}, and {} of {:.10g} x {:.10g}: bring it to that grid first {}",
                       std::abs(tile.gt[1]), std::abs(tile.gt[5]), first.path, std::abs(dx), std::abs(dy), to_grid);
  return fmt::format("lies {:.3g} of a cell beside the grid of {}: bring it to that grid first {}", off, first.path,
                     to_grid);
}

/// True if two rasters store heights in the same way. Rasters that differ are interpolated separately.
bool hold_alike(const Tile& first, const Tile& tile) {
  return std::equal(first.bands.begin(), first.bands.end(), tile.bands.begin(), tile.bands.end(),
                    [](const BandFacts& a, const BandFacts& b) {
                      const bool both_nan = a.nodata && b.nodata && std::isnan(*a.nodata) && std::isnan(*b.nodata);
                      return a.type == b.type && a.scale == b.scale && a.offset == b.offset &&
                             (a.nodata == b.nodata || both_nan);
                    });
}

/// The widest gap between arcs on a circle. An arc is given by its start in [0, turn) and its length.
struct Gap {
  double end = 0, width = 0;
};
Gap find_gap(std::vector<std::pair<double, double>> arcs, double turn) {
  std::sort(arcs.begin(), arcs.end());
  Gap gap;
  double before = -HUGE_VAL;  // largest end of the previous arcs; at first, of all arcs minus a turn
  for (const auto& [from, length] : arcs) before = std::max(before, from + length - turn);
  for (const auto& [from, length] : arcs) {
    if (from - before > gap.width) gap = {from, from - before};
    before = std::max(before, from + length);
  }
  return gap;
}

/// Finds the cells of each tile relative to the first tile. If x is periodic, tiles on both sides of its end are placed
/// next to each other. True if a tile was moved.
Result<bool> place_tiles(std::vector<Tile>& tiles) {
  constexpr double kCloser = 0.75;
  const std::array<double, 6>& gt = tiles.front().gt;
  const double turn = turn_of(tiles.front().crs) / std::abs(gt[1]);
  std::vector<double> cols;
  std::vector<std::pair<double, double>> arcs;
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (Tile& tile : tiles) {
    const double col = (tile.gt[0] - gt[0]) / gt[1];
    cols.push_back(col);
    low = std::min(low, col);
    high = std::max(high, col + tile.cols);
    if (turn > 0) arcs.emplace_back(col - turn * std::floor(col / turn), tile.cols);
    tile.col = std::llround(col);
    tile.row = std::llround((tile.gt[3] - gt[3]) / gt[5]);
  }
  const Gap gap = turn > 0 ? find_gap(std::move(arcs), turn) : Gap{};
  if (gap.width <= 0 || turn - gap.width > kCloser * (high - low)) return false;
  const double west = gt[0] + gap.end * gt[1], around = turn * gt[1];  // starts within half a turn of x = 0
  const double begin = gap.end - turn * std::floor((west + around / 2) / around + kMostOffGrid / turn);
  for (std::size_t k = 0; k < tiles.size(); ++k) {
    Tile& tile = tiles[k];
    const double moved = cols[k] - turn * std::floor((cols[k] - begin + 0.5) / turn);
    if (off_whole(moved) > kMostOffGrid) {
      const double x = gt[0] + std::round(moved) * gt[1];
      return fail(
          ErrorKind::kInput,
          fmt::format(
              "{} lies on the other side of the end of x, and once around the earth {:.3g} of a cell beside "
              "the grid: move it first ({})",
              tile.path, off_whole(moved),
              io::translate_command(fmt::format("-a_ullr {:.17g} {:.17g} {:.17g} {:.17g}", x, tile.gt[3],
                                                x + tile.cols * tile.gt[1], tile.gt[3] + tile.rows * tile.gt[5]),
                                    tile.path)));
    }
    tile.col = std::llround(moved);
  }
  return true;
}

Tile part_of(const Tile& tile, int from, int to) {
  Tile part;
  part.path = tile.path;
  part.name = tile.name;
  part.crs.reset(tile.crs ? OSRClone(tile.crs.get()) : nullptr);
  part.gt = tile.gt;
  part.gt[0] += from * tile.gt[1];
  part.cols = to - from;
  part.rows = tile.rows;
  part.block_cols = tile.block_cols;
  part.block_rows = tile.block_rows;
  part.from_col = from;
  part.all_cols = tile.all_cols;
  part.all_rows = tile.all_rows;
  part.bands = tile.bands;
  part.mask_flags = tile.mask_flags;
  return part;
}

/// Splits rasters that have a wide gap between their two sides.
void split_at_gaps(std::vector<Tile>& tiles) {
  std::vector<Tile> parts;
  for (Tile& tile : tiles) {
    if (!tile.gap) {
      parts.push_back(std::move(tile));
      continue;
    }
    parts.push_back(part_of(tile, 0, tile.gap->first));
    parts.push_back(part_of(tile, tile.gap->second, tile.cols));
  }
  tiles = std::move(parts);
}

constexpr const char *kMadeKey = "SCARP_ROLE", *kMade = "derived";
/// Metadata of tile sets in MBTiles, which GDAL opens as rasters.
constexpr const char *kGeneratorKey = "generator", *kScarp = "scarp ";

/// Removes rasters that Scarp derived from the others; the rest keep their order. Returns the removed names, without
/// folders.
std::vector<std::string> take_derived(const std::vector<bool>& is_derived, std::vector<std::string>& rasters) {
  std::vector<std::string> kept, left;
  for (std::size_t k = 0; k < rasters.size(); ++k) (is_derived[k] ? left : kept).push_back(rasters[k]);
  if (kept.empty() || left.empty()) return {};
  rasters = std::move(kept);
  for (std::string& name : left) name = CPLGetFilename(name.c_str());
  return left;
}

}  // namespace

bool mark_derived(GDALDatasetH raster) { return GDALSetMetadataItem(raster, kMadeKey, kMade, nullptr) == CE_None; }

bool is_derived(GDALDatasetH raster) {
  const char* made = GDALGetMetadataItem(raster, kMadeKey, nullptr);
  const char* generator = GDALGetMetadataItem(raster, kGeneratorKey, nullptr);
  return (made != nullptr && EQUAL(made, kMade)) ||
         (generator != nullptr && std::string_view(generator).starts_with(kScarp));
}

Result<std::vector<std::string>> expand_folders(Session& session, const std::vector<std::string>& paths,
                                                std::vector<std::string>& left_out) {
  std::vector<std::string> all;
  for (const std::string& path : paths) {
    VSIStatBufL status{};
    const std::string vsi = vsi_path(path);
    const bool is_folder =
        VSIStatL(vsi.c_str(), &status) == 0 && VSI_ISDIR(status.st_mode) && !open_raster(session, path);
    session.clear();
    if (!is_folder) {
      all.push_back(path);
      continue;
    }
    const CPLStringList entries(VSIReadDir(vsi.c_str()));
    std::vector<std::string> names, rasters;
    std::vector<bool> are_derived;
    for (int k = 0; k < entries.size(); ++k) names.push_back(CPLFormFilename(vsi.c_str(), entries[k], nullptr));
    std::sort(names.begin(), names.end());
    for (const std::string& name : names) {
      if (VSIStatL(name.c_str(), &status) != 0 || !VSI_ISREG(status.st_mode)) continue;
      const auto dataset = open_raster(session, name);
      if (!dataset) continue;
      rasters.push_back(name);
      are_derived.push_back(is_derived(dataset->get()));
    }
    session.clear();
    if (rasters.empty()) return fail(ErrorKind::kInput, path + ": the folder holds no raster, and no LAS or LAZ file");
    for (std::string& name : take_derived(are_derived, rasters)) left_out.push_back(std::move(name));
    all.insert(all.end(), rasters.begin(), rasters.end());
  }
  return all;
}

std::optional<std::pair<int, int>> find_wide_gap(GDALDatasetH raster) {
  constexpr int kStrips = 64, kLeast = kStrips / 4;
  std::array<double, 6> gt{};
  const int cols = GDALGetRasterXSize(raster), rows = GDALGetRasterYSize(raster);
  if (cols < kStrips || GDALGetGeoTransform(raster, gt.data()) != CE_None || gt[2] != 0 || gt[4] != 0) return {};
  const double turn = turn_of(crs_of(raster)) / std::abs(gt[1]);
  if (turn == 0 || cols < 0.75 * turn || cols > turn + 1) return {};
  GDALRasterBandH band = GDALGetRasterBand(raster, 1);
  const auto is_empty = [&](int from, int to) {
    return GDALGetDataCoverageStatus(band, from, 0, to - from, rows, 0, nullptr) == GDAL_DATA_COVERAGE_STATUS_EMPTY;
  };
  const auto start = [&](int strip) { return static_cast<int>(std::int64_t{cols} * strip / kStrips); };
  int first = 0, end = 0;
  for (int strip = 0, begin = 0; strip < kStrips; ++strip) {
    if (!is_empty(start(strip), start(strip + 1))) begin = strip + 1;
    if (strip + 1 - begin > end - first) std::tie(first, end) = std::pair{begin, strip + 1};
  }
  if (end - first < kLeast || first == 0 || end == kStrips) return {};
  int low = start(first - 1), left = start(first), right = start(end), high = start(end + 1);
  for (int middle = 0; left - low > 1;) {
    middle = (low + left) / 2;
    (is_empty(middle, left) ? left : low) = middle;
  }
  for (int middle = 0; high - right > 1;) {
    middle = (right + high) / 2;
    (is_empty(right, middle) ? right : high) = middle;
  }
  return std::pair{left, right};
}

Result<Dataset> open_mosaic(Session& session, const std::vector<std::string>& paths, std::optional<double> nodata,
                            std::string& words) {
  std::vector<Tile> tiles;
  for (const std::string& path : paths) {
    SCARP_TRY(auto&& tile, look_at(session, path));
    tiles.push_back(std::move(tile));
    const std::string difference = find_difference(tiles.front(), tiles.back());
    if (!difference.empty()) return fail(ErrorKind::kInput, fmt::format("{} {}", path, difference));
  }
  split_at_gaps(tiles);
  SCARP_TRY(const auto& is_moved, place_tiles(tiles));
  if (paths.size() > 1) words = fmt::format("mosaic of {} rasters", paths.size());
  if (is_moved) words += fmt::format("{}both ends of x side by side", words.empty() ? "" : ", ");
  return join_tiles(session, tiles, nodata);
}

}  // namespace scarp::gdal

namespace scarp {

std::vector<std::vector<std::string>> find_mosaics(const std::vector<std::string>& paths) {
  gdal::Session session;
  std::vector<std::string> left_out;
  const auto rasters = gdal::expand_folders(session, paths, left_out);
  if (!rasters) return {paths};
  if (rasters->size() < 2) return {*rasters};
  std::vector<std::vector<std::string>> mosaics;
  std::optional<gdal::Tile> first;  // first raster of the last mosaic
  for (const std::string& path : *rasters) {
    auto tile = gdal::look_at(session, path);
    if (first && tile && gdal::hold_alike(*first, *tile) && gdal::find_difference(*first, *tile).empty()) {
      mosaics.back().push_back(path);
      continue;
    }
    mosaics.push_back({path});
    first.reset();
    if (tile) first = std::move(*tile);
  }
  return mosaics;
}

}  // namespace scarp
