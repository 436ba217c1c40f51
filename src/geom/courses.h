// Merges overlapping segments into courses, so that a stretch shared by a thousand segments is examined once.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geom/segments.h"

namespace scarp::geom {

/// The unions of collinear segments that share more than a point.
struct Courses {
  std::vector<Segment> segments;  ///< `from` precedes `to` in raster order; sorted by their first segments
  std::vector<std::uint32_t> of;  ///< for each segment given: the course that contains it
};

/// REQUIRES: no segment is a point; coordinates in [0, kMaxCoordinate]. Cost: O(n log n); O(n) if few segments are
/// collinear.
Courses merge_overlaps(std::span<const Segment> segments);

}  // namespace scarp::geom
