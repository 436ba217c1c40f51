// Segments that lie upon each other, merged: a stretch that a thousand of them share is examined once.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geom/segments.h"

namespace scarp {

/// The unions of segments on one line that have more than a point in common.
struct Courses {
  std::vector<Segment> segments;  ///< `from` before `to` in raster order; in the order of their first segments
  std::vector<std::uint32_t> of;  ///< for each segment given: the course that holds it
};

/// REQUIRES: no segment is a point; coordinates in [0, kMaxCoordinate]. Cost: O(n log n), O(n) where few share a line.
Courses merge_overlaps(std::span<const Segment> segments);

}  // namespace scarp
