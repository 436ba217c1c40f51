// Lines some of whose vertices have no height.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>

#include "scarp/lines.h"

namespace scarp {

/// Gives each place (x, y, z) without a height (z is NaN) one between those of the nearest places along the line that
/// have one, by the way in x and y; before the first and behind the last of them that one's, in a ring (its last place
/// is its first) the way continues around. Returns how many it gave: none where all heights are known, or none is.
std::size_t fill_heights(std::span<std::array<double, 3>> places, bool is_ring);

/// read_lines() with heights in units of so many metres, if the file declares their unit; 0: as they are.
Result<LineSet> read_lines_in(const std::string& path, const ReadLinesOptions& options, double unit_in_metres);

}  // namespace scarp
