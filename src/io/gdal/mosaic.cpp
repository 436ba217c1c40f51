#include "io/gdal/mosaic.h"

#include <cpl_string.h>
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <gdal_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <string_view>

#include "io/gdal/crs.h"
#include "io/gdal/earth_frame.h"
#include "scarp/tile_job.h"

namespace scarp::gdal {
namespace {

constexpr double kMostOffGrid = 1e-3;  // of a cell

/// What rasters of one mosaic have in common, and where each lies.
struct Tile {
  std::string path, name;
  Crs crs;
  std::array<double, 6> gt{};
  int cols = 0, rows = 0, bands = 0;
  GDALDataType type = GDT_Unknown;
  std::string nodata, scale;  // words, to compare and to say
  std::string heights;        // what they are above, as the CRS says
  bool has_holes = false;     // an alpha band, a mask or a nodata value tells where it has no value
};

std::string gdalwarp(const std::string& options, const Tile& tile) {
  return fmt::format("(gdalwarp {} {} {}.tif)", options, tile.path, "new");
}

Result<Tile> look_at(Session& session, const std::string& path) {
  const auto dataset = open_raster(session, path);
  if (!dataset) return tl::unexpected(dataset.error());
  GDALDatasetH raster = dataset->get();
  Tile tile;
  tile.path = path;
  tile.name = GDALGetDescription(raster);
  tile.crs = crs_of(raster);
  const SpaceCrs space = space_crs_of(raster);
  tile.heights = space.is_ellipsoidal ? "the ellipsoid" : space.vertical;
  tile.cols = GDALGetRasterXSize(raster);
  tile.rows = GDALGetRasterYSize(raster);
  tile.bands = GDALGetRasterCount(raster);
  if (GDALGetGeoTransform(raster, tile.gt.data()) != CE_None) {
    return fail(ErrorKind::kInput,
                path + ": has no georeference, so that it has no place in a mosaic: name the other rasters one by one");
  }
  if (tile.gt[2] != 0 || tile.gt[4] != 0) {
    return fail(ErrorKind::kInput, fmt::format("{}: is rotated, so that it has no place in a mosaic: turn it first {}",
                                               path, gdalwarp("-r bilinear", tile)));
  }
  GDALRasterBandH band = GDALGetRasterBand(raster, 1);
  tile.type = GDALGetRasterDataType(band);
  int has_nodata = 0;
  const double nodata = GDALGetRasterNoDataValue(band, &has_nodata);
  if (has_nodata != 0) tile.nodata = fmt::format("{:.17g}", nodata);
  tile.has_holes = GDALGetMaskFlags(band) != GMF_ALL_VALID;
  tile.scale = fmt::format("scale {:.17g} and offset {:.17g}", GDALGetRasterScale(band, nullptr),
                           GDALGetRasterOffset(band, nullptr));
  return tile;
}

/// "" or the second half of a sentence: how it differs, and the way out.
std::string find_difference(const Tile& first, const Tile& tile) {
  if (!first.crs != !tile.crs || (tile.crs && !same_crs(first.crs, tile.crs))) {
    const auto name = [](const Tile& of) { return of.crs ? short_name(of.crs) : std::string("no CRS"); };
    if (!tile.crs || !first.crs) {
      const Tile& without = tile.crs ? first : tile;
      return fmt::format("is in {}, and {} in {}: if {} is in the same, say so first (gdal_edit.py -a_srs {} {})",
                         name(tile), first.path, name(first), without.path, name(tile.crs ? tile : first),
                         without.path);
    }
    return fmt::format("is in {}, and {} in {}: bring it there first {}", name(tile), first.path, name(first),
                       gdalwarp(fmt::format("-t_srs {} -r bilinear", name(first)), tile));
  }
  if (tile.bands != first.bands)
    return fmt::format("has {} bands, and {} has {}: give rasters of one kind", tile.bands, first.path, first.bands);
  if (tile.type != first.type)
    return fmt::format("holds {}, and {} {}: give it the same type first (gdal_translate -ot {} {} new.tif)",
                       GDALGetDataTypeName(tile.type), first.path, GDALGetDataTypeName(first.type),
                       GDALGetDataTypeName(first.type), tile.path);
  if (tile.nodata != first.nodata) {
    const auto say = [](const std::string& of) { return of.empty() ? "no nodata value" : "the nodata value " + of; };
    return fmt::format("has {}, and {} has {}: give both the same first {}", say(tile.nodata), first.path,
                       say(first.nodata),
                       gdalwarp("-dstnodata " + (first.nodata.empty() ? tile.nodata : first.nodata),
                                first.nodata.empty() ? first : tile));
  }
  if (tile.scale != first.scale)
    return fmt::format("has {}, and {} has {}: apply them first (gdal_translate -unscale -ot Float32 {} new.tif)",
                       tile.scale, first.path, first.scale, tile.path);
  const double dx = first.gt[1], dy = first.gt[5];
  const double size = std::max(std::abs(tile.gt[1] - dx) * std::max(tile.cols, first.cols) / std::abs(dx),
                               std::abs(tile.gt[5] - dy) * std::max(tile.rows, first.rows) / std::abs(dy));
  const double col = (tile.gt[0] - first.gt[0]) / dx, row = (tile.gt[3] - first.gt[3]) / dy;
  const double off = std::max(std::abs(col - std::round(col)), std::abs(row - std::round(row)));
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

/// True if every cell of the rectangle around all tiles lies in one of them.
bool leave_no_gap(const std::vector<Tile>& tiles) {
  struct Box {
    std::int64_t left, top, right, bottom;
  };
  std::vector<Box> boxes;
  std::set<std::int64_t> xs, ys;
  for (const Tile& tile : tiles) {
    const auto left = std::llround((tile.gt[0] - tiles[0].gt[0]) / tiles[0].gt[1]);
    const auto top = std::llround((tile.gt[3] - tiles[0].gt[3]) / tiles[0].gt[5]);
    boxes.push_back({left, top, left + tile.cols, top + tile.rows});
    xs.insert({left, left + tile.cols});
    ys.insert({top, top + tile.rows});
  }
  const std::vector<std::int64_t> x(xs.begin(), xs.end()), y(ys.begin(), ys.end());
  const auto place = [](const std::vector<std::int64_t>& of, std::int64_t value) {
    return static_cast<std::size_t>(std::lower_bound(of.begin(), of.end(), value) - of.begin());
  };
  std::vector<bool> is_covered((x.size() - 1) * (y.size() - 1));
  for (const Box& box : boxes) {
    for (std::size_t j = place(y, box.top); j < place(y, box.bottom); ++j) {
      for (std::size_t i = place(x, box.left); i < place(x, box.right); ++i) is_covered[j * (x.size() - 1) + i] = true;
    }
  }
  return std::find(is_covered.begin(), is_covered.end(), false) == is_covered.end();
}

struct FreeOptions {
  void operator()(GDALBuildVRTOptions* options) const { GDALBuildVRTOptionsFree(options); }
};

constexpr const char *kMadeKey = "SCARP_ROLE", *kMade = "derived";
/// Of sets of tiles in MBTiles, which GDAL takes for rasters.
constexpr const char *kGeneratorKey = "generator", *kScarp = "scarp ";

/// Leaves out what Scarp made of the others, in the order of names; their names, without folders.
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
    if (rasters.empty()) return fail(ErrorKind::kInput, path + ": the folder holds no raster");
    for (std::string& name : take_derived(are_derived, rasters)) left_out.push_back(std::move(name));
    all.insert(all.end(), rasters.begin(), rasters.end());
  }
  return all;
}

Result<Dataset> open_mosaic(Session& session, const std::vector<std::string>& paths) {
  std::vector<Tile> tiles;
  for (const std::string& path : paths) {
    auto tile = look_at(session, path);
    if (!tile) return tl::unexpected(tile.error());
    tiles.push_back(std::move(*tile));
    const std::string difference = find_difference(tiles.front(), tiles.back());
    if (!difference.empty()) return fail(ErrorKind::kInput, fmt::format("{} {}", path, difference));
  }
  const bool tells_holes = std::all_of(tiles.begin(), tiles.end(), [](const Tile& tile) { return tile.has_holes; });
  const std::array<double, 6>& gt = tiles.front().gt;
  CPLStringList words;
  const std::string dx = fmt::format("{:.17g}", std::abs(gt[1])), dy = fmt::format("{:.17g}", std::abs(gt[5]));
  for (const char* word :
       {"-strict", "-allow_projection_difference", "-resolution", "user", "-tr", dx.c_str(), dy.c_str()})
    words.AddString(word);
  if (!tells_holes && !leave_no_gap(tiles)) words.AddString("-addalpha");
  const std::unique_ptr<GDALBuildVRTOptions, FreeOptions> options(GDALBuildVRTOptionsNew(words.List(), nullptr));
  CPLStringList names;
  for (const Tile& tile : tiles) names.AddString(tile.name.c_str());
  session.clear();
  int failed = 0;
  const Dataset built(GDALBuildVRT("", names.size(), nullptr, names.List(), options.get(), &failed));
  if (!built || failed != 0) {
    return fail(ErrorKind::kInput,
                fmt::format("{} and {} more make no mosaic: {}", paths.front(), paths.size() - 1, session.reason()));
  }
  return open_virtual(session, built.get(), paths.front());
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
  std::optional<gdal::Tile> first;  // of the last mosaic
  for (const std::string& path : *rasters) {
    auto tile = gdal::look_at(session, path);
    if (first && tile && first->heights == tile->heights && gdal::find_difference(*first, *tile).empty()) {
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
