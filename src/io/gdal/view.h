// A mosaic, a part, or a coarser version of rasters, as one raster.
#pragma once

#include <optional>
#include <string>

#include "io/gdal/open.h"
#include "scarp/io.h"

namespace scarp::gdal {

/// The cells averaged into a sample.
struct Means {
  int cells = 1;                 ///< at most, since nodata is skipped
  bool are_whole = false;        ///< cells are 16-bit integers
  bool have_holes = false;       ///< cells may be nodata; a mean of none is NaN, whatever its original value
  std::optional<double> nodata;  ///< original nodata value
};

/// Opens `path` as `view` describes: a virtual raster in memory unless it is the unmodified raster. A folder is a
/// mosaic of its rasters. `words` describes the result, like RasterInfo::view. `keeps_type`: bytes stay bytes where
/// samples are averaged, as for colours. `nodata` replaces the declared value; neither contributes to means. Fails as
/// open_raster() and as described at ReadOptions::view.
Result<Dataset> open_view(Session& session, const std::string& path, const RasterView& view, bool keeps_type,
                          std::string& words, Means* means = nullptr, std::optional<double> nodata = std::nullopt);

}  // namespace scarp::gdal
