// Outliers: few points far from all others, which are mostly errors of the survey.
#pragma once

#include <string>

#include "scarp/height_field.h"

namespace scarp {

/// "point 7 (counted from 0) at (0, 0) lies far from all others, which span 20: remove it if it is an error", for a
/// message about points that lie too far apart; empty unless a few points, at most three or 1 %, make the extent ten
/// times that of the others. REQUIRES: coordinates are finite. Cost: O(n).
std::string describe_far_points(const PointSet& points);

}  // namespace scarp
