// Several rasters of one grid as one virtual raster.
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

/// The metadata of a raster about one of its bands.
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
  std::string path, name;  ///< path as given, and name in GDAL
  Crs crs;
  SpaceCrs space;
  std::array<double, 6> gt{0, 1, 0, 0, 0, 1};
  int cols = 0, rows = 0, block_cols = 0, block_rows = 0;
  int from_col = 0, from_row = 0;  ///< it is a part of a raster, from there on
  int all_cols = 0, all_rows = 0;  ///< size of that raster
  std::vector<BandFacts> bands;
  std::optional<std::pair<int, int>> gap;  ///< result of find_wide_gap()
  int mask_flags = 0;                      ///< GDALGetMaskFlags() of band 1
  std::int64_t col = 0, row = 0;           ///< position of its first cell, from that of the first raster

  /// A mask that holds more than a band's nodata value or an alpha band does. `asked`: a nodata value from outside
  /// replaces all that are declared.
  bool has_mask(bool asked) const;
  bool has_alpha() const;
};

/// All of it. Without a geotransform, gt is GDAL's default.
Tile describe_raster(GDALDatasetH raster, const std::string& path);

/// False for numbers of 64 bits and complex ones, which GDAL joins with a loss.
bool can_join(GDALDataType type);

/// The virtual raster of all tiles: each is read by its own type, nodata value, mask, scale and offset. Where several
/// have a value, that of the last one counts; where none has, there is none. It repeats all other metadata of the first
/// raster. `nodata`: as of open_view(). REQUIRES: types that can_join(), equal numbers of bands.
Result<Dataset> join_tiles(Session& session, std::span<const Tile> tiles, std::optional<double> nodata);

/// The XML of a virtual raster of floats of one tile, in which NaN alone stands for what is no value.
std::string write_with_nan(const Tile& tile, std::optional<double> nodata);

}  // namespace scarp::gdal
