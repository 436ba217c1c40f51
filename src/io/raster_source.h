// What GDAL reads, without GDAL's headers.
#pragma once

#include <string>

#include "scarp/io.h"

namespace scarp {

/// read_height_field() and read_raster_info() for everything that has no reader of our own. In a build without GDAL
/// both fail with kInput and say so.
Result<OwnedHeightField> read_gdal_raster(const std::string& path, const ReadOptions& options);
Result<RasterInfo> read_gdal_info(const std::string& path, const ReadOptions& options, int& cols, int& rows);

}  // namespace scarp
