// Arrangements prepare lines for a triangulation: they split lines at their crossings by vertices on the lattice.
//
// Crossings of lattice segments are fractions. Rounding them bends the segments, and bent segments may cross again.
// Snap rounding (Hobby 1999; Guibas and Marimont 1998) solves this. A lattice point is hot if a segment ends there or a
// crossing is rounded to it. Every segment is routed through all hot points whose unit squares (half open, centred on
// them) it meets. Then no segments cross, for any input. All decisions here use integers.
//
// This implementation adds two things. First, rigid segments never bend. They run along the axes or the diagonals, so
// they meet only the squares of lattice points that lie on them, except that a falling diagonal (x + y constant) also
// touches corners of other squares. A corner on such a diagonal is assigned to the square on the diagonal. The squares
// remain convex and a partition, which is all that the proof needs. The proof has one gap: a hot point exactly on a
// bent piece between two such corners. This point splits the piece. Second, if all crossings are lattice points,
// nothing is rounded: lines that cross only at vertices are returned unchanged.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geom/segments.h"

namespace scarp::geom {

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
  /// An edge between two vertices, the one with the lower number first.
  struct Edge {
    std::uint32_t a, b;
    bool is_rigid;  ///< part of a rigid segment
    bool is_line;   ///< part of a line; an edge may be both
    friend bool operator==(const Edge&, const Edge&) = default;
  };
  /// A vertex on a line.
  struct Stop {
    std::uint32_t vertex;
    std::uint32_t segment;  ///< segment of the line, from points[segment] to points[segment + 1]
    double fraction;        ///< position in that segment, 0 … 1; (segment, fraction) never decreases along a chain
  };
  /// One segment's part of a chain: passes[first] … passes[last], in reverse order if last < first.
  struct Stretch {
    std::uint32_t segment;  ///< segment of the line
    std::uint32_t first, last;
    double begin, end;  ///< ends of the segment within the rectangle, as fractions of the whole
  };
  /// The result for a line, or for one part of the line in the rectangle: at least two vertices; successive ones are
  /// distinct.
  struct Chain {
    std::uint32_t line;
    std::uint32_t begin, end;  ///< stretches[begin] … stretches[end − 1]; each begins where the previous one ends
  };

  std::vector<Point> vertices;  ///< in raster order, without duplicates; each is the end of an edge
  std::vector<Edge> edges;      ///< by (a, b), without duplicates
  /// The vertices along each union of overlapping segments, union by union. Vertices shared by many lines are stored
  /// once.
  std::vector<std::uint32_t> passes;
  std::vector<Stretch> stretches;
  std::vector<Chain> chains;  ///< by line, then along the line
  bool is_exact = true;       ///< all crossings were lattice points, so only clipped ends moved

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
  /// All stops of a chain; a vertex between two stretches appears once.
  std::vector<Stop> stops_of(const Chain& chain) const;
};

/// Clips lines to [0, width] × [0, height] and arranges them with rigid segments.
///
/// (1) Two edges share at most a common end; a vertex on an edge is an end of this edge. (2) Every two successive stops
/// of a chain are joined by an edge; each edge is part of a line or of a rigid segment. (3) The edges with is_rigid
/// cover exactly the rigid segments. (4) A line's vertex in the rectangle is a stop at the vertex's own place. All
/// other stops, and so all points of a chain, lie within 1/2 of their segment in each coordinate, or within 1 if the
/// rectangle clips the segment. (5) Arranging the edges again with the same rigid segments changes nothing. (6)
/// Vertices and edges do not depend on the order or the direction of lines.
///
/// Chains of one vertex are omitted: lines without extent, or lines that touch the rectangle in a point. REQUIRES: 0 <
/// width, height <= kMaxCoordinate; rigid segments lie in the rectangle, are not points, and run along axes or
/// diagonals between points of even coordinates. Lines may be arbitrary. Cost: O((n + k) log n) for n segments and k
/// crossings that are not crowded; two to three seconds for a million segments (bench/speed/speed_lines.cpp). Neither n
/// segments that overlap on one line nor n traversals of one line cost more.
Arrangement arrange(const Polylines& lines, std::span<const Segment> rigid, std::int32_t width, std::int32_t height);

}  // namespace scarp::geom
