// Several rasters of one grid as one.
#pragma once

#include <string>
#include <vector>

#include "io/gdal/open.h"

namespace scarp::gdal {

/// The paths, and in place of each folder the rasters in it, by name. Fails with kInput for a folder without any.
Result<std::vector<std::string>> expand_folders(Session& session, const std::vector<std::string>& paths);

/// A virtual raster of all of them; see RasterView::more. REQUIRES: at least two.
Result<Dataset> open_mosaic(Session& session, const std::vector<std::string>& paths);

}  // namespace scarp::gdal
