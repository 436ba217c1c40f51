// The hot points of snap rounding and which of them a segment passes; see arrangement.h.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geom/box_tree.h"
#include "geom/segments.h"

namespace scarp {

class HotPoints {
 public:
  /// `points` in raster order, each once. With is_exact a segment passes the points that lie on it, else those whose
  /// squares it meets. REQUIRES: the ends of all segments that walk() will be asked for are among them.
  HotPoints(std::vector<Point> points, std::span<const Segment> rigid, bool is_exact);

  const std::vector<Point>& points() const { return points_; }

  /// A point that a segment passes: its number, and how far along it lies, 0 … 1.
  struct Pass {
    std::uint32_t point;
    double fraction;
  };
  /// The points that the segment passes, both ends included, in order. A rigid one passes points that lie on it.
  void walk(const Segment& segment, bool is_rigid, std::vector<Pass>& passes);

 private:
  enum class Meets { kNo, kCorner, kSquare };
  struct Candidate {
    std::int64_t along;
    std::uint32_t point;
    bool is_passed;  ///< else the segment touches a corner that belongs to another square
  };
  Meets meets(const Segment& segment, std::uint32_t point) const;
  bool lies_on_falling_rigid(Point p) const;

  struct Falling {
    std::int32_t sum, first, last;  ///< x + y; x from … to
  };

  std::vector<Point> points_;
  bool is_exact_;
  std::vector<Falling> falling_;  ///< rigid segments with constant x + y, unions of overlapping ones, sorted
  BoxTree tree_;
  std::vector<Candidate> candidates_;
};

}  // namespace scarp
