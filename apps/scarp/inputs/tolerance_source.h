// Bounds of samples that are read in windows, since the heights that they are for are not in memory either.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/io.h"

namespace scarp::cli {

struct BoundsInWindows {
  std::shared_ptr<const SampleSource> source;  ///< +infinity: no bound
  std::uint64_t bytes = 0;                     ///< of memory
  bool may_lack = false;                       ///< some samples may have none
};

/// The tolerance raster that `option` names, which must lie on the grid of the heights. What it has of `limit` is a
/// quarter of what the program leaves at most. It is read once through: a value below 0, or none at all, is refused at
/// once.
Result<BoundsInWindows> open_tolerances(const char* option, const std::string& path, const RasterInfo& raster,
                                        const OwnedHeightField& heights, std::uint64_t limit,
                                        const ProgressCallback& progress, std::vector<std::string>& warnings);

/// The smaller one of two bounds.
BoundsInWindows least_of(const BoundsInWindows& a, const BoundsInWindows& b);

/// The bound that a value of a tolerance raster means; `is_rounded`: to float32, so that it may be above the file's.
float bound_of_value(float value, bool is_rounded);

/// What is said of a bound or weight below 0.
tl::unexpected<Error> refuse_negative(const char* option, const std::string& path, float value, std::int64_t col,
                                      std::int64_t row);

}  // namespace scarp::cli
