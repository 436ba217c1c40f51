// Rasters read by GDAL, without GDAL's headers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scarp/io.h"

namespace scarp {

/// read_height_field() for everything that has no reader of our own; may throw std::bad_alloc. In a build without GDAL
/// it fails with kInput and says so.
Result<OwnedHeightField> read_gdal_raster(const std::string& path, const ReadOptions& options);

/// open_height_field(), likewise.
Result<OwnedHeightField> open_gdal_raster(const std::string& path, const ReadOptions& options);

/// read_channels(), likewise.
Result<OwnedChannels> read_gdal_channels(const std::string& path, const ReadOptions& options, bool all_bands);

/// encode_raster() as GeoTIFF; may throw std::bad_alloc. In a build without GDAL it fails with kOutput.
Result<std::vector<std::uint8_t>> encode_geotiff(const RasterImage& raster);

/// Whether two names of CRSs, as in RasterInfo::crs, mean the same. In a build without GDAL: whether they are equal.
bool is_same_crs(const std::string& a, const std::string& b);

}  // namespace scarp
