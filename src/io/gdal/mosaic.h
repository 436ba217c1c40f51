// Several rasters of one grid as one.
#pragma once

#include <string>
#include <vector>

#include "io/gdal/open.h"

namespace scarp::gdal {

/// Says in the file that it is an approximation or an error raster of another; false on failure.
bool mark_derived(GDALDatasetH raster);

/// The paths, and in place of each folder the rasters in it, by name, without those that are marked as derived, unless
/// all are: their names go to `left_out`. Fails with kInput for a folder without any raster.
Result<std::vector<std::string>> expand_folders(Session& session, const std::vector<std::string>& paths,
                                                std::vector<std::string>& left_out);

/// A virtual raster of all of them; see RasterView::more. REQUIRES: at least two.
Result<Dataset> open_mosaic(Session& session, const std::vector<std::string>& paths);

}  // namespace scarp::gdal
