// Greedy insertion on scattered points: Algorithm III for samples that are not on a grid.
//
// A raster's triangle finds its samples by scanning. Here, every triangle stores a list of its points. Inserting a
// point changes only the triangles around it, so exactly the points in their lists are redistributed among these
// triangles, and measured at the same time. A point on an edge is in the list of one of the two triangles: both have
// the same height on the edge, and a comparison that rounding could decide is made in exact arithmetic.
//
// The domain is the convex hull, or a polygon within it that contains all points. Its corners are first inserted into
// the rectangle of the lattice, its edges are constrained, and triangles beyond them are marked outside, like those
// beyond the outline of a raster with nodata.
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

namespace scarp::refine {

/// A triangulation whose vertices are lattice points.
struct ScatteredDomain {
  tin::Triangulation tin;
  std::vector<std::uint32_t> point_of;  ///< by vertex; kNone for corners of the rectangle, and free vertices
  std::vector<std::vector<std::uint32_t>> outlines;  ///< rings of the points at the boundary's corners
  std::uint32_t unused = 0;                          ///< vertices without a point
  /// By vertex: heights of free vertices, which are not points; NaN for others. EMPTY: all vertices are points, as
  /// after refinement.
  std::vector<double> heights = {};
  double width = 0;  ///< extent of the hull across a line between two of its farthest corners, in units of x and y

  std::uint64_t vertex_count() const { return point_of.size() - unused; }
  bool is_free(tin::Vertex v) const { return !heights.empty() && !std::isnan(heights[v]); }
  bool is_unused(tin::Vertex v) const { return point_of[v] == tin::kNone && !is_free(v); }
  /// `of_points`: heights by point. REQUIRES: v is not unused.
  double height(tin::Vertex v, std::span<const double> of_points) const {
    return is_free(v) ? heights[v] : of_points[point_of[v]];
  }
  tin::Vertex insert(std::uint32_t point, Point at, const tin::Triangulation::Location& location);
  tin::Vertex insert_free(Point at, double z, const tin::Triangulation::Location& location);
};

/// The triangulation of the convex hull's corners. Fails with kInput if there are fewer than three points or all lie on
/// one line.
Result<ScatteredDomain> build_domain(const grid::SnappedPoints& points);
/// The triangulation of the corners of polygons, given as rings. Their inside, by the even-odd rule, contains all
/// points. Fails with kInput if rings cross.
Result<ScatteredDomain> build_domain(const grid::SnappedPoints& points,
                                     const std::vector<std::vector<std::uint32_t>>& outlines);

class ScatteredRefinement {
 public:
  /// Distributes all points. `heights`: the height of each point as a vertex (its z, or z rounded to float32).
  /// `bounds`: the threshold of each point, at most `threshold`; empty: `threshold` for all. All arguments must outlive
  /// this; no other code may change them.
  ScatteredRefinement(const grid::SnappedPoints& points, std::span<const double> heights, ScatteredDomain& domain,
                      double threshold, std::span<const double> bounds = {});

  /// True if no point exceeds the threshold.
  bool done() const { return queue_.empty(); }
  /// Error of the point to be inserted next, plus the threshold minus its bound if it has one; the threshold if done().
  double worst_error() const { return done() ? threshold_ : queue_.candidate(queue_.worst()).error; }
  bool is_full() const { return domain_.tin.triangle_count() > tin::kNone / 3 - 2; }
  /// Number of triangles that insert_worst() would add to the domain. REQUIRES: !done().
  std::uint32_t next_gain() const;
  /// Inserts the point with the largest error; ties: the northernmost row, then the westernmost column of the lattice.
  /// REQUIRES: !done().
  void insert_worst();
  /// Number of triangles that inserting a point would add to the domain; 0 if it is a vertex.
  std::uint32_t gain_at(std::uint32_t point) const;
  /// REQUIRES: gain_at(point) > 0.
  void insert(std::uint32_t point);
  /// The same at a known location.
  void insert_at(std::uint32_t point, const tin::Triangulation::Location& location);
  /// Inserts a free vertex. REQUIRES: no point is there.
  void insert_free(Point at, double z, const tin::Triangulation::Location& location);
  /// Triangles around the last inserted vertex: all that its insertion changed.
  const std::vector<tin::Triangle>& changed() const { return star_; }

  /// Flips edges so that fewer triangles are flat. A triangle is flat if all corners are marked points at one height.
  /// Every point remains within the threshold; constraints are kept. Returns the number of remaining flat triangles.
  /// REQUIRES: done(). The next insertion may flip edges back.
  std::uint64_t flip_flats(const std::vector<bool>& is_marked);

  std::uint64_t triangle_count() const { return inside_; }
  std::uint64_t points_scanned() const { return scanned_; }
  std::uint64_t lists_dealt() const { return dealt_; }

 private:
  class FlatRule;

  /// A triangle of the domain with its plane and, while points are distributed, its worst point. In a star, the first
  /// corner is the apex.
  struct Wedge {
    tin::Triangle triangle;
    std::array<Point, 3> corners;
    std::array<double, 3> heights;
    geom::Plane plane;
    metric::Candidate worst{-1, {}};
    std::uint32_t worst_point = tin::kNone;

    /// For p in the star: true if p lies in this closed triangle.
    bool holds(Point p) const {
      return orient(corners[0], corners[1], p) >= 0 && orient(corners[0], corners[2], p) <= 0;
    }
    void offer(double error, Point p, std::uint32_t point) {
      const metric::Candidate candidate{error, p};
      if (!metric::is_worse(candidate, worst)) return;
      worst = candidate;
      worst_point = point;
    }
  };

  void deal(tin::Vertex v);
  void settle(const Wedge& wedge);
  /// The error of a point in its triangle, as compared with the threshold.
  double error_of(const Wedge& wedge, std::uint32_t point) const {
    const double error = std::abs(wedge.plane.height_at(points_.at[point]) - points_.z[point]);
    return bounds_.empty() ? error : error + (threshold_ - bounds_[point]);
  }
  /// Bound of the rounding of error_of().
  double guard_of(const Wedge& wedge) const {
    return bounds_.empty() ? wedge.plane.guard : wedge.plane.guard + 0x1p-50 * threshold_;
  }
  bool exceeds(const Wedge& wedge, std::uint32_t point) const;
  Wedge wedge_of(tin::Triangle t, tin::Vertex apex) const;
  Wedge wedge_of(tin::Triangle t, const std::array<tin::Vertex, 3>& corners) const;
  void deal_out(tin::Vertex v);
  std::uint32_t gain(const tin::Triangulation::Location& location) const;

  const grid::SnappedPoints& points_;
  std::span<const double> heights_;
  ScatteredDomain& domain_;
  double threshold_;
  std::span<const double> bounds_;
  CandidateQueue queue_;
  std::vector<std::uint32_t> first_;  // by triangle: its list, kNone if it is empty
  std::vector<std::uint32_t> next_;   // by point: the next point in its list
  std::vector<std::uint32_t> worst_;  // by queued triangle: the point of its candidate
  std::vector<tin::Triangle> star_;
  std::vector<Wedge> wedges_;
  std::vector<std::uint32_t> lists_;
  std::uint64_t inside_ = 0, scanned_ = 0, dealt_ = 0;
};

}  // namespace scarp::refine
