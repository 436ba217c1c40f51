// The volumes between two triangles, or between a triangle and a level.
#pragma once

#include "measure/plan_triangle.h"

namespace scarp::judge {

/// The volumes between two surfaces above a part of the plane. Neither volume is negative.
struct Prism {
  double cut = 0;   ///< volume where the second surface lies below the first
  double fill = 0;  ///< volume where it lies above
  double area = 0;  ///< area of the part, seen from above
};

/// From `from` to `to`, above all that their insides have in common. All is exactly 0 where that is nothing, and so are
/// both volumes where the two are one triangle.
/// REQUIRES: corners are counter-clockwise, of sizes as for exact_orient().
Prism find_prism(const Facet& from, const Facet& to);
/// From the triangle to a level, above all of it.
Prism find_prism(const Facet& from, double level);

}  // namespace scarp::judge
