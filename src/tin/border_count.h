// The size of a domain's border by itself.
#pragma once

#include <cstdint>

#include "tin/triangulation.h"

namespace scarp {

/// Triangles of any triangulation of the domain that has vertices at the corners of its border and nowhere else. Cost:
/// O(triangles).
std::uint64_t count_border_triangles(const Triangulation& tin);

}  // namespace scarp
