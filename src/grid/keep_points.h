// Omits points of a set.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/function_ref.h"
#include "scarp/height_field.h"

namespace scarp::grid {

/// Keeps the points for which stays(number) is true, in their order, and adapts the lines. Returns the new number of
/// each remaining point, indexed by its old number. REQUIRES: all points of lines stay, and there is no boundary.
std::vector<std::uint32_t> keep_points(PointSet& points, FunctionRef<bool(std::size_t)> stays);

/// True if all x and y are finite.
bool has_finite_places(const PointSet& points);

}  // namespace scarp::grid
