// The fewest triangles of a domain.
#pragma once

#include <cstdint>

#include "tin/triangulation.h"

namespace scarp {

/// Number of triangles in any triangulation of the domain whose only vertices are the corners of its border. Cost:
/// O(triangles).
std::uint64_t count_border_triangles(const Triangulation& tin);

}  // namespace scarp
