// Where the vertices of a mesh lie in the grid of its field.
#pragma once

#include "base/array.h"
#include "scarp/height_field.h"
#include "scarp/mesh.h"
#include "scarp/result.h"

namespace scarp::judge {

/// A vertex in plan coordinates, and its height.
struct FacetCorner {
  double x, y, z;
};

/// Vertices in columns, rows and heights.
struct GridPlaces {
  Array<FacetCorner> corners;  ///< by vertex
  bool are_on_lattice = true;  ///< all columns and rows are multiples of 1/256
};

/// As GridMap says. kInput for a vertex that is out of reach (check_mesh.h). REQUIRES: an affine frame that can be
/// inverted. The result does not depend on threads.
Result<GridPlaces> place_on_grid(const HeightField& field, const Mesh& mesh, int threads);

}  // namespace scarp::judge
