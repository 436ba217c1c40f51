// Arrangements: lines prepared for a triangulation, cut at their crossings in vertices on the lattice.
//
// Crossings of lattice segments are fractions. Rounding them bends the segments, and bent ones may cross anew. Snap
// rounding (Hobby 1999; Guibas and Marimont 1998) has the cure: a lattice point is hot if a segment ends there or a
// crossing is rounded to it, and every segment is led through all hot points whose unit squares (half open, centred on
// them) it meets. Then nothing crosses, whatever the input. Here all of it is decided in integers.
//
// Two things are our own. Rigid segments run along the axes or the diagonals, so they meet no square but those of
// lattice points on themselves, except that a falling diagonal (x + y constant) touches corners of others. A corner on
// such a segment is moved from the square that it would belong to to the one on the segment: squares stay convex and
// stay a partition, which is all that the proof needs, and rigid segments never bend. The proof has one gap: a hot
// point exactly on a bent piece between two such corners splits the piece where it is. And where all crossings are
// lattice points nothing needs rounding: lines that cross only in vertices come back as they are.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geom/segments.h"

namespace scarp {

/// Polylines in one array.
struct Polylines {
  std::vector<Point> points;
  std::vector<std::uint32_t> begins{0};  ///< line k is points[begins[k]] … points[begins[k + 1] − 1]

  std::size_t size() const { return begins.size() - 1; }
  std::span<const Point> operator[](std::size_t line) const {
    return std::span(points).subspan(begins[line], begins[line + 1] - begins[line]);
  }
  void add(std::span<const Point> line) {
    points.insert(points.end(), line.begin(), line.end());
    begins.push_back(static_cast<std::uint32_t>(points.size()));
  }
};

struct Arrangement {
  /// Between two vertices, the lower number first.
  struct Edge {
    std::uint32_t a, b;
    bool is_rigid;  ///< part of a rigid segment
    bool is_line;   ///< part of a line; both may be true
    friend bool operator==(const Edge&, const Edge&) = default;
  };
  /// A vertex that a line passes.
  struct Stop {
    std::uint32_t vertex;
    std::uint32_t segment;  ///< segment of the line: from its points[segment] to points[segment + 1]
    double fraction;        ///< fraction of that segment, 0 … 1; (segment, fraction) never decreases along a chain
  };
  /// The part of one segment in a chain: it runs through passes[first] … passes[last], backwards where last < first.
  struct Stretch {
    std::uint32_t segment;  ///< segment of the line
    std::uint32_t first, last;
    double begin, end;  ///< ends of the segment within the rectangle, as fractions of the whole
  };
  /// The result for a line, or for one part of it in the rectangle: at least two vertices, successive ones differ.
  struct Chain {
    std::uint32_t line;
    std::uint32_t begin, end;  ///< stretches[begin] … stretches[end − 1], each begins where the one before ends
  };

  std::vector<Point> vertices;  ///< in raster order, each once, each the end of an edge
  std::vector<Edge> edges;      ///< by (a, b), each once
  /// The vertices along each union of segments that lie upon each other, one union after the other: what many lines
  /// share stands here once.
  std::vector<std::uint32_t> passes;
  std::vector<Stretch> stretches;
  std::vector<Chain> chains;  ///< in the order of the lines and along each
  bool is_exact = true;       ///< all crossings were lattice points, so nothing moved but cut ends

  /// Calls visit(stop) for the vertices of a stretch, in the order of the line.
  template <class Visit>
  void visit_stops(const Stretch& stretch, Visit&& visit) const {
    const Point from = vertices[passes[stretch.first]], to = vertices[passes[stretch.last]];
    const std::int64_t dx = to.x - from.x, dy = to.y - from.y;
    const auto whole = static_cast<double>(dx * dx + dy * dy);
    const std::uint32_t step = stretch.first < stretch.last ? 1u : ~0u;
    for (std::uint32_t k = stretch.first;; k += step) {
      const Point p = vertices[passes[k]];
      const double along = static_cast<double>(dx * (p.x - from.x) + dy * (p.y - from.y)) / whole;
      visit(Stop{passes[k], stretch.segment, stretch.begin + along * (stretch.end - stretch.begin)});
      if (k == stretch.last) return;
    }
  }
  std::span<const Stretch> stretches_of(const Chain& chain) const {
    return std::span(stretches).subspan(chain.begin, chain.end - chain.begin);
  }
  /// All of a chain, each vertex between two stretches once.
  std::vector<Stop> stops_of(const Chain& chain) const;
};

/// Cuts lines to [0, width] × [0, height] and arranges them with rigid segments.
///
/// (1) Two edges have no point in common but a common end; no vertex lies on an edge without being its end. (2) Every
/// two successive stops of a chain are an edge; each edge is part of a line or of a rigid segment. (3) The edges with
/// is_rigid cover the rigid segments and nothing else. (4) A line's vertex in the rectangle is a stop at its own place;
/// all other stops, and so all points of a chain, lie within 1/2 of their segment in each coordinate, within 1 if the
/// rectangle cuts it. (5) Arranging the edges with the same rigid segments changes nothing. (6) Vertices and edges do
/// not depend on the order or the direction of lines.
///
/// Chains of one vertex are omitted: lines of no extent, or touched by the rectangle alone.
/// REQUIRES: 0 < width, height <= kMaxCoordinate; rigid segments lie in the rectangle, run along axes or diagonals
/// between points of even coordinates, and are no points. Lines may be anything.
/// Cost: O((n + k) log n) for n segments and k crossings that are not crowded; two to three seconds for a million
/// segments (bench/speed/speed_lines.cpp). n segments that overlap on one line cost no more, and as many passes.
Arrangement arrange(const Polylines& lines, std::span<const Segment> rigid, std::int32_t width, std::int32_t height);

}  // namespace scarp
