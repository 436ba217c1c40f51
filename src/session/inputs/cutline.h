// Polygons that bound the surface.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scarp/io.h"
#include "scarp/lines.h"
#include "session/options/line_options.h"

namespace scarp::cli {

/// The contents of the files.
struct Cut {
  Cutline cutline;             ///< empty if samples outside become nodata
  std::uint64_t polygons = 0;  ///< number of polygons in the files, before an inset
  std::uint64_t masked = 0;    ///< samples made nodata
  std::uint64_t bytes = 0;     ///< bytes of the index of these samples, if samples are not in memory

  /// For the judge; null if no cut applies.
  const Cutline* judged() const { return cutline.rings.empty() ? nullptr : &cutline; }
};

/// Reads the polygons in the CRS of the raster, whose metadata is `raster`. On request, samples of `field` outside the
/// polygons become nodata. Adds sentences for the user to `warnings`.
Result<Cut> read_cut(const GivenOptions& given, const RasterInfo& raster, const ProgressCallback& progress,
                     OwnedHeightField& field, std::vector<std::string>& warnings);

}  // namespace scarp::cli
