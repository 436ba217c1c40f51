// The best height of one vertex, exactly, from one pass over its samples.
//
// When a vertex rises by d thresholds (or units, where samples have bounds of their own), the residual at each sample
// of its star changes by λ·d, so its energy is
//
//   E(d) = Σ (t + λ d)⁸ = Σ over k of C(8, k)·m_k·dᵏ,   m_k = Σ t⁸⁻ᵏ λᵏ:
//
// a polynomial with nine sums as coefficients. It is convex, as a sum of even powers of linear terms. Bisection finds
// its minimum, where the derivative changes sign, or the end of the allowed range; no sample is read again. Fuji at 1 %
// of the relief needs 0.516 of greedy's triangles without these steps, 0.366 with new heights only, and 0.276 with new
// heights and places.
#pragma once

#include "fit/triangle_error.h"

namespace scarp::fit {

struct HeightStep {
  double rise = 0;    ///< in thresholds, or units
  double energy = 0;  ///< energy after the rise
};

/// The minimum between the lowest and the highest rise; rise 0 if nothing can be gained. The rise is accurate to 2⁻¹⁶ ·
/// scale, or to 2⁻¹⁶ of itself. Cost: some 20 evaluations of a polynomial.
HeightStep best_height(const TriangleError::Moments& moments, double lowest, double highest, double scale = 1);

/// The same for the energy Σ t², which is a parabola.
HeightStep best_even_height(const TriangleError::Moments& moments, double lowest, double highest);

double energy_after(const TriangleError::Moments& moments, double rise);

/// By Minkowski's inequality the minimum lies within twice this rise. 1 if the moments do not determine it.
double scale_of_rises(const TriangleError::Moments& moments);

}  // namespace scarp::fit
