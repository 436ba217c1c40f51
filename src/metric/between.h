// The samples on an edge.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <numeric>

#include "base/point.h"

namespace scarp::metric {

/// Calls visit(p, share) for each lattice point p strictly between a and b on their line, from a to b; share is its
/// fraction of the way, in (0, 1).
template <class Visit>
void visit_between(Point a, Point b, Visit&& visit) {
  const std::int32_t dx = b.x - a.x, dy = b.y - a.y, steps = std::gcd(std::abs(dx), std::abs(dy));
  for (std::int32_t i = 1; i < steps; ++i)
    visit(Point{a.x + dx / steps * i, a.y + dy / steps * i}, static_cast<double>(i) / steps);
}

}  // namespace scarp::metric
