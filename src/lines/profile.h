// Heights along a line, in equal steps.
#pragma once

#include <cstddef>
#include <vector>

namespace scarp {

/// The places, in order and without the ends, where a polyline must bend to differ from the heights by no more than
/// `tolerance`: it is split where the heights are farthest from the chord until they are nowhere farther (Douglas &
/// Peucker 1973, along the line). Fewer than `gap` steps from an end or another bend they may differ by twice that. NaN
/// is no height: a part with an end there is split where heights begin.
std::vector<std::size_t> find_bends(const std::vector<double>& heights, double tolerance, std::size_t gap = 1);

}  // namespace scarp
