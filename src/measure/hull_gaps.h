// Holes in a surface over scattered points, whose domain is their convex hull.
#pragma once

#include <cstdint>
#include <span>

#include "grid/snapped_points.h"
#include "measure/topology.h"

namespace scarp::judge {

/// Open edges for which the point 4 `tolerance` outside of their middle lies in the inside of the points' convex hull,
/// and deeper than that: the mesh has a hole or an inlet there. Cost: O(open edges · log hull), and a sort of the
/// points.
std::uint64_t count_hull_gaps(const PointSet& points, const SnappedPoints& snapped, const Mesh& mesh,
                              std::span<const OpenEdge> open, double tolerance);

}  // namespace scarp::judge
