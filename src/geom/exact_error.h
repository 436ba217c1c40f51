// |plane − sample| against a threshold, exactly.
#pragma once

#include <array>

#include "geom/predicates.h"

namespace scarp {

/// True if the plane through the corners differs from `sample` at p by more than `threshold`, as real numbers.
/// Heights are float32 and the threshold is a double, so all are dyadic rationals: scaled to integers, the barycentric
/// sum
///   |w0·z0 + w1·z1 + w2·z2 − A·h| > threshold · A,   w0 + w1 + w2 = A = orient(corners)
/// fits 128 bits for every combination met in practice. Where it does not (heights of wildly different magnitude)
/// the answer is the safe one: true, unless p is a corner.
/// REQUIRES: p in the closed triangle, orient(corners) > 0, threshold >= 0, all values finite.
bool exceeds_exactly(const std::array<Point, 3>& corners, const std::array<float, 3>& heights, Point p, float sample,
                     double threshold);

}  // namespace scarp
