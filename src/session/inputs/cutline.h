// Polygons that the surface ends at.
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
  Cutline cutline;             ///< empty where the samples outside are nodata
  std::uint64_t polygons = 0;  ///< number of polygons in the files, before an inset
  std::uint64_t masked = 0;    ///< samples that were made nodata
  std::uint64_t bytes = 0;     ///< bytes of the index that separates them where the samples are not in memory

  /// For the judge; null where everything counts.
  const Cutline* judged() const { return cutline.rings.empty() ? nullptr : &cutline; }
};

/// Reads the polygons in the CRS of the raster, `raster` being its file's metadata, and makes the samples of `field`
/// outside nodata where that was asked for. Sentences for the user in `warnings`.
Result<Cut> read_cut(const GivenOptions& given, const RasterInfo& raster, const ProgressCallback& progress,
                     OwnedHeightField& field, std::vector<std::string>& warnings);

}  // namespace scarp::cli
