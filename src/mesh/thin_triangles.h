// Triangles so thin that the rounding of their corners decides which way they face.
#pragma once

#include "scarp/mesh.h"

namespace scarp {

/// Removes triangles whose height over their longest side, seen from above, is below `thinnest`, including folded ones.
/// The longest side is flipped if that increases the smaller height of its two triangles. If it is on the mesh's border
/// and the opposite corner is inside, the triangle is dropped, and the corner becomes part of the border. Other
/// triangles are kept. Triangles less than `thinnest_border` high over a border edge that is their longest side are
/// dropped likewise. On those, heights may rise so steeply that the rounding of corners outweighs the area lost. No
/// vertex is lost. REQUIRES: shared vertices, triangles counter-clockwise up to such folds. Cost: O(triangles), plus a
/// sort of them if one is thin.
void remove_thin_triangles(Mesh& mesh, double thinnest, double thinnest_border);

}  // namespace scarp
