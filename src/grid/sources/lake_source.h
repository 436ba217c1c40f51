// A streamed raster with lakes.
#pragma once

#include <memory>
#include <vector>

#include "grid/sample_runs.h"
#include "scarp/height_field.h"

namespace scarp::grid {

/// Samples that are set to a height.
struct LevelRun {
  SampleRun samples;
  float height = 0;
  bool only_raises = false;  ///< samples above that height are unchanged
};

/// `source` with some samples set to other heights; nodata stays nodata. `runs`: in raster order, disjoint. Cost: that
/// of `source`, plus a search for the first run in each row.
std::shared_ptr<const SampleSource> level_source(std::shared_ptr<const SampleSource> source,
                                                 std::vector<LevelRun> runs);

}  // namespace scarp::grid
