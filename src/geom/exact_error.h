// |plane − sample| against a threshold, exactly.
#pragma once

#include <array>

#include "geom/predicates.h"

namespace scarp {

/// True if the plane through the corners differs from `sample` at p by more than `threshold`, as real numbers.
/// All values are dyadic rationals: scaled to integers, the barycentric sum
///   |w0·z0 + w1·z1 + w2·z2 − A·h| > threshold · A,   w0 + w1 + w2 = A = orient(corners)
/// fits 128 bits for every combination of float32 heights met in practice, and for double ones on lattices of up to
/// some 2^30 cells in a triangle. Where it does not (heights of wildly different magnitude, huge triangles) the answer
/// is the safe one: true, unless p is a corner.
/// REQUIRES: p in the closed triangle, orient(corners) > 0, threshold >= 0, all values finite.
bool exceeds_exactly(const std::array<Point, 3>& corners, const std::array<double, 3>& heights, Point p, double sample,
                     double threshold);
inline bool exceeds_exactly(const std::array<Point, 3>& corners, const std::array<float, 3>& heights, Point p,
                            float sample, double threshold) {
  return exceeds_exactly(corners, std::array<double, 3>{heights[0], heights[1], heights[2]}, p, double{sample},
                         threshold);
}

}  // namespace scarp
