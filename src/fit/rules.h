// The limits of fitting in addition to the bound: positions of vertices, and shapes of triangles.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "fit/triangle_error.h"

namespace scarp::fit {

enum class Freedom : std::uint8_t {
  kSamples,  ///< on valid samples, at their heights
  kLattice,  ///< on the lattice of fitting, at any height
};

/// Shape of a triangle. Both parts are compared separately, so a gain in one never offsets a loss in the other.
struct TriangleShape {
  double form = 0;  ///< larger for less thin triangles
  double edge = 0;  ///< the square of the shortest edge, at most ShapeRule::shortest_square

  bool keeps(const TriangleShape& floor) const { return form >= floor.form && edge >= floor.edge; }
  TriangleShape worse_of(const TriangleShape& other) const {
    return {std::min(form, other.form), std::min(edge, other.edge)};
  }
};

/// The limits of thin triangles and short edges. A move must not create a triangle thinner than the floor unless it
/// removes a triangle as thin, nor a too short edge unless it removes an edge as short. So slivers that the initial
/// mesh has or its outline needs never become worse, and do not prevent moves.
struct ShapeRule {
  double floor = 0;       ///< 0: any shape
  double aspect = 1;      ///< size of a sample in y over its size in x
  bool by_angle = false;  ///< the form is the squared sine of the smallest angle
  double longest_square = std::numeric_limits<double>::infinity();  ///< a triangle with a longer edge has form 0
  double shortest_square = 0;                                       ///< shorter edges are too short
  bool edge_first = false;                                          ///< a too short edge lowers the form in proportion

  bool is_on() const { return floor > 0; }
  TriangleShape least() const { return {floor, shortest_square}; }
  /// Twice the area over the squared longest edge, that is, height over longest edge: 0.87 if all edges are equal.
  /// Independent of the first corner. For square samples the exact quotient, rounded once.
  TriangleShape shape(const FitCorner& a, const FitCorner& b, const FitCorner& c) const {
    return of(static_cast<double>(area2(a, b, c)), square(a, b), square(b, c), square(c, a));
  }
  /// The same from twice the area and the squares of the edges.
  TriangleShape of(double area, double ab, double bc, double ca) const {
    const double longest = std::max({ab, bc, ca}), edge = std::min({ab, bc, ca, shortest_square});
    if (longest > longest_square) return {0, edge};
    const double most =
        edge_first && edge < shortest_square ? floor * edge / shortest_square : std::numeric_limits<double>::infinity();
    if (!by_angle) return {std::min(most, area * aspect / longest), edge};
    const double middle = std::max(std::min(ab, bc), std::min(std::max(ab, bc), ca));
    return {std::min(most, area * aspect / longest * (area * aspect / middle)), edge};
  }
  bool is_short(const FitCorner& p, const FitCorner& q) const { return square(p, q) < shortest_square; }
  double square(const FitCorner& p, const FitCorner& q) const {
    const double x = q.x - p.x, y = (q.y - p.y) * aspect;
    return x * x + y * y;
  }
  /// The floor `to`, lowered for a move that removes the triangle.
  TriangleShape lowered(const TriangleShape& to, const FitCorner& a, const FitCorner& b, const FitCorner& c) const {
    return to.worse_of(shape(a, b, c));
  }
};

/// Subtracted from the price of vertices at too short edges, so they are removed first.
inline constexpr float kShortEdgeFirst = 1e30f;

inline bool has_short_edge(const ShapeRule& rule, const FitCorner& hub, const std::vector<FitCorner>& ring) {
  return rule.shortest_square > 0 &&
         std::any_of(ring.begin(), ring.end(), [&](const FitCorner& corner) { return rule.is_short(hub, corner); });
}

struct MoveRules {
  Freedom freedom = Freedom::kSamples;
  ShapeRule shape = {};
  /// Limits of the heights of free vertices.
  float lowest = -std::numeric_limits<float>::infinity(), highest = std::numeric_limits<float>::infinity();
};

}  // namespace scarp::fit
