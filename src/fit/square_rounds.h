// A mesh of a given size with the least squared error.
//
// A mesh for the least max error of a size is another than that for the least squared error: with n triangles the best
// density is a power of the curvature, ½ for the one, ⅓ for the other. So no bound leads there. Instead:
//
//   start        a refined mesh of some kSquareStart times the triangles
//   reduction    the cheapest vertex goes first, its price the rise of Σ e²; its neighbours make a step each
//   sweeps       flips of all edges, a Gauss–Newton step of all vertices, each with its exact best height
//   exchanges    a tenth of the vertices go, as many come where they gain most, then sweeps; undone where Σ e² has
//                not fallen
//   sweeps
//
// All of it within the bound, which is proven as ever. Larger meshes are worked on in patches, whose shares of the
// triangles follow from theory: E of n triangles falls as n⁻², so the marginal gains are equal where n ~ (E n²)^⅓.
// Patches are cut anew for each round, on squares shifted against each other.
#pragma once

#include "fit/fit.h"

namespace scarp {

/// Times the triangles that are wanted: what reduction likes to begin with. On Fuji 1, 2, 4 and 6 times lead to an RMSE
/// of 6.86, 6.4, 6.28 and 6.26.
inline constexpr double kSquareStart = 4;

/// Like fit(), but for options.squares: as many triangles and vertices as they ask for, or fewer, unless the bound
/// needs more, with a small Σ (error / bound)². REQUIRES: options.squares.
Result<Fitted> fit_squares(const Raster& raster, Triangulation tin, VertexLattice lattice, const FitOptions& options);

}  // namespace scarp
