// Interpolation of missing heights along lines.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>

#include "scarp/lines.h"

namespace scarp::io {

/// Fills missing heights (NaN) of places (x, y, z) by linear interpolation between the nearest known places along the
/// line, by distance in x and y. Outside the known places, the first or last known height is used. In a ring, whose
/// first and last places are equal, interpolation continues around. Returns the number of filled heights, 0 if all or
/// no heights are known.
std::size_t fill_heights(std::span<std::array<double, 3>> places, bool is_ring);

/// Like read_lines(), but converts heights to units of `unit_in_metres` if the file declares their unit. 0: unchanged.
Result<LineSet> read_lines_in(const std::string& path, const ReadLinesOptions& options, double unit_in_metres);

}  // namespace scarp::io
