// Rasters stored as columns of text, one node per line.
#pragma once

#include <string>

#include "scarp/result.h"

namespace scarp::gdal {

/// Metadata key for the number of nodes in a raster's text.
inline constexpr const char* kTextGridKey = "SCARP_NODES";

/// Metadata key for warnings about the text's columns, one sentence per line.
inline constexpr const char* kTextWarningsKey = "SCARP_WARNINGS";

/// The name of a GeoTIFF of the text's nodes, created on the first call and kept for the process. Empty for a file that
/// is not text in columns, or has scattered points. GDAL's XYZ driver is not used: it accepts only sorted rows, and its
/// nodata value depends on the file. Fails with kOutput if there is no space for the copy.
Result<std::string> find_text_grid(const std::string& path);

}  // namespace scarp::gdal
