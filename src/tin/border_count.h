// The fewest triangles of a domain.
#pragma once

#include <cstdint>

#include "tin/triangulation.h"

namespace scarp::tin {

/// Number of triangles in any triangulation of the domain that uses only the corners of the domain's border as
/// vertices. Cost: O(triangles).
std::uint64_t count_border_triangles(const Triangulation& tin);

}  // namespace scarp::tin
