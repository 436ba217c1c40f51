// Conversion of mesh positions to grid positions.
#pragma once

#include <vector>

#include "scarp/height_field.h"
#include "scarp/mesh.h"

namespace scarp::draw {

struct GridPositions {
  std::vector<double> cols, rows;  ///< by vertex; NaN where the inversion failed
};

/// Fractional grid positions of the mesh's vertices. Newton's method inverts frames with a transform, to about a
/// hundredth of a sample. Cost: O(vertices); some 15 evaluations of a transform per vertex.
GridPositions find_grid_positions(const Frame& frame, int cols, int rows, const Mesh& mesh);

/// Ground lengths of one column step and one row step at the middle of the grid, in the frame's units. NaN if the frame
/// has no image there.
std::array<double, 2> step_lengths(const Frame& frame, int cols, int rows);

}  // namespace scarp::draw
