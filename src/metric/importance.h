// Importance measures that do not depend on the mesh (Garland & Heckbert 1995, section 3).
#pragma once

#include <vector>

#include "grid/raster.h"
#include "scarp/options.h"

namespace scarp::metric {

/// True if the measure has a feature that does not depend on the mesh.
bool has_raster_feature(const Importance& importance);

double damped(double feature, Importance::Damping damping);

/// The damped feature at every sample, row-major; 0 at nodata samples. REQUIRES: has_raster_feature().
std::vector<float> measure_feature(const grid::Raster& raster, const Importance& importance);

/// Samples by descending value, ties in raster order; nodata samples are omitted.
std::vector<Point> rank_samples(const grid::Raster& raster, const std::vector<float>& values);

}  // namespace scarp::metric
