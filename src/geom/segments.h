// Segments between lattice points: cut to a rectangle, and where they cross.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/function_ref.h"
#include "base/point.h"

namespace scarp {

struct Segment {
  Point from, to;
};

/// The part of a segment in a rectangle.
struct ClippedSegment {
  Segment segment;
  double begin = 0, end = 1;  ///< ends within the rectangle, as fractions of the whole
};

/// Cuts a segment to [0, width] × [0, height]; its coordinates may be any. Where it crosses the border the end becomes
/// the lattice point of the border nearest to the crossing, whichever way the segment runs. False if no more than a
/// point is left.
bool clip_segment(const Segment& segment, std::int32_t width, std::int32_t height, ClippedSegment& clipped);

/// True if the segment runs so that x + y stays the same.
inline bool is_antidiagonal(const Segment& s) { return s.to.x - s.from.x == s.from.y - s.to.y; }

/// Calls visit(a, b) for each two segments that may have a point in common, more than once for some. REQUIRES: no
/// segment is a point; coordinates in [0, kMaxCoordinate]. Cost: as find_crossings().
void visit_neighbours(std::span<const Segment> segments, FunctionRef<void(std::uint32_t, std::uint32_t)> visit);

struct Crossings {
  std::vector<Point> points;  ///< in raster order, each once
  bool are_exact = true;      ///< all of them are lattice points: none was rounded
};

/// The points where two segments cross and that are an end of neither, rounded to the nearest lattice point, halves up.
/// A crossing with a rigid segment is rounded to a point on it. REQUIRES: no segment is a point; no two of one kind
/// have more than a point in common; coordinates in [0, kMaxCoordinate]; `rigid` run along the axes or diagonals
/// between points of even coordinates. Cost: O((n + k) log n) for k pairs of pieces, of the mean length of all
/// segments, whose boxes meet.
Crossings find_crossings(std::span<const Segment> lines, std::span<const Segment> rigid);

}  // namespace scarp
