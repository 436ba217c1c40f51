// The laws of every triangulation, written once.
#pragma once

#include <fmt/format.h>

#include <string>

#include "tin/triangulation.h"

namespace scarp::testing {

enum class Edges { kDelaunay, kAny };

/// The first broken law, "" if none: (1) twins refer to each other along the same edge, and their constraints agree;
/// (2) triangles are positive; (3) Euler: the areas add up to the rectangle and V − E + F = 1; (4) locally Delaunay
/// except across constraints (unless `edges` is kAny); (5) the mark "outside" changes only across constraints.
inline std::string verify_triangulation(const tin::Triangulation& tin, std::int32_t cols, std::int32_t rows,
                                        Edges edges_are = Edges::kDelaunay) {
  std::int64_t area2 = 0;
  std::size_t border = 0;
  for (tin::Triangle t = 0; t < tin.triangle_count(); ++t) {
    const auto [a, b, c] = tin.corners(t);
    if (orient(a, b, c) <= 0) return fmt::format("triangle {} is not positive", t);
    area2 += orient(a, b, c);
    for (tin::HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
      const tin::HalfEdge g = tin.twin(h);
      if (g == tin::kNone) {
        ++border;
        continue;
      }
      if (tin.twin(g) != h || tin.origin(g) != tin.origin(tin::Triangulation::next(h)) ||
          tin.origin(h) != tin.origin(tin::Triangulation::next(g)))
        return fmt::format("half-edges {} and {} do not match", h, g);
      if (tin.is_constrained(h) != tin.is_constrained(g))
        return fmt::format("edge {} is constrained on one side only", h);
      if (tin.is_constrained(h)) continue;
      if (tin.is_outside(t) != tin.is_outside(g / 3)) return fmt::format("outside changes across the free edge {}", h);
      if (edges_are == Edges::kDelaunay &&
          geom::in_circle(a, b, c, tin.point(tin.origin(tin::Triangulation::previous(g)))) > 0)
        return fmt::format("edge {} is not Delaunay", h);
    }
  }
  if (area2 != 2 * std::int64_t{cols - 1} * (rows - 1)) return "the areas do not add up to the rectangle";
  const std::size_t edges = (3 * tin.triangle_count() + border) / 2;
  if (tin.vertex_count() + tin.triangle_count() != edges + 1) return "Euler's formula does not hold";
  return "";
}

/// True if vertices, triangles, constraints and marks are the same, in the same order.
inline bool is_same(const tin::Triangulation& a, const tin::Triangulation& b) {
  if (a.vertex_count() != b.vertex_count() || a.triangle_count() != b.triangle_count()) return false;
  for (tin::Vertex v = 0; v < a.vertex_count(); ++v) {
    if (!(a.point(v) == b.point(v))) return false;
  }
  for (tin::HalfEdge h = 0; h < 3 * a.triangle_count(); ++h) {
    if (a.origin(h) != b.origin(h) || a.twin(h) != b.twin(h) || a.is_constrained(h) != b.is_constrained(h) ||
        a.is_outside(h / 3) != b.is_outside(h / 3))
      return false;
  }
  return true;
}

/// True if the segment from a to b is a chain of constrained edges.
inline bool is_constrained_chain(const tin::Triangulation& tin, tin::Vertex a, tin::Vertex b) {
  for (tin::Vertex v = a; v != b;) {
    tin::Vertex next = tin::kNone;
    for (tin::HalfEdge h = 0; h < 3 * tin.triangle_count(); ++h) {
      for (const auto& [from, to] : {std::pair{tin.origin(h), tin.origin(tin::Triangulation::next(h))},
                                     {tin.origin(tin::Triangulation::next(h)), tin.origin(h)}}) {
        const Point p = tin.point(v), q = tin.point(to), end = tin.point(b);
        const bool ahead = std::int64_t{q.x - p.x} * (end.x - p.x) + std::int64_t{q.y - p.y} * (end.y - p.y) > 0;
        if (from == v && tin.is_constrained(h) && orient(p, end, q) == 0 && ahead) next = to;
      }
    }
    if (next == tin::kNone) return false;
    v = next;
  }
  return true;
}

}  // namespace scarp::testing
