// Checks that a line's position on a raster can be computed.
#pragma once

#include <array>
#include <span>
#include <string>

#include "scarp/result.h"

namespace scarp::grid {

/// Fails with kInput for a vertex farther away than kFarthestSample (grid/affine_map.h) or without a position. The
/// message names the line and the position. `affine`: maps samples to the coordinates of the line. REQUIRES: it is
/// invertible.
Result<void> check_line_positions(const std::string& name, std::span<const std::array<double, 3>> points,
                                  const std::array<double, 6>& affine);

}  // namespace scarp::grid
