// The number of polygons that cover each side of their edges.
//
// Polygons are rings of a planar graph: nothing crosses (arrangement.h), but rings may run along each other, and over
// themselves. Within one polygon rings count even-odd, so of each polygon those edges count that it passes an odd
// number of times. A sweep over them alone finds on which side of each the polygon lies; a sweep over all adds that up.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/point.h"

namespace scarp {

/// Vertices of an edge, the lower number first.
using GraphEdge = std::array<std::uint32_t, 2>;

/// An edge that a ring of a polygon passes, once more for each time.
struct PolygonEdge {
  std::uint32_t polygon;
  GraphEdge edge;
  friend bool operator==(const PolygonEdge&, const PolygonEdge&) = default;
};

/// Polygons that hold the points next to an edge: on its positive side, where orient(edge[0], edge[1], p) > 0, and on
/// the other one.
struct EdgeCover {
  std::int32_t positive = 0, negative = 0;
};

/// The cover of each of `edges`. REQUIRES: `vertices` in raster order, each once; `edges` sorted, each once, those of
/// polygons among them; two edges have no point in common but a common end. Cost: O(n log n).
std::vector<EdgeCover> cover_edges(std::span<const Point> vertices, std::span<const GraphEdge> edges,
                                   std::vector<PolygonEdge> passes);

}  // namespace scarp
