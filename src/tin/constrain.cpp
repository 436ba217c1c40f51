// Makes a segment an edge of the triangulation.
//
// The edges that the segment crosses are flipped away in turn (S. W. Sloan, "A fast algorithm for generating
// constrained Delaunay triangulations", Computers & Structures 47, 1993): an edge is flipped if its two triangles form
// a strictly convex quadrilateral. Otherwise, or if the new edge still crosses, the edge moves to the end of the queue.
// Then the edges that the flips made are tested again, except the segment. Integer arithmetic is exact, so a vertex on
// the segment is recognized and splits it.
#include <algorithm>
#include <cassert>
#include <deque>
#include <utility>

#include "tin/triangulation.h"

namespace scarp::tin {

namespace {

/// True if p is beyond a in the direction of b. REQUIRES: the three are collinear.
bool is_ahead(Point a, Point b, Point p) {
  return std::int64_t{b.x - a.x} * (p.x - a.x) + std::int64_t{b.y - a.y} * (p.y - a.y) > 0;
}

}  // namespace

Triangulation::Passage Triangulation::passage(Vertex from, Vertex to) const {
  const Point a = points_[from], b = points_[to];
  const auto side_of = [&](Vertex v) { return orient(a, b, points_[v]); };
  Passage result;
  HalfEdge exit = kNone;
  const HalfEdge first = edge_out_of(from);
  const auto leaves_through = [&](HalfEdge h) {  // h starts at `from`
    const Vertex u = corners_[next(h)], w = corners_[previous(h)];
    for (Vertex v : {u, w}) {
      if (side_of(v) == 0 && is_ahead(a, b, points_[v])) result.reached = v;
    }
    if (result.reached == kNone && side_of(u) < 0 && side_of(w) > 0) exit = next(h);
    return result.reached != kNone || exit != kNone;
  };
  HalfEdge h = first;
  bool found = leaves_through(h);
  for (h = twins_[previous(h)]; !found && h != kNone && h != first; h = twins_[previous(h)]) found = leaves_through(h);
  for (h = twins_[first]; !found && h != kNone; h = twins_[next(h)]) found = leaves_through(next(h));
  assert(found && "a segment inside the rectangle leaves its start somewhere");
  while (result.reached == kNone) {
    result.crossed.push_back(exit);
    const HalfEdge g = twins_[exit];
    const Vertex d = corners_[previous(g)];
    const auto side = side_of(d);
    if (side == 0) {
      result.reached = d;
    } else {
      exit = side > 0 ? next(g) : previous(g);
    }
  }
  return result;
}

bool Triangulation::constrain(Vertex a, Vertex b) {
  if (const HalfEdge edge = find_edge(a, b); edge != kNone) {
    set_constrained(edge);
    last_ = edge / 3;
    return true;
  }
  std::vector<std::pair<Vertex, Vertex>> pieces;
  for (Vertex v = a; v != b;) {
    const Passage p = passage(v, b);
    for (HalfEdge h : p.crossed) {
      if (is_constrained(h)) return false;
    }
    pieces.emplace_back(v, p.reached);
    v = p.reached;
  }
  for (auto [v, w] : pieces) {
    // Flips for an earlier piece cannot make a later piece cross a constraint, but they can change its crossings.
    const Passage p = passage(v, w);
    if (!p.crossed.empty()) force_edge(v, w, p.crossed);
    const HalfEdge h = find_edge(v, w), edge = h != kNone ? h : find_edge(w, v);
    set_constrained(edge);
    last_ = edge / 3;
  }
  return true;
}

void Triangulation::release(HalfEdge h) {
  for (const HalfEdge side : {h, twins_[h]}) {
    if (side != kNone) flags_[side / 3] &= static_cast<std::uint8_t>(~(1u << side % 3));
  }
}

void Triangulation::force_edge(Vertex a, Vertex b, const std::vector<HalfEdge>& crossed) {
  const Point pa = points_[a], pb = points_[b];
  using Edge = std::pair<Vertex, Vertex>;
  std::deque<Edge> queue;
  std::vector<Edge> made;
  for (HalfEdge h : crossed) queue.emplace_back(corners_[h], corners_[next(h)]);
  while (!queue.empty()) {
    const auto [u, w] = queue.front();
    queue.pop_front();
    const HalfEdge h = find_edge(u, w);
    const Vertex c = corners_[previous(h)], d = corners_[previous(twins_[h])];
    last_ = h / 3;
    const int side_u = sign_of(orient(points_[d], points_[c], points_[u]));
    const int side_w = sign_of(orient(points_[d], points_[c], points_[w]));
    const bool convex = side_u * side_w < 0;
    if (!convex) {
      queue.emplace_back(u, w);
      continue;
    }
    flip(h);
    const bool touches = c == a || c == b || d == a || d == b;
    const bool crosses = !touches && sign_of(orient(pa, pb, points_[c])) * sign_of(orient(pa, pb, points_[d])) < 0;
    (crosses ? queue.emplace_back(c, d) : made.emplace_back(c, d));
  }
  // Repeats Lawson's flips until nothing changes; the constraint protects the segment.
  set_constrained(find_edge(a, b));
  pending_.clear();
  for (auto [u, w] : made) pending_.push_back(find_edge(u, w));
  while (!pending_.empty()) {
    const HalfEdge h = pending_.back();
    pending_.pop_back();
    if (!should_flip(h)) continue;
    const Triangle t = h / 3, u = twins_[h] / 3;
    flip(h);
    for (HalfEdge outer : {3 * t + 1, 3 * t + 2, 3 * u + 1, 3 * u + 2}) pending_.push_back(outer);
    last_ = t;
  }
}

}  // namespace scarp::tin
