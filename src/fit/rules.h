// What moves of fitting must respect besides the bound: where vertices may be, and the shape of triangles.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "fit/triangle_error.h"

namespace scarp {

/// Where vertices may be.
enum class Freedom : std::uint8_t {
  kSamples,  ///< on valid samples, at their heights
  kLattice,  ///< on the lattice of fitting, at any height
};

/// How long and thin triangles may be. A move must not leave one whose shape is below the floor, unless the move takes
/// away one that is worse, or as bad: slivers that a mesh begins with, or that its outline wants, are thus never made
/// worse and hold up nobody.
struct ShapeRule {
  double floor = 0;       ///< 0: any shape
  double aspect = 1;      ///< of a sample: its height over its width
  bool by_angle = false;  ///< the shape is the square of the smallest angle's sine instead
  double longest_square = std::numeric_limits<double>::infinity();  ///< a triangle with an edge beyond has the shape 0
  double shortest_square = 0;  ///< one with a shorter edge lies below the floor, the deeper the shorter that edge is

  bool is_on() const { return floor > 0; }
  /// Twice the area over the square of the longest edge, that is, height over longest edge: 0.87 where all edges are
  /// equal. The same whichever corner comes first; for square samples the exact quotient, rounded once.
  double shape(const FitCorner& a, const FitCorner& b, const FitCorner& c) const {
    return of(static_cast<double>(area2(a, b, c)), square(a, b), square(b, c), square(c, a));
  }
  /// The same from twice the area and the squares of the edges.
  double of(double area, double ab, double bc, double ca) const {
    const double longest = std::max({ab, bc, ca});
    if (longest > longest_square) return 0;
    const double shortest = std::min({ab, bc, ca});
    const double most =
        shortest < shortest_square ? floor * shortest / shortest_square : std::numeric_limits<double>::infinity();
    if (!by_angle) return std::min(most, area * aspect / longest);
    const double middle = std::max(std::min(ab, bc), std::min(std::max(ab, bc), ca));
    return std::min(most, area * aspect / longest * (area * aspect / middle));
  }
  /// Whether an edge is shorter than it may be.
  bool is_short(const FitCorner& p, const FitCorner& q) const { return square(p, q) < shortest_square; }
  /// Of an edge.
  double square(const FitCorner& p, const FitCorner& q) const {
    const double x = q.x - p.x, y = (q.y - p.y) * aspect;
    return x * x + y * y;
  }
  /// The floor for moves that take away the triangle too.
  double lowered(double to, const FitCorner& a, const FitCorner& b, const FitCorner& c) const {
    return std::min(to, shape(a, b, c));
  }
};

/// Vertices at edges that are too short go first: taken off the price of their removal, which is an energy.
inline constexpr float kShortEdgeFirst = 1e30f;

inline bool has_short_edge(const ShapeRule& rule, const FitCorner& hub, const std::vector<FitCorner>& ring) {
  return rule.shortest_square > 0 &&
         std::any_of(ring.begin(), ring.end(), [&](const FitCorner& corner) { return rule.is_short(hub, corner); });
}

struct MoveRules {
  Freedom freedom = Freedom::kSamples;
  ShapeRule shape = {};
  /// Between them the heights of free vertices stay.
  float lowest = -std::numeric_limits<float>::infinity(), highest = std::numeric_limits<float>::infinity();
};

}  // namespace scarp
