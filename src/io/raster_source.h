// What GDAL reads, without GDAL's headers.
#pragma once

#include <string>

#include "scarp/io.h"

namespace scarp {

/// read_height_field() for everything that has no reader of our own; may throw std::bad_alloc. In a build without GDAL
/// it fails with kInput and says so.
Result<OwnedHeightField> read_gdal_raster(const std::string& path, const ReadOptions& options);

}  // namespace scarp
