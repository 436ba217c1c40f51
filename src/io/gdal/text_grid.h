// Rasters that are written as text of columns, a node on each line.
#pragma once

#include <string>

#include "scarp/result.h"

namespace scarp::gdal {

/// The item of a raster's metadata with the number of nodes of its text.
inline constexpr const char* kTextGridKey = "SCARP_NODES";

/// The item with warnings about its columns, a sentence a line.
inline constexpr const char* kTextWarningsKey = "SCARP_WARNINGS";

/// Empty for a file that is no text of columns, or whose points lie scattered; else the name of a GeoTIFF of the same
/// nodes, made on the first call and kept for the process. GDAL's driver for XYZ accepts only rows in order, and its
/// nodata value depends on the file. Fails with kOutput where the copy has no room.
Result<std::string> find_text_grid(const std::string& path);

}  // namespace scarp::gdal
