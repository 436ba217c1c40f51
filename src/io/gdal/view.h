// Several rasters, a part or a coarser version of one, as one raster.
#pragma once

#include <optional>
#include <string>

#include "io/gdal/open.h"
#include "scarp/io.h"

namespace scarp::gdal {

/// The cells whose mean a sample is.
struct Means {
  int cells = 1;                 ///< at most: nodata does not count
  bool are_whole = false;        ///< the cells hold whole numbers of 16 bits
  bool have_holes = false;       ///< cells may hold no height; a mean of none is NaN, whatever stood for it
  std::optional<double> nodata;  ///< value that stood for nodata
};

/// Opens what `view` makes of `path`, a virtual raster in memory where that is more than the one raster as it is. A
/// folder is a mosaic of its rasters. `words` describes the result, like RasterInfo::view. `keeps_type`: bytes stay
/// bytes where samples are averaged, as colours are. `nodata`: holds instead of the value that is declared; neither has
/// a part in means. Fails as open_raster() and as ReadOptions::view describes.
Result<Dataset> open_view(Session& session, const std::string& path, const RasterView& view, bool keeps_type,
                          std::string& words, Means* means = nullptr, std::optional<double> nodata = std::nullopt);

}  // namespace scarp::gdal
