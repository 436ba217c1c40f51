// The workbench: a constrained Delaunay triangulation of lattice points that grows one point at a time.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/array.h"
#include "geom/predicates.h"

namespace scarp::tin {

using Vertex = std::uint32_t;
using Triangle = std::uint32_t;
using HalfEdge = std::uint32_t;  ///< 3·triangle + corner: runs from that corner to the next
inline constexpr std::uint32_t kNone = 0xffffffffu;

class Triangulation;

/// A rule for flipping edges instead of the Delaunay property.
class FlipRule {
 public:
  virtual ~FlipRule() = default;
  /// True if the diagonal h should be flipped. h = a→b lies in (a, b, c), its twin in (b, a, d). It is neither
  /// constrained nor on the border. After a flip triangle h / 3 is (c, d, b), its neighbour (d, c, a). May be true only
  /// if both new triangles are positive.
  virtual bool should_flip(const Triangulation& tin, HalfEdge h) = 0;
};

/// Flat arrays with 32-bit ids. Half-edge 3t + k runs from corner k of triangle t to corner k + 1. All triangles are
/// positive (orient() > 0). The triangulation always covers its initial rectangle. It has points and constraints but no
/// heights; callers give edges and triangles their meaning.
///
/// Constrained edges are never flipped. Every other edge between two triangles is locally Delaunay (no corner strictly
/// inside the neighbour's circle; cocircular ties keep the present edge), unless points were inserted under another
/// rule. There is no recursion, tolerance or randomness: the same insertions in the same order give the same arrays.
///
/// Triangle slots are reused: inserting a point changes only the triangles around it and adds at most two ids at the
/// end (two on an interior edge or inside a triangle).
class Triangulation {
 public:
  /// The rectangle [0, cols − 1] × [0, rows − 1] as two triangles, with the diagonal from south-west to north-east
  /// (from the last row's first sample to the first row's last), as in the paper's program.
  /// REQUIRES: cols, rows in 2 … kMaxCoordinate + 1.
  Triangulation(std::int32_t cols, std::int32_t rows);

  /// The triangulation's arrays, for code that changes many triangles at once.
  struct Arrays {
    static constexpr std::uint8_t kOutside = 8;
    Array<Point> points;
    Array<Vertex> corners;      ///< 3 per triangle
    Array<HalfEdge> twins;      ///< 3 per triangle
    Array<std::uint8_t> flags;  ///< bits 0..2: edge k is constrained; kOutside
  };
  /// REQUIRES: positive triangles that cover a rectangle, with equal links and constraints on both sides of every edge.
  explicit Triangulation(Arrays arrays);

  std::size_t vertex_count() const { return points_.size(); }
  std::size_t triangle_count() const { return flags_.size(); }
  Point point(Vertex v) const { return points_[v]; }
  Vertex origin(HalfEdge h) const { return corners_[h]; }
  HalfEdge twin(HalfEdge h) const { return twins_[h]; }  ///< kNone on the rectangle's border
  std::array<Point, 3> corners(Triangle t) const {
    return {points_[corners_[3 * t]], points_[corners_[3 * t + 1]], points_[corners_[3 * t + 2]]};
  }
  static Triangle triangle_of(HalfEdge h) { return h / 3; }
  static HalfEdge next(HalfEdge h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static HalfEdge previous(HalfEdge h) { return h % 3 == 0 ? h + 2 : h - 1; }

  bool is_constrained(HalfEdge h) const { return (flags_[h / 3] >> (h % 3)) & 1; }
  /// Triangles marked outside are not part of the domain. Insertion preserves the mark.
  bool is_outside(Triangle t) const { return (flags_[t] & kOutside) != 0; }
  void set_outside(Triangle t, bool outside);

  struct Location {
    enum class Kind { kInside, kOnEdge, kOnVertex } kind = Kind::kInside;
    HalfEdge edge = 0;  ///< kInside: any half-edge of the triangle; kOnEdge: the edge (its lower half-edge); kOnVertex:
                        ///< an edge that starts there
  };
  /// Walks from `hint` (any triangle) to the point. REQUIRES: p in the rectangle. Cost: expected O(√triangles), O(1)
  /// near the hint.
  Location locate(Point p, Triangle hint) const;
  /// Like locate(). REQUIRES: t contains p (closed).
  Location locate_in(Point p, Triangle t) const;

  /// Inserts p and restores the Delaunay property, or that of `rule`, for edges opposite to the new vertex. Each flip
  /// adds a spoke, so this terminates. Returns the vertex at p. Both halves of a constrained edge stay constrained; p
  /// may lie off this edge if all four triangles are positive. Cost: expected O(1).
  Vertex insert(Point p, Location location, FlipRule* rule = nullptr);

  /// Applies the rule to the listed edges, and again to the four edges around each flip, until no edge flips or `most`
  /// were flipped. Empties the list.
  void improve(std::vector<HalfEdge>& edges, FlipRule& rule, std::size_t most);

  /// Multiplies all coordinates to make room for points in between. REQUIRES: no coordinate exceeds kMaxCoordinate
  /// afterwards. Edges between cocircular points do not change.
  void scale(std::int32_t factor) {
    for (Point& p : points_) p = {p.x * factor, p.y * factor};
  }

  /// Triangles with v as a corner, in cyclic order (from border to border for v on the rectangle's border).
  void star(Vertex v, std::vector<Triangle>& triangles) const;

  /// Makes the segment between two vertices a chain of constrained edges; vertices on the segment become part of the
  /// chain. Returns false, without change, if the segment would cross a constrained edge. REQUIRES: a != b.
  bool constrain(Vertex a, Vertex b);

  /// Removes the constraint of an edge, on both sides.
  void release(HalfEdge h);

  /// A triangle at the vertex that was inserted last: a good hint for locate().
  Triangle last_touched() const { return last_; }

  /// The next two functions release memory. Without links, twins and insertion are unavailable; without triangles, only
  /// vertices remain.
  void drop_links() { twins_.release(); }
  /// Returns the corners of all inside triangles, 3 each, and releases all but the vertices. REQUIRES: no links.
  Array<Vertex> take_corners();

  /// The half-edge from a to b; kNone if they are not neighbours. Cost: a walk to a, O(1) if a was touched last.
  HalfEdge find_edge(Vertex a, Vertex b) const;

 private:
  friend class Assembly;
  static constexpr std::uint8_t kOutside = Arrays::kOutside;

  Triangulation() = default;

  /// The path of a segment from a vertex: the edges it crosses (each from its right end to its left end), then the
  /// first vertex it reaches.
  struct Passage {
    std::vector<HalfEdge> crossed;
    Vertex reached = kNone;
  };

  Triangle new_triangle();
  void set_triangle(Triangle t, Vertex a, Vertex b, Vertex c, bool outside);
  void link(HalfEdge h, HalfEdge g);
  /// The neighbour and constraint of an edge that is being replaced.
  struct Side {
    HalfEdge twin;
    bool constrained;
  };
  Side side(HalfEdge h) const { return {twins_[h], is_constrained(h)}; }
  void attach(HalfEdge h, Side side);
  void set_constrained(HalfEdge h);
  bool is_free(HalfEdge h) const { return twins_[h] != kNone && !is_constrained(h); }
  bool should_flip(HalfEdge h) const;
  void flip(HalfEdge h);
  void legalize_star(FlipRule* rule);
  HalfEdge edge_out_of(Vertex v) const;
  Passage passage(Vertex from, Vertex to) const;
  void force_edge(Vertex a, Vertex b, const std::vector<HalfEdge>& crossed);

  Array<Point> points_;
  Array<Vertex> corners_;          // 3 per triangle
  Array<HalfEdge> twins_;          // 3 per triangle
  Array<std::uint8_t> flags_;      // bits 0..2: edge k constrained; bit 3: outside
  std::vector<HalfEdge> pending_;  // explicit stack of edges to test
  Triangle last_ = 0;              // a triangle at the vertex that was touched last
};

}  // namespace scarp::tin
