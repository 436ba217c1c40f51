// The sample that a triangle would have inserted.
#pragma once

#include "base/point.h"
#include "geom/predicates.h"

namespace scarp {

/// The sample that a triangle would have inserted.
struct Candidate {
  double error = 0;  ///< its importance: |plane − sample| by Plane::height_at(), where nothing else is asked for
  Point at;
};

/// Larger error first, then raster order: a total order on candidates that are different samples.
inline bool is_worse(const Candidate& a, const Candidate& b) {
  return a.error != b.error ? a.error > b.error : before(a.at, b.at);
}

}  // namespace scarp
