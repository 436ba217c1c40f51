// Importance measures (Garland & Heckbert 1995, section 3); those that do not depend on the mesh.
#pragma once

#include <vector>

#include "grid/raster.h"
#include "scarp/options.h"

namespace scarp {

/// Is there a feature that does not depend on the mesh?
bool has_raster_feature(const Importance& importance);

double damped(double feature, Importance::Damping damping);

/// The damped feature at every sample, row-major; 0 at nodata samples. REQUIRES: has_raster_feature().
std::vector<float> measure_feature(const Raster& raster, const Importance& importance);

/// Samples in order of their value, largest first, ties in raster order; nodata samples are omitted.
std::vector<Point> rank_samples(const Raster& raster, const std::vector<float>& values);

}  // namespace scarp
