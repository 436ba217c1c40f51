// The rings of a cutline, clipped to a height field.
#pragma once

#include <cstdint>
#include <vector>

#include "scarp/lines.h"

namespace scarp::lines {

/// The rings without heights, clipped to the rectangle of the samples (I. E. Sutherland and G. W. Hodgman, "Reentrant
/// Polygon Clipping", 1974). Rings remain closed: they follow the sides where they leave the rectangle. Rings inside
/// are unchanged.
std::vector<Line> clip_rings(const Cutline& cutline, std::int32_t cols, std::int32_t rows);

}  // namespace scarp::lines
