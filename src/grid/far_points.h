// Outliers: a few points far from all others, usually survey errors.
#pragma once

#include <string>

#include "scarp/height_field.h"

namespace scarp::grid {

/// For an error message about points too far apart: "the point at (0, 0) lies far from all others, which span 20:
/// remove it if it is an error". Empty unless a few points, at most three or 1 %, make the extent ten times that of the
/// others. REQUIRES: finite coordinates. Cost: O(n).
std::string describe_far_points(const PointSet& points);

}  // namespace scarp::grid
