// Triangles beyond a cut of the surface, taken out of the domain.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/point.h"
#include "scarp/result.h"
#include "tin/triangulation.h"

namespace scarp {

/// On which side of a cut a sample lies.
enum class CutSide : std::uint8_t { kBeyond, kOnWall, kWithin };

struct SurfaceCut {
  /// Edges of a graph, by indices of its points, that part what stays, on their positive side, from what goes.
  std::vector<std::array<std::uint32_t, 2>> walls;
  /// All around what stays, in kLatticeSteps: the walls, and along the sides of the raster's rectangle.
  std::vector<std::array<Point, 2>> outline;
  std::vector<CutSide> samples;  ///< row-major
};

/// Marks the triangles that a cut takes away as outside. `tin`: in kLatticeSteps; `vertices`: what the graph's points
/// are in it, kNone where they are not. Fails with kInput if nothing stays. REQUIRES: walls whose ends are in `tin` are
/// chains of constrained edges; no triangle of the domain has parts on both sides. Cost: O(triangles + walls); O(walls)
/// more for each part of the domain that touches walls in points only.
Result<void> cut_away(Triangulation& tin, std::int32_t cols, const SurfaceCut& cut, std::span<const Vertex> vertices);

}  // namespace scarp
