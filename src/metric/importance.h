// Importance measures that do not depend on the mesh (Garland & Heckbert 1995, section 3).
#pragma once

#include <vector>

#include "grid/raster.h"
#include "scarp/strategy.h"

namespace scarp {

/// The damped feature at every sample, row-major; 0 at nodata samples. REQUIRES: a feature.
std::vector<float> measure_feature(const Raster& raster, const Importance& importance);

/// Samples in order of their value, largest first, ties in raster order; nodata samples are left out.
std::vector<Point> rank_samples(const Raster& raster, const std::vector<float>& values);

}  // namespace scarp
