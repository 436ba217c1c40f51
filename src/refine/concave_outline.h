// The outline of scattered points that follows bays: a concave hull.
//
// Source: M. Duckham, L. Kulik, M. Worboys & A. Galton, "Efficient generation of simple polygons for characterizing the
// shape of a set of points in the plane", Pattern Recognition 41, 2008: the characteristic (chi) shape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "refine/scattered.h"

namespace scarp::refine {

/// Inserts every `stride`-th point. Afterwards, the domain is the Delaunay triangulation of these points and the
/// previous vertices. Cost: expected O(n log n).
void add_points(const grid::SnappedPoints& points, std::size_t stride, ScatteredDomain& domain);

/// Marks triangles with a boundary edge longer than `longest`, in steps of the lattice, as outside; the longest edge
/// first (ties: the first end in raster order). The domain remains connected and its boundary a simple polygon: the
/// third corner must not lie on the boundary yet. Returns the number of marked triangles.
std::size_t take_away_long(ScatteredDomain& domain, double longest);

/// The points at the corners of the domain's boundary, in the format of convex_hull(). Points within boundary edges are
/// omitted. REQUIRES: the boundary is a simple polygon.
std::vector<std::uint32_t> outline_of(const ScatteredDomain& domain);

/// The domain within the concave hull of all points. Its boundary has edges of at most `length`, in units of x and y,
/// and longer edges only where they cannot be removed. `hull`: build_domain(points).
Result<ScatteredDomain> build_concave_domain(const grid::SnappedPoints& points, ScatteredDomain hull, double length);

}  // namespace scarp::refine
