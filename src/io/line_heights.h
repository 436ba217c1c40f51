// Interpolation of missing heights along lines.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>

#include "scarp/lines.h"

namespace scarp {

/// Fills missing heights (NaN) of places (x, y, z) by linear interpolation, by distance in x and y, between the nearest
/// known places along the line. Outside the known places, the first or last known height is used. In a ring (first and
/// last place are equal) interpolation continues around. Returns the number filled: 0 if all heights are known, or
/// none.
std::size_t fill_heights(std::span<std::array<double, 3>> places, bool is_ring);

/// read_lines() with heights converted to units of `unit_in_metres` if the file declares their unit; 0: unchanged.
Result<LineSet> read_lines_in(const std::string& path, const ReadLinesOptions& options, double unit_in_metres);

}  // namespace scarp
