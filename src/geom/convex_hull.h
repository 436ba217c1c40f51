// The convex hull of lattice points.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/point.h"

namespace scarp {

/// Indices of the hull's corners, positively oriented, from the first point in raster order on; points within its edges
/// are omitted. Fewer than three if all points lie on one line. Cost: O(n) and a sort of the points near the hull.
/// Source: Andrew's monotone chain (1979), after points inside an octagon of extreme points are dropped (Akl &
/// Toussaint 1978). REQUIRES: no two points at one place.
std::vector<std::uint32_t> convex_hull(std::span<const Point> points);

}  // namespace scarp
