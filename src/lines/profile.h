// Heights along a line, in equal steps.
#pragma once

#include <cstddef>
#include <vector>

namespace scarp::lines {

/// The positions, in order and without the ends, where a polyline must bend to stay within `tolerance` of the heights.
/// It is split recursively where the heights are farthest from the chord (Douglas & Peucker 1973, along the line).
/// At positions fewer than `gap` steps from an end or another bend, twice the tolerance is allowed. NaN means no
/// height: a part with NaN at an end is split where heights begin.
std::vector<std::size_t> find_bends(const std::vector<double>& heights, double tolerance, std::size_t gap = 1);

}  // namespace scarp::lines
