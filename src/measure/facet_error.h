// The error mesh − sample at one point of one triangle.
#pragma once

#include "measure/plan_triangle.h"

namespace scarp::judge {

/// Σ w[k]·z[k] / Σ w[k] − sample, correctly rounded except for ties closer than 2^-100: if the true error is at most
/// some double, so is the result. The sums are exact (error-free transformations: Dekker 1971, Shewchuk 1997). So a
/// mesh with corners on the lattice that reproduces a sample exactly has error 0. REQUIRES: w[k] >= 0, Σ w[k] > 0, all
/// finite and far from overflow.
double settle_error(const std::array<double, 3>& w, const std::array<double, 3>& z, double sample);

/// Error of a sample at (x, y) outside the facet but near it, measured on the facet's extrapolated plane. The plane of
/// a facet thinner than `tolerance` is meaningless, so the facet's nearest point is used instead.
double error_beside(const Facet& facet, double x, double y, double sample, double tolerance);

}  // namespace scarp::judge
