// Exact comparison of |plane − sample| with a threshold.
#pragma once

#include <array>

#include "geom/predicates.h"

namespace scarp::geom {

/// True if the plane through the corners differs from `sample` at p by more than `threshold`, as real numbers.
/// All values are dyadic rationals: scaled to integers, the barycentric sum
///   |w0·z0 + w1·z1 + w2·z2 − A·h| > threshold · A,   w0 + w1 + w2 = A = orient(corners)
/// fits 128 bits for every combination of float32 heights met in practice. With double heights, the sum fits for
/// triangles of up to some 2^30 lattice cells. Otherwise (heights of very different magnitudes, huge triangles) the
/// result is the safe one: true, unless p is a corner. REQUIRES: p in the closed triangle, orient(corners) > 0,
/// threshold >= 0, all values finite.
bool exceeds_exactly(const std::array<Point, 3>& corners, const std::array<double, 3>& heights, Point p, double sample,
                     double threshold);
inline bool exceeds_exactly(const std::array<Point, 3>& corners, const std::array<float, 3>& heights, Point p,
                            float sample, double threshold) {
  return exceeds_exactly(corners, std::array<double, 3>{heights[0], heights[1], heights[2]}, p, double{sample},
                         threshold);
}

/// The same on a line of n steps from height `from` to height `to`: true if the height after k steps differs from
/// `sample` by more than `threshold`, as real numbers: |(n − k)·from + k·to − n·sample| > threshold · n. Fits 128 bits
/// for all float32 heights whose magnitudes span less than some 2^90; otherwise true. REQUIRES: 0 < k < n <= 2^30.
bool exceeds_exactly_between(float from, float to, std::int64_t k, std::int64_t n, float sample, double threshold);

}  // namespace scarp::geom
