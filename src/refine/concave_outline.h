// The outline of scattered points that follows their bays: a concave hull.
//
// Source: M. Duckham, L. Kulik, M. Worboys & A. Galton, "Efficient generation of simple polygons for characterizing the
// shape of a set of points in the plane", Pattern Recognition 41, 2008: the characteristic (chi) shape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "refine/scattered.h"

namespace scarp {

/// Inserts every `stride`-th point. Afterwards the domain is the Delaunay triangulation of these points and of those
/// that were there. Cost: expected O(n log n).
void add_points(const SnappedPoints& points, std::size_t stride, ScatteredDomain& domain);

/// Marks triangles outside whose edge on the boundary is longer than `longest`, in steps of the lattice, the longest
/// edge first (ties: the one with the first end in raster order), as long as the domain stays connected and its
/// boundary a simple polygon: the third corner must not lie on the boundary yet. Returns their number.
std::size_t take_away_long(ScatteredDomain& domain, double longest);

/// The points at the corners of the domain's boundary, as convex_hull() gives those of the hull. Points within its
/// edges are omitted. REQUIRES: the boundary is a simple polygon.
std::vector<std::uint32_t> outline_of(const ScatteredDomain& domain);

/// The domain within the concave hull of all points, whose boundary has edges up to `length`, in units of x and y,
/// where longer ones can be removed. `hull`: build_domain(points).
Result<ScatteredDomain> build_concave_domain(const SnappedPoints& points, ScatteredDomain hull, double length);

}  // namespace scarp
