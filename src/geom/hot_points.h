// The hot points of snap rounding, and the ones that each segment passes; see arrangement.h.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/box_tree.h"
#include "geom/segments.h"

namespace scarp::geom {

class HotPoints {
 public:
  /// `points` are in raster order, without duplicates. With is_exact, a segment passes the points that lie on it;
  /// otherwise the points whose squares it meets. REQUIRES: the points include the ends of all segments passed to
  /// walk().
  HotPoints(std::vector<Point> points, std::span<const Segment> rigid, bool is_exact);

  const std::vector<Point>& points() const { return points_; }

  /// The points that each segment passes, segment by segment.
  struct Passes {
    std::vector<std::uint32_t> points;   ///< numbers of points
    std::vector<std::size_t> begins{0};  ///< segment k passes points[begins[k]] … points[begins[k + 1] − 1]
  };
  /// The points that each segment passes, in order, with both ends. Rigid segments pass the points on them. Cost: O(log
  /// n) per segment plus its points; less if successive segments are close to each other.
  Passes walk(std::span<const Segment> segments, bool are_rigid) const;

 private:
  enum class Meets { kNo, kCorner, kSquare };
  struct Candidate {
    std::int64_t along;
    std::uint32_t point;
    bool is_passed;  ///< false: the segment touches a corner that belongs to another square
  };
  Meets meets(const Segment& segment, std::uint32_t point) const;
  void add_candidate(const Segment& segment, bool only_on, std::uint32_t point,
                     std::vector<Candidate>& candidates) const;
  void pass(std::vector<Candidate>& candidates, Passes& passes) const;
  bool lies_on_falling_rigid(Point p) const;

  struct Falling {
    std::int32_t sum, first, last;  ///< sum: x + y; first, last: the range of x
  };

  std::vector<Point> points_;
  bool is_exact_;
  std::vector<Falling> falling_;  ///< rigid segments with constant x + y, unions of overlapping ones, sorted
  BoxTree tree_;
};

}  // namespace scarp::geom
