// A mesh of a given size with the least squared error.
//
// For a given size, the mesh of least max error differs from that of least squared error. The best density of triangles
// is a power of the curvature, with exponent ½ for the max error and ⅓ for the squared error. So a tighter bound does
// not lead to the least squared error. Instead:
//
//   start        a refined mesh of some kSquareStart times the triangles
//   reduction    the cheapest vertex is removed first; its price is the rise of Σ e²; each neighbour makes a step
//   sweeps       flips of all edges, a Gauss–Newton step of all vertices, each with its exact best height
//   exchanges    a tenth of the vertices move to where they gain most, then sweeps; undone if Σ e² has
//                not fallen
//   sweeps
//
// All steps stay within the bound, which is proven as usual. Larger meshes are handled in patches. Theory gives the
// patches' shares of the triangles: E of n triangles falls as n⁻², so the marginal gains are equal if n ~ (E n²)^⅓.
// Each round cuts new patches, in squares shifted against each other.
#pragma once

#include "fit/fit.h"

namespace scarp::fit {

/// Triangles before reduction, relative to the wanted number. On Fuji factors of 1, 2, 4 and 6 lead to an RMSE of 6.86,
/// 6.4, 6.28 and 6.26.
inline constexpr double kSquareStart = 4;

/// Like fit(), for options.squares: a mesh within their budget, unless the bound needs more, with a small Σ (error /
/// bound)². REQUIRES: options.squares.
Result<Fitted> fit_squares(const grid::Raster& raster, tin::Triangulation tin, grid::VertexLattice lattice,
                           const FitOptions& options);

}  // namespace scarp::fit
