// The quadrilateral around an edge, with both of its diagonals.
#pragma once

#include <algorithm>
#include <array>

#include "tin/triangulation.h"

namespace scarp::refine {

/// For h = a→b in (a, b, c), with its twin in (b, a, d): the two present triangles, and the two after a flip, in the
/// same slots (see FlipRule).
struct Quadrilateral {
  using Corners = std::array<Point, 3>;

  Quadrilateral(const tin::Triangulation& tin, tin::HalfEdge h) : t(h / 3), u(tin.twin(h) / 3) {
    const tin::HalfEdge g = tin.twin(h);
    const tin::Vertex a = tin.origin(h), b = tin.origin(g), c = tin.origin(tin::Triangulation::previous(h)),
                      d = tin.origin(tin::Triangulation::previous(g));
    first_vertices = {c, d, b};
    second_vertices = {d, c, a};
    const Point pa = tin.point(a), pb = tin.point(b), pc = tin.point(c), pd = tin.point(d);
    kept[0] = {pa, pb, pc};
    kept[1] = {pb, pa, pd};
    other[0] = {pc, pd, pb};
    other[1] = {pd, pc, pa};
  }
  bool can_flip() const {
    return orient(other[0][0], other[0][1], other[0][2]) > 0 && orient(other[1][0], other[1][1], other[1][2]) > 0;
  }

  tin::Triangle t, u;                                          ///< triangles of h and of its twin
  Corners kept[2];                                             ///< corners of t, u
  Corners other[2];                                            ///< corners of t, u after a flip
  std::array<tin::Vertex, 3> first_vertices, second_vertices;  ///< vertices of other[0], other[1]
};

inline double twice_area(const Quadrilateral::Corners& t) { return static_cast<double>(orient(t[0], t[1], t[2])); }

/// Twice Scape's quality of a triangle: area / larger side of the bounding box.
inline double box_quality(const Quadrilateral::Corners& t) {
  const auto [low_x, high_x] = std::minmax({t[0].x, t[1].x, t[2].x});
  const auto [low_y, high_y] = std::minmax({t[0].y, t[1].y, t[2].y});
  return twice_area(t) / std::max(high_x - low_x, high_y - low_y);
}

/// 2 · area / longest side², at most √3 / 2.
inline double fatness(const Quadrilateral::Corners& t) {
  double longest = 0;
  for (int k = 0; k < 3; ++k) {
    const double dx = t[(k + 1) % 3].x - t[k].x, dy = t[(k + 1) % 3].y - t[k].y;
    longest = std::max(longest, dx * dx + dy * dy);
  }
  return twice_area(t) / longest;
}

/// Fatness of the thinner triangle.
inline double fatness(const Quadrilateral::Corners (&pair)[2]) { return std::min(fatness(pair[0]), fatness(pair[1])); }

}  // namespace scarp::refine
