// Clipping of segments between lattice points to a rectangle, and their crossings.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/function_ref.h"
#include "base/point.h"

namespace scarp::geom {

struct Segment {
  Point from, to;
};

struct ClippedSegment {
  Segment segment;
  double begin = 0, end = 1;  ///< ends within the rectangle, as fractions of the whole
};

/// Clips a segment with any coordinates to [0, width] × [0, height]. Where the segment crosses the border, its end
/// becomes the border's lattice point nearest to the crossing, whatever the direction of the segment. Returns false if
/// at most a point remains.
bool clip_segment(const Segment& segment, std::int32_t width, std::int32_t height, ClippedSegment& clipped);

/// True if x + y is constant along the segment.
inline bool is_antidiagonal(const Segment& s) { return s.to.x - s.from.x == s.from.y - s.to.y; }

/// Calls visit(a, b), maybe repeatedly, for each pair of segments that may share a point. REQUIRES: no segment is a
/// point; coordinates in [0, kMaxCoordinate]. Cost: as for find_crossings().
void visit_neighbours(std::span<const Segment> segments, FunctionRef<void(std::uint32_t, std::uint32_t)> visit);

struct Crossings {
  std::vector<Point> points;  ///< in raster order, distinct
  bool are_exact = true;      ///< all are lattice points, so none was rounded
};

/// The points where two segments cross, other than their ends, rounded to the nearest lattice point, halves up. A
/// crossing with a rigid segment is rounded to a point on it. REQUIRES: no segment is a point; no two segments of one
/// kind share more than a point; coordinates in [0, kMaxCoordinate]; `rigid` segments run along the axes or diagonals
/// between points of even coordinates. Cost: O((n + k) log n), where k is the number of pairs of pieces with boxes that
/// meet; segments are divided into pieces of their mean length.
Crossings find_crossings(std::span<const Segment> lines, std::span<const Segment> rigid);

}  // namespace scarp::geom
