// Mosaics, parts, and coarser versions of rasters.
#pragma once

#include <optional>
#include <string>

#include "io/gdal/open.h"
#include "scarp/io.h"

namespace scarp::gdal {

/// The cells averaged into a sample.
struct Means {
  int cells = 1;                 ///< maximum number, since nodata is skipped
  bool are_whole = false;        ///< cells are 16-bit integers
  bool have_holes = false;       ///< cells may be nodata; the mean of no valid cell is NaN, whatever its raw value
  std::optional<double> nodata;  ///< original nodata value
};

/// Opens `path` as `view` describes: a virtual raster in memory unless the view changes nothing. A folder is a mosaic
/// of its rasters. Sets `words` to a description, like RasterInfo::view. `keeps_type`: means of bytes, such as colours,
/// stay bytes. `nodata` replaces the declared nodata value. Nodata does not contribute to means. Fails as open_raster()
/// does, and as described at ReadOptions::view.
Result<Dataset> open_view(Session& session, const std::string& path, const RasterView& view, bool keeps_type,
                          std::string& words, Means* means = nullptr, std::optional<double> nodata = std::nullopt);

}  // namespace scarp::gdal
