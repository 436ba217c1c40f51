// Greedy insertion on scattered points: Algorithm III where the samples lie on no grid.
//
// A raster's triangle finds its samples by scanning; here every triangle keeps a list of the points in it. Inserting a
// point changes the triangles around it and no others, so the points of exactly these lists are dealt out anew among
// exactly these triangles, and measured by the way. A point on an edge is in the list of one of the two triangles: on
// the edge both have the same height, and a comparison that rounding could decide is made in exact arithmetic.
//
// The domain is the convex hull, or a polygon within it that holds all points: its corners are inserted into the
// rectangle of the lattice first, its edges are constrained, and what lies beyond is marked outside, as outside the
// outline of a raster with nodata.
//
// Cost: expected O(n log m) for n points and m insertions.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geom/plane.h"
#include "grid/snapped_points.h"
#include "refine/candidate_queue.h"
#include "scarp/result.h"
#include "tin/triangulation.h"

namespace scarp {

/// The workbench: a triangulation whose vertices are lattice points.
struct ScatteredDomain {
  Triangulation tin;
  std::vector<std::uint32_t> point_of;  ///< by vertex; kNone for corners of the rectangle, and free vertices
  std::vector<std::vector<std::uint32_t>> outlines;  ///< rings of the points at the corners of its boundary
  std::uint32_t unused = 0;                          ///< vertices without a point
  /// By vertex, of free vertices, which are no points; others: NaN. EMPTY: all are points, as refinement makes them.
  std::vector<double> heights = {};
  double width = 0;  ///< how far the hull reaches across a line between two of its farthest corners, as x and y

  std::uint64_t vertex_count() const { return point_of.size() - unused; }
  bool is_free(Vertex v) const { return !heights.empty() && !std::isnan(heights[v]); }
  bool is_unused(Vertex v) const { return point_of[v] == kNone && !is_free(v); }
  /// `of_points`: heights by point. REQUIRES: not unused.
  double height(Vertex v, std::span<const double> of_points) const {
    return is_free(v) ? heights[v] : of_points[point_of[v]];
  }
  Vertex insert(std::uint32_t point, Point at, const Triangulation::Location& location);
  Vertex insert_free(Point at, double z, const Triangulation::Location& location);
};

/// The triangulation of the convex hull's corners. Fails with kInput if there are fewer than three points or all lie on
/// one line.
Result<ScatteredDomain> build_domain(const SnappedPoints& points);
/// The triangulation of the corners of polygons, given as rings, whose inside by the rule of even and odd holds all
/// points. Fails with kInput where rings cross.
Result<ScatteredDomain> build_domain(const SnappedPoints& points,
                                     const std::vector<std::vector<std::uint32_t>>& outlines);

class ScatteredRefinement {
 public:
  /// Deals out all points. `heights`: the height of a point as a vertex (its z, or that rounded to float32), by point.
  /// `bounds`: the threshold of each point, at most `threshold`; empty: that for all. All arguments stay alive and are
  /// changed by no other code.
  ScatteredRefinement(const SnappedPoints& points, std::span<const double> heights, ScatteredDomain& domain,
                      double threshold, std::span<const double> bounds = {});

  /// No point exceeds the threshold any more.
  bool done() const { return queue_.empty(); }
  /// Error of the point to be inserted next, with a bound of its own raised by what that is below the threshold; the
  /// threshold if done().
  double worst_error() const { return done() ? threshold_ : queue_.candidate(queue_.worst()).error; }
  bool is_full() const { return domain_.tin.triangle_count() > kNone / 3 - 2; }
  /// How many triangles of the domain insert_worst() would add. REQUIRES: !done().
  std::uint32_t next_gain() const;
  /// Inserts the point with the largest error; ties: the northernmost row, then the westernmost column of the lattice.
  /// REQUIRES: !done().
  void insert_worst();
  /// How many triangles of the domain the insertion of a point would add; 0 if it is a vertex.
  std::uint32_t gain_at(std::uint32_t point) const;
  /// REQUIRES: gain_at(point) > 0.
  void insert(std::uint32_t point);
  /// The same at a known location.
  void insert_at(std::uint32_t point, const Triangulation::Location& location);
  /// Inserts a free vertex. REQUIRES: no point is there.
  void insert_free(Point at, double z, const Triangulation::Location& location);
  /// Triangles around the vertex that was inserted last: all that this changed.
  const std::vector<Triangle>& changed() const { return star_; }

  /// Flips edges so that fewer triangles are flat: all corners among the marked points, at one height. Every point
  /// stays within the threshold, constraints stay. Returns how many are left. REQUIRES: done(). The next insertion may
  /// flip edges back.
  std::uint64_t flip_flats(const std::vector<bool>& is_marked);

  std::uint64_t triangle_count() const { return inside_; }
  std::uint64_t points_scanned() const { return scanned_; }
  std::uint64_t lists_dealt() const { return dealt_; }

 private:
  class FlatRule;

  /// A triangle of the domain with its plane and, while points are dealt out, the worst of them. As part of a star it
  /// has its apex as first corner.
  struct Wedge {
    Triangle triangle;
    std::array<Point, 3> corners;
    std::array<double, 3> heights;
    Plane plane;
    Candidate worst{-1, {}};
    std::uint32_t worst_point = kNone;

    /// For p in the star: whether it lies in this triangle, closed.
    bool holds(Point p) const {
      return orient(corners[0], corners[1], p) >= 0 && orient(corners[0], corners[2], p) <= 0;
    }
    void offer(double error, Point p, std::uint32_t point) {
      const Candidate candidate{error, p};
      if (!is_worse(candidate, worst)) return;
      worst = candidate;
      worst_point = point;
    }
  };

  void deal(Vertex v);
  void settle(const Wedge& wedge);
  /// The error of a point in its triangle, as compared with the threshold.
  double error_of(const Wedge& wedge, std::uint32_t point) const {
    const double error = std::abs(wedge.plane.height_at(points_.at[point]) - points_.z[point]);
    return bounds_.empty() ? error : error + (threshold_ - bounds_[point]);
  }
  /// By how much error_of() may be off.
  double guard_of(const Wedge& wedge) const {
    return bounds_.empty() ? wedge.plane.guard : wedge.plane.guard + 0x1p-50 * threshold_;
  }
  bool exceeds(const Wedge& wedge, std::uint32_t point) const;
  Wedge wedge_of(Triangle t, Vertex apex) const;
  Wedge wedge_of(Triangle t, const std::array<Vertex, 3>& corners) const;
  void deal_out(Vertex v);
  std::uint32_t gain(const Triangulation::Location& location) const;

  const SnappedPoints& points_;
  std::span<const double> heights_;
  ScatteredDomain& domain_;
  double threshold_;
  std::span<const double> bounds_;
  CandidateQueue queue_;
  std::vector<std::uint32_t> first_;  // by triangle: its list, kNone if it is empty
  std::vector<std::uint32_t> next_;   // by point: the next one in its list
  std::vector<std::uint32_t> worst_;  // by queued triangle: the point of its candidate
  std::vector<Triangle> star_;
  std::vector<Wedge> wedges_;
  std::vector<std::uint32_t> lists_;
  std::uint64_t inside_ = 0, scanned_ = 0, dealt_ = 0;
};

}  // namespace scarp
