#include "refine/concave_outline.h"

#include <algorithm>
#include <queue>
#include <utility>

namespace scarp::refine {

namespace {

bool is_inside(const tin::Triangulation& tin, tin::HalfEdge h) { return h != tin::kNone && !tin.is_outside(h / 3); }

/// True if the half-edge's triangle is part of the domain, but no triangle on its other side is.
bool is_boundary(const tin::Triangulation& tin, tin::HalfEdge h) {
  return is_inside(tin, h) && !is_inside(tin, tin.twin(h));
}

struct LongEdge {
  std::int64_t square;
  Point from;
  tin::HalfEdge edge;

  friend bool operator<(const LongEdge& a, const LongEdge& b) {
    return a.square != b.square ? a.square < b.square : before(b.from, a.from);
  }
};

}  // namespace

void add_points(const grid::SnappedPoints& points, std::size_t stride, ScatteredDomain& domain) {
  for (std::size_t i = 0; i < points.size(); i += stride) {
    const Point p = points.at[i];
    domain.insert(static_cast<std::uint32_t>(i), p, domain.tin.locate(p, domain.tin.last_touched()));
  }
}

std::size_t take_away_long(ScatteredDomain& domain, double longest) {
  tin::Triangulation& tin = domain.tin;
  std::vector<bool> is_on_boundary(tin.vertex_count());
  std::priority_queue<LongEdge> edges;
  const auto add = [&](tin::HalfEdge h) {
    const Point a = tin.point(tin.origin(h)), b = tin.point(tin.origin(tin::Triangulation::next(h)));
    is_on_boundary[tin.origin(h)] = true;
    const std::int64_t x = b.x - a.x, y = b.y - a.y;
    if (const std::int64_t square = x * x + y * y; static_cast<double>(square) > longest * longest)
      edges.push({square, a, h});
  };
  for (tin::HalfEdge h = 0; h < 3 * tin.triangle_count(); ++h) {
    if (is_boundary(tin, h)) add(h);
  }
  std::size_t taken = 0;
  while (!edges.empty()) {
    const tin::HalfEdge h = edges.top().edge;
    edges.pop();
    // A corner on the boundary remains there, so a triangle that must remain now must always remain.
    if (is_on_boundary[tin.origin(tin::Triangulation::previous(h))]) continue;
    tin.set_outside(h / 3, true);
    ++taken;
    add(tin.twin(tin::Triangulation::next(h)));
    add(tin.twin(tin::Triangulation::previous(h)));
  }
  return taken;
}

std::vector<std::uint32_t> outline_of(const ScatteredDomain& domain) {
  const tin::Triangulation& tin = domain.tin;
  std::vector<tin::Vertex> next_of(tin.vertex_count(), tin::kNone);
  tin::Vertex first = tin::kNone;
  for (tin::HalfEdge h = 0; h < 3 * tin.triangle_count(); ++h) {
    if (!is_boundary(tin, h)) continue;
    const tin::Vertex v = tin.origin(h);
    next_of[v] = tin.origin(tin::Triangulation::next(h));
    if (first == tin::kNone || before(tin.point(v), tin.point(first))) first = v;
  }
  std::vector<std::uint32_t> outline;
  tin::Vertex v = first;
  do {
    const tin::Vertex w = next_of[v], u = next_of[w];
    if (orient(tin.point(v), tin.point(w), tin.point(u)) != 0) outline.push_back(domain.point_of[w]);
    v = w;
  } while (v != first);
  std::rotate(outline.begin(), outline.end() - 1, outline.end());
  return outline;
}

Result<ScatteredDomain> build_concave_domain(const grid::SnappedPoints& points, ScatteredDomain hull, double length) {
  add_points(points, 1, hull);
  // Includes half a step for each moved end, and rounding; an edge of just this length remains.
  const double longest = length / points.lattice.step * (1 + 1e-12) + (points.is_exact ? 0 : 1);
  take_away_long(hull, longest);
  const std::vector<std::vector<std::uint32_t>> outlines{outline_of(hull)};
  hull = {tin::Triangulation(2, 2), {}, {}, 0};
  return build_domain(points, outlines);
}

}  // namespace scarp::refine
