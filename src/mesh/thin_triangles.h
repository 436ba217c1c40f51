// Triangles so thin that the rounding of their corners decides whether they face up or down.
#pragma once

#include "scarp/mesh.h"

namespace scarp::mesh {

/// Removes triangles, including folded ones, if their height over the longest side, seen from above, is below
/// `thinnest`. The longest side is flipped if that increases the smaller height of its two triangles. If the longest
/// side is on the mesh's border and the opposite corner is inside, the triangle is dropped, and the corner becomes part
/// of the border. Other triangles are kept. A triangle whose longest side is a border edge is also dropped if its
/// height over it is below `thinnest_border`. Heights may rise so steeply on it that the rounding of corners outweighs
/// the area lost. No vertex is lost. REQUIRES: shared vertices; triangles are counter-clockwise, except folded ones.
/// Cost: O(triangles), plus a sort of them if one is thin.
void remove_thin_triangles(Mesh& mesh, double thinnest, double thinnest_border);

}  // namespace scarp::mesh
