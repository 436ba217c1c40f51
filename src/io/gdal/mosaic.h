// Joins several rasters on one grid.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/gdal/open.h"

namespace scarp::gdal {

/// Marks the raster as derived from another: an approximation or its errors. Returns false on failure.
bool mark_derived(GDALDatasetH raster);

/// The paths, with each folder replaced by its rasters, sorted by name. Rasters marked as derived are skipped unless
/// all are derived. The names of skipped rasters are added to `left_out`. Fails with kInput for a folder without
/// rasters.
Result<std::vector<std::string>> expand_folders(Session& session, const std::vector<std::string>& paths,
                                                std::vector<std::string>& left_out);

/// Finds the gap in a virtual raster of files on both sides of the 180th meridian. Such a raster spans most of the
/// earth and declares the gap empty. Returns the gap's first and end columns.
std::optional<std::pair<int, int>> find_wide_gap(GDALDatasetH raster);

/// A virtual raster of all paths; see RasterView::more. `nodata`: as in open_view(). Sets `words` to a description of
/// the result. REQUIRES: at least one path.
Result<Dataset> open_mosaic(Session& session, const std::vector<std::string>& paths, std::optional<double> nodata,
                            std::string& words);

}  // namespace scarp::gdal
