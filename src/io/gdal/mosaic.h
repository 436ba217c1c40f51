// Several rasters of one grid as one.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/gdal/open.h"

namespace scarp::gdal {

/// Marks the file as an approximation or an error raster of another; false on failure.
bool mark_derived(GDALDatasetH raster);

/// The paths, and in place of each folder the rasters in it, by name, without those that are marked as derived, unless
/// all are: their names go to `left_out`. Fails with kInput for a folder without any raster.
Result<std::vector<std::string>> expand_folders(Session& session, const std::vector<std::string>& paths,
                                                std::vector<std::string>& left_out);

/// The columns, first and end, between the two sides of a raster that goes around most of the earth and holds nothing
/// there, according to its file: a virtual raster of some on both sides of the 180th meridian.
std::optional<std::pair<int, int>> find_wide_gap(GDALDatasetH raster);

/// A virtual raster of all of them; see RasterView::more. `nodata`: as of open_view(). `words` receives a description
/// of the result. REQUIRES: at least one.
Result<Dataset> open_mosaic(Session& session, const std::vector<std::string>& paths, std::optional<double> nodata,
                            std::string& words);

}  // namespace scarp::gdal
