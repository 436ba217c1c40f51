// Rasters read by GDAL, without GDAL's headers.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "scarp/io.h"

namespace scarp::io {

/// read_height_field() for formats without a reader here; may throw std::bad_alloc. In a build without GDAL it fails
/// with kInput and the reason.
Result<OwnedHeightField> read_gdal_raster(const std::string& path, const ReadOptions& options);

/// open_height_field() for these formats.
Result<OwnedHeightField> open_gdal_raster(const std::string& path, const ReadOptions& options);

/// read_channels() for these formats.
Result<OwnedChannels> read_gdal_channels(const std::string& path, const ReadOptions& options, bool all_bands);

/// encode_raster() as GeoTIFF; may throw std::bad_alloc. In a build without GDAL it fails with kOutput.
Result<std::vector<std::uint8_t>> encode_geotiff(const RasterImage& raster);

/// Rows of a block of a GeoTIFF written here.
inline constexpr int kRowsOfBlock = 256;

/// A GeoTIFF written row by row, for one thread.
class GeoTiff {
 public:
  virtual ~GeoTiff() = default;
  /// Writes whole blocks, or the last rows. Fails with kOutput.
  virtual Result<void> write(int row, int rows, const float* samples) = 0;
  /// Completes the file. Fails with kOutput.
  virtual Result<void> close() = 0;
};
/// Creates or overwrites the file; otherwise like encode_geotiff().
Result<std::unique_ptr<GeoTiff>> create_geotiff(const std::string& path, int cols, int rows, const RasterInfo* like);

/// True if two CRS names, as in RasterInfo::crs, mean the same CRS; in a build without GDAL, if they are equal.
bool is_same_crs(const std::string& a, const std::string& b);

}  // namespace scarp::io
