// Several rasters on one grid as one virtual raster.
#pragma once

#include <gdal.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/gdal/crs.h"
#include "io/gdal/earth_frame.h"
#include "io/gdal/open.h"

namespace scarp::gdal {

/// A raster's metadata about one of its bands.
struct BandFacts {
  GDALDataType type = GDT_Unknown;
  bool is_signed_byte = false;  ///< GDT_Byte that holds −128 … 127
  bool is_alpha = false;
  std::optional<double> nodata;
  double scale = 1, offset = 0;
  std::string unit;
};

/// A raster of a mosaic.
struct Tile {
  std::string path, name;  ///< path as given, and the name that GDAL uses
  Crs crs;
  SpaceCrs space;
  std::array<double, 6> gt{0, 1, 0, 0, 0, 1};
  int cols = 0, rows = 0, block_cols = 0, block_rows = 0;
  int from_col = 0, from_row = 0;  ///< first cell, if the tile is a part of a raster
  int all_cols = 0, all_rows = 0;  ///< size of the whole raster
  std::vector<BandFacts> bands;
  std::optional<std::pair<int, int>> gap;  ///< result of find_wide_gap()
  int mask_flags = 0;                      ///< GDALGetMaskFlags() of band 1
  std::int64_t col = 0, row = 0;           ///< position of the first cell relative to the first raster

  /// True if the tile has a mask other than a nodata value or an alpha band. `asked`: the options give a nodata value,
  /// which replaces declared ones.
  bool has_mask(bool asked) const;
  bool has_alpha() const;
};

/// The whole raster as a tile. Without a geotransform, gt is GDAL's default.
Tile describe_raster(GDALDatasetH raster, const std::string& path);

/// False for 64-bit and complex numbers, which GDAL joins with loss.
bool can_join(GDALDataType type);

/// The virtual raster of all tiles. Each tile keeps its own type, nodata value, mask, scale and offset. In overlaps,
/// the last valid tile is used. All other metadata are copied from the first raster. `nodata`: as in open_view().
/// REQUIRES: can_join() for all types, and equal numbers of bands.
Result<Dataset> join_tiles(Session& session, std::span<const Tile> tiles, std::optional<double> nodata);

/// The XML of a virtual float raster of one tile, in which only NaN is nodata.
std::string write_with_nan(const Tile& tile, std::optional<double> nodata);

}  // namespace scarp::gdal
