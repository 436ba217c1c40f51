// Removes triangles beyond a cutline from the domain.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/point.h"
#include "grid/cut_rows.h"
#include "tin/triangulation.h"

namespace scarp::lines {

struct SurfaceCut {
  /// Edges of a graph, by indices of its points, that separate the remaining side (positive) from the removed side.
  std::vector<std::array<std::uint32_t, 2>> walls;
  /// The border of the remaining part, in kLatticeSteps: the walls, and parts of the raster's rectangle.
  std::vector<std::array<Point, 2>> outline;
  std::shared_ptr<const grid::CutRows> rows;  ///< rows of the outline of the whole raster
  std::int32_t first = 0;                     ///< index in `rows` of the first row of samples here
};

/// The error message if nothing remains.
inline constexpr const char* kNothingInCutline = "no part of the raster's surface lies in the cutline";

/// Marks the triangles that a cut removes as outside. `tin` is in kLatticeSteps. `vertices`: vertex of each point of
/// the graph, kNone if absent. Returns true if something remains. REQUIRES: walls with both ends in `tin` are chains of
/// constrained edges; no triangle of the domain has parts on both sides. Cost: O(triangles + walls), plus O(walls) for
/// each part of the domain that touches walls in points only.
bool cut_away(tin::Triangulation& tin, const SurfaceCut& cut, std::span<const tin::Vertex> vertices);

}  // namespace scarp::lines
