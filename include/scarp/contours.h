// Contour lines of a mesh.
#pragma once

#include <array>
#include <vector>

#include "scarp/mesh.h"
#include "scarp/result.h"

#pragma GCC visibility push(default)

namespace scarp {

/// A line at one height on a mesh. Each point lies on an edge of the mesh, and neighbours on edges of one triangle, so
/// the line follows the surface. The ground rises on its left.
struct Contour {
  double height = 0;                          ///< a multiple of the interval
  bool is_closed = false;                     ///< the last point joins the first, which is not repeated
  std::vector<std::array<double, 2>> points;  ///< absolute x and y; two at least, three of a closed line, no two
                                              ///< neighbours equal
};

/// The contours at all multiples of `interval` between the lowest and the highest vertex of a mesh that is z up, in the
/// unit of its heights. Within the max error of the mesh its heights are those of the raster, so a contour lies in the
/// raster's band of heights `height` ± max error.
///
/// A point on the edge from a to b, a the lower end, is a + (b − a) · (height − z of a) / (z of b − z of a) in double;
/// both triangles of the edge have the same. A vertex exactly at the height counts as above it, and its point is the
/// vertex itself: a plateau at the height has a line along its border where the ground around it is lower, a hollow at
/// the height has none, a ridge at the height has one line around it. A single vertex or edge at the height with lower
/// ground around it is omitted. So no line branches, lines touch at vertices at most, and each is closed or ends on the
/// border of the mesh, or at an edge that does not have exactly two triangles in opposite directions.
///
/// The order is by height, then by the first triangle that a line crosses; a line that is not closed begins where the
/// ground rises on its left, a closed one in its first triangle. Deterministic. Fails with kUsage if the interval is
/// not above 0 and finite, or so small that there are more than 1,000,000 heights. REQUIRES: indices in range, finite
/// positions, fewer than 2^32 / 3 triangles. Cost: O(n log n + length of the lines), 20 bytes a triangle and 16 a
/// segment while it runs.
Result<std::vector<Contour>> find_contours(const Mesh& mesh, double interval);

}  // namespace scarp

#pragma GCC visibility pop
