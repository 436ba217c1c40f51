// Checks if the convex hull fits scattered points, or if it bridges bays and has slivers at a straight rim.
#pragma once

#include "grid/snapped_points.h"
#include "scarp/height_field.h"

namespace scarp::refine {

/// Finds the part that two concave hulls remove from the Delaunay triangulation of the points, or of 50,000 of them if
/// there are more. Edges of the first hull have at most three times the length that a tenth of all edges exceed. This
/// hull removes some 1 / sqrt(n) of the area if n points are scattered evenly. An area larger than 2.5 times that, and
/// than 5 %, is a bay. Edges of the second hull have at most half that length. It removes up to 0.3 sqrt(n) steep
/// triangles from evenly scattered points, up to 0.6 sqrt(n) from points near the nodes of a grid, and 0.8 to 1.8
/// sqrt(n) from stations along straight rims. Steep: above 80 degrees, and above ten times the slope that a tenth of
/// all triangles exceed. REQUIRES: build_domain(points) succeeds.
HullFit find_hull_fit(const grid::SnappedPoints& points);

}  // namespace scarp::refine
