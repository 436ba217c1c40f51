// Orientation of three points with double coordinates, without rounding.
#pragma once

#include <array>

namespace scarp::mesh {

using Point2 = std::array<double, 2>;

/// Sign of the area of (a, b, c): +1 counter-clockwise, 0 collinear, −1 clockwise. Exact for coordinates of magnitude 0
/// or between 1e-140 and 1e150. (1) Rotating the arguments does not change the sign. (2) Swapping two negates it.
int exact_orient(const Point2& a, const Point2& b, const Point2& c);

}  // namespace scarp::mesh
