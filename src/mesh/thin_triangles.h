// Triangles so thin that the rounding of their corners decides which way they face.
#pragma once

#include "scarp/mesh.h"

namespace scarp {

/// Removes triangles that are, seen from above, less than `thinnest` high over their longest side, folded ones
/// included: the longest side is flipped where that raises the lower of its two triangles; where it is the mesh's
/// border and the corner across lies inside, the triangle is dropped, and its corner becomes part of the border.
/// Triangles that neither helps stay. Triangles less than `thinnest_border` high over a border edge that is their
/// longest side are dropped likewise: across such a one heights may rise so steeply that the rounding of its corners
/// costs more than the sliver of plan is worth. No vertex is lost. REQUIRES: shared vertices, triangles
/// counter-clockwise up to such folds. Cost: O(triangles), and a sort of them if there is a thin one.
void remove_thin_triangles(Mesh& mesh, double thinnest, double thinnest_border);

}  // namespace scarp
