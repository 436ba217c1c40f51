// The best height of one vertex, exactly, from one pass over its samples.
//
// When a vertex rises by d thresholds, the residual at each sample of its star changes by λ·d, so its energy is
//
//   E(d) = Σ (t + λ d)⁸ = Σ over k of C(8, k)·m_k·dᵏ,   m_k = Σ t⁸⁻ᵏ λᵏ:
//
// nine sums make it a polynomial, and it is convex, a sum of even powers of linear terms. Its minimum is where its
// derivative changes sign, found by bisection; no sample is looked at again. Heights alone, without new places, take
// Fuji at 1 % of the relief from 0.516 of greedy's triangles to 0.366; with places 0.276.
#pragma once

#include "fit/triangle_error.h"

namespace scarp {

struct HeightStep {
  double rise = 0;    ///< in thresholds
  double energy = 0;  ///< there
};

/// The minimum. Level where nothing can be gained. Cost: some 50 evaluations of a polynomial.
HeightStep best_height(const TriangleError::Moments& moments);

}  // namespace scarp
