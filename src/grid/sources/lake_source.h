// A raster with lakes, where its samples are not in memory as one array.
#pragma once

#include <memory>
#include <vector>

#include "grid/sample_runs.h"
#include "scarp/height_field.h"

namespace scarp {

/// Samples that are put onto a height.
struct LevelRun {
  SampleRun samples;
  float height = 0;
  bool only_raises = false;  ///< those that lie above it stay
};

/// `source` with some samples at other heights; nodata stays nodata. `runs`: in raster order, apart from each other.
/// Cost: a window's own, and a search for its first run in each row.
std::shared_ptr<const SampleSource> level_source(std::shared_ptr<const SampleSource> source,
                                                 std::vector<LevelRun> runs);

}  // namespace scarp
