// The coordinates of rows and columns in netCDF files by the CF conventions.
#pragma once

#include <gdal.h>

#include <string>

#include "scarp/result.h"

namespace scarp::gdal {

/// True if the file's coordinates are longitudes and latitudes. CF files may omit their datum.
bool is_in_degrees(GDALDatasetH dataset);

/// Fails with kInput if rows or columns of a netCDF raster are not evenly spaced. GDAL checks only three spacings, and
/// tolerates a tenth of a degree.
Result<void> verify_axes(GDALDatasetH dataset, const std::string& path);

}  // namespace scarp::gdal
