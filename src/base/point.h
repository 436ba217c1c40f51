// Points of the sample lattice, their order and their orientation.
//
// Handedness: positive means counter-clockwise if x points right and y points up. Rasters count rows downwards, so on
// the screen a positive triangle is clockwise. The same sign is used everywhere.
//
// Sizes: coordinates lie in [0, kMaxCoordinate], so a difference fits 30 bits and orient() needs 2·30 + 1 bits.
#pragma once

#include <cstdint>

namespace scarp {

inline constexpr std::int32_t kMaxCoordinate = (1 << 30) - 1;

/// A point of the sample lattice: column and row.
struct Point {
  std::int32_t x = 0, y = 0;
  friend bool operator==(Point, Point) = default;
};

/// Raster order: lowest row first, then lowest column. It breaks every tie in Scarp.
inline bool before(Point a, Point b) { return a.y != b.y ? a.y < b.y : a.x < b.x; }

/// Twice the signed area of (a, b, c). (1) orient(a,b,c) = orient(b,c,a); (2) orient(a,b,c) = −orient(b,a,c).
inline std::int64_t orient(Point a, Point b, Point c) {
  return std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{b.y - a.y} * (c.x - a.x);
}

}  // namespace scarp
