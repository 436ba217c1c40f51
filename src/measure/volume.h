// The volumes between two triangles, or between a triangle and a level.
#pragma once

#include "measure/plan_triangle.h"

namespace scarp::judge {

/// The volumes between two surfaces above a part of the plane. Neither volume is negative.
struct Prism {
  double cut = 0;   ///< volume where the second surface lies below the first
  double fill = 0;  ///< volume where the second surface lies above the first
  double area = 0;  ///< area of the part, seen from above
};

/// The prism from `from` to `to`, above the intersection of their interiors. All values are exactly 0 if the
/// intersection is empty. Both volumes are exactly 0 if `from` and `to` are the same triangle. REQUIRES: corners are
/// counter-clockwise, of sizes as for exact_orient().
Prism find_prism(const Facet& from, const Facet& to);
/// The prism from the whole triangle to a level.
Prism find_prism(const Facet& from, double level);

}  // namespace scarp::judge
