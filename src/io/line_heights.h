// Interpolation of missing heights along lines.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>

#include "scarp/lines.h"

namespace scarp {

/// Fills missing heights (NaN) of places (x, y, z) between the nearest known places along the line, linearly by
/// distance in x and y. Before the first and behind the last known one its height is used; in a ring (its last place is
/// its first) interpolation continues around. Returns the number filled: none if all heights are known, or none is.
std::size_t fill_heights(std::span<std::array<double, 3>> places, bool is_ring);

/// read_lines() with heights in units of `unit_in_metres`, if the file declares their unit; 0: unchanged.
Result<LineSet> read_lines_in(const std::string& path, const ReadLinesOptions& options, double unit_in_metres);

}  // namespace scarp
