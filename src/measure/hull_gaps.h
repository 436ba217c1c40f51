// Holes in a surface over scattered points, whose domain is their convex hull, or their boundary.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/ring_bands.h"
#include "grid/snapped_points.h"
#include "measure/topology.h"

namespace scarp::judge {

/// The corners of the points' convex hull, with the height 0.
PointSet hull_corners(const PointSet& points);

/// Counts open edges at which the mesh has a hole or an inlet. At such an edge, the point 4 `tolerance` outside the
/// edge's middle lies inside the points' convex hull. Cost: O(open edges · log hull), plus O(points).
std::uint64_t count_hull_gaps(const PointSet& points, const grid::SnappedPoints& snapped, const Mesh& mesh,
                              std::span<const OpenEdge> open, double tolerance);

/// The same within polygons, given as rings.
std::uint64_t count_boundary_gaps(const std::vector<PlaceRing>& rings, const Mesh& mesh, std::span<const OpenEdge> open,
                                  double tolerance);

}  // namespace scarp::judge
