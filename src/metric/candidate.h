// Candidates for insertion.
#pragma once

#include "base/point.h"
#include "geom/predicates.h"

namespace scarp::metric {

/// The sample that a triangle would insert next.
struct Candidate {
  double error = 0;  ///< importance; by default |plane − sample| by Plane::height_at()
  Point at;
};

/// Larger error first, then raster order: a total order on candidates at different samples.
inline bool is_worse(const Candidate& a, const Candidate& b) {
  return a.error != b.error ? a.error > b.error : before(a.at, b.at);
}

}  // namespace scarp::metric
