// The number of polygons covering each side of an edge.
//
// Polygons are rings of a planar graph. Edges do not cross (arrangement.h), but rings may overlap each other and
// themselves. Each polygon follows the even-odd rule, so only the edges that it passes an odd number of times count. A
// sweep over these edges finds on which side of each edge the polygon lies. A second sweep, over all edges, sums the
// results.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/point.h"

namespace scarp::geom {

/// Vertices of an edge, the lower number first.
using GraphEdge = std::array<std::uint32_t, 2>;

/// An edge that a ring of a polygon passes; repeated for each pass.
struct PolygonEdge {
  std::uint32_t polygon;
  GraphEdge edge;
  friend bool operator==(const PolygonEdge&, const PolygonEdge&) = default;
};

/// The numbers of polygons on both sides of an edge: the positive side, where orient(edge[0], edge[1], p) > 0, and the
/// other.
struct EdgeCover {
  std::int32_t positive = 0, negative = 0;
};

/// The cover of each of `edges`. REQUIRES: distinct `vertices` in raster order; sorted, distinct `edges`, which include
/// those of polygons; two edges share at most a common end. Cost: O(n log n).
std::vector<EdgeCover> cover_edges(std::span<const Point> vertices, std::span<const GraphEdge> edges,
                                   std::vector<PolygonEdge> passes);

}  // namespace scarp::geom
