// The convex hull of lattice points.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/point.h"

namespace scarp::geom {

/// Indices of the hull's corners, positively oriented, starting at the first point in raster order. Points inside hull
/// edges are omitted. Fewer than three if all points are collinear. Cost: O(n) plus a sort of the points near the hull.
/// Source: Andrew's monotone chain (1979), after dropping points inside an octagon of extreme points (Akl & Toussaint
/// 1978). REQUIRES: distinct points.
std::vector<std::uint32_t> convex_hull(std::span<const Point> points);

}  // namespace scarp::geom
