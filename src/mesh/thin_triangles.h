// Triangles so thin that they face up or down by the rounding of their corners.
#pragma once

#include "scarp/mesh.h"

namespace scarp {

/// Removes triangles, including folded ones, whose height over their longest side is below `thinnest`, seen from above.
/// The longest side is flipped if that increases the smaller height of its two triangles. If the longest side is on the
/// mesh's border and the opposite corner is inside, the triangle is dropped, and the corner becomes part of the border.
/// Other triangles are kept. Triangles less than `thinnest_border` high over a border edge that is their longest side
/// are dropped likewise, because heights may rise so steeply on them that the rounding of corners outweighs the area
/// lost. No vertex is lost. REQUIRES: shared vertices; triangles are counter-clockwise, except such folds. Cost:
/// O(triangles), plus a sort of them if one is thin.
void remove_thin_triangles(Mesh& mesh, double thinnest, double thinnest_border);

}  // namespace scarp
