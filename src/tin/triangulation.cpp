#include "tin/triangulation.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace scarp::tin {

Triangulation::Triangulation(Arrays arrays)
    : points_(std::move(arrays.points)),
      corners_(std::move(arrays.corners)),
      twins_(std::move(arrays.twins)),
      flags_(std::move(arrays.flags)) {}

Triangulation::Triangulation(std::int32_t cols, std::int32_t rows) {
  assert(cols >= 2 && rows >= 2 && cols <= kMaxCoordinate + 1 && rows <= kMaxCoordinate + 1);
  for (Point p : {Point{0, 0}, Point{cols - 1, 0}, Point{cols - 1, rows - 1}, Point{0, rows - 1}}) points_.push_back(p);
  const Triangle t = new_triangle(), u = new_triangle();
  set_triangle(t, 0, 1, 3, false);
  set_triangle(u, 1, 2, 3, false);
  link(3 * t + 1, 3 * u + 2);
}

Array<Vertex> Triangulation::take_corners() {
  Array<Vertex> corners = std::move(corners_);
  std::size_t kept = 0;
  for (Triangle t = 0; t < triangle_count(); ++t) {
    if (is_outside(t)) continue;
    if (kept != t) std::copy_n(&corners[3 * std::size_t{t}], 3, &corners[3 * kept]);
    ++kept;
  }
  corners.resize(3 * kept);
  flags_.release();
  return corners;
}

void Triangulation::set_outside(Triangle t, bool outside) {
  flags_[t] = static_cast<std::uint8_t>(outside ? flags_[t] | kOutside : flags_[t] & ~kOutside);
}

Triangle Triangulation::new_triangle() {
  const auto t = static_cast<Triangle>(flags_.size());
  corners_.resize(corners_.size() + 3);
  twins_.resize(twins_.size() + 3);
  flags_.push_back(0);
  return t;
}

void Triangulation::set_triangle(Triangle t, Vertex a, Vertex b, Vertex c, bool outside) {
  corners_[3 * t] = a;
  corners_[3 * t + 1] = b;
  corners_[3 * t + 2] = c;
  twins_[3 * t] = twins_[3 * t + 1] = twins_[3 * t + 2] = kNone;
  flags_[t] = outside ? kOutside : 0;
}

void Triangulation::link(HalfEdge h, HalfEdge g) {
  twins_[h] = g;
  twins_[g] = h;
}

void Triangulation::attach(HalfEdge h, Side side) {
  twins_[h] = side.twin;
  if (side.twin != kNone) twins_[side.twin] = h;
  if (side.constrained) flags_[h / 3] |= static_cast<std::uint8_t>(1u << (h % 3));
}

void Triangulation::set_constrained(HalfEdge h) {
  flags_[h / 3] |= static_cast<std::uint8_t>(1u << (h % 3));
  if (const HalfEdge g = twins_[h]; g != kNone) flags_[g / 3] |= static_cast<std::uint8_t>(1u << (g % 3));
}

Triangulation::Location Triangulation::locate_in(Point p, Triangle t) const {
  HalfEdge on_edge = kNone;
  for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
    if (points_[corners_[h]] == p) return {Location::Kind::kOnVertex, h};
    if (orient(points_[corners_[h]], points_[corners_[next(h)]], p) == 0) on_edge = h;
  }
  if (on_edge == kNone) return {Location::Kind::kInside, 3 * t};
  // Uses the lower half-edge, so that the result does not depend on the side of the search.
  const HalfEdge other = twins_[on_edge];
  return {Location::Kind::kOnEdge, other != kNone && other < on_edge ? other : on_edge};
}

Triangulation::Location Triangulation::locate(Point p, Triangle hint) const {
  // The walk tests the edges of each triangle from a varying first edge, since with constraints, a fixed order could
  // cycle. The variation is a fixed sequence, not random.
  std::uint32_t sequence = 12345;
  HalfEdge entered = kNone;
  for (Triangle t = hint;;) {
    sequence = sequence * 1664525u + 1013904223u;
    HalfEdge crossed = kNone;
    for (std::uint32_t i = 0, k = (sequence >> 16) % 3; i < 3 && crossed == kNone; ++i, k = k == 2 ? 0 : k + 1) {
      const HalfEdge h = 3 * t + k;
      if (h != entered && orient(points_[corners_[h]], points_[corners_[next(h)]], p) < 0) crossed = h;
    }
    if (crossed == kNone) return locate_in(p, t);
    entered = twins_[crossed];
    assert(entered != kNone && "the point lies outside the rectangle");
    t = entered / 3;
  }
}

Vertex Triangulation::insert(Point p, Location location, FlipRule* rule) {
  const HalfEdge h = location.edge;
  if (location.kind == Location::Kind::kOnVertex) {
    last_ = h / 3;
    return corners_[h];
  }
  const auto v = static_cast<Vertex>(points_.size());
  points_.push_back(p);
  const Triangle t = h / 3;
  const bool t_outside = is_outside(t);
  const Vertex a = corners_[h], b = corners_[next(h)], c = corners_[previous(h)];
  const Side ab = side(h), bc = side(next(h)), ca = side(previous(h));
  pending_.clear();
  if (location.kind == Location::Kind::kInside) {
    const Triangle t1 = new_triangle(), t2 = new_triangle();
    set_triangle(t, a, b, v, t_outside);
    set_triangle(t1, b, c, v, t_outside);
    set_triangle(t2, c, a, v, t_outside);
    attach(3 * t, ab);
    attach(3 * t1, bc);
    attach(3 * t2, ca);
    link(3 * t + 1, 3 * t1 + 2);
    link(3 * t1 + 1, 3 * t2 + 2);
    link(3 * t2 + 1, 3 * t + 2);
    pending_ = {3 * t2, 3 * t1, 3 * t};
  } else {
    const HalfEdge g = ab.twin;
    const Triangle t1 = new_triangle();
    set_triangle(t, c, a, v, t_outside);
    set_triangle(t1, b, c, v, t_outside);
    attach(3 * t, ca);
    attach(3 * t1, bc);
    link(3 * t + 2, 3 * t1 + 1);
    pending_ = {3 * t1, 3 * t};
    if (g != kNone) {
      const Triangle u = g / 3, u1 = new_triangle();
      const bool u_outside = is_outside(u);
      const Vertex d = corners_[previous(g)];
      const Side ad = side(next(g)), db = side(previous(g));
      set_triangle(u, a, d, v, u_outside);
      set_triangle(u1, d, b, v, u_outside);
      attach(3 * u, ad);
      attach(3 * u1, db);
      link(3 * u + 1, 3 * u1 + 2);
      link(3 * t + 1, 3 * u + 2);
      link(3 * t1 + 2, 3 * u1 + 1);
      pending_.push_back(3 * u1);
      pending_.push_back(3 * u);
    }
    if (ab.constrained) {
      set_constrained(3 * t + 1);
      set_constrained(3 * t1 + 2);
    }
  }
  last_ = t;
  legalize_star(rule);
  return v;
}

bool Triangulation::should_flip(HalfEdge h) const {
  if (!is_free(h)) return false;
  const auto [a, b, c] = corners(h / 3);
  return geom::in_circle(a, b, c, points_[corners_[previous(twins_[h])]]) > 0;
}

// h = a→b in t = (a, b, c), its twin b→a in u = (b, a, d): the diagonal a–b of the quadrilateral a, d, b, c becomes
// d–c, t = (c, d, b), u = (d, c, a).
void Triangulation::flip(HalfEdge h) {
  const HalfEdge g = twins_[h];
  const Triangle t = h / 3, u = g / 3;
  const bool outside = is_outside(t);
  const Vertex a = corners_[h], b = corners_[g], c = corners_[previous(h)], d = corners_[previous(g)];
  const Side bc = side(next(h)), ca = side(previous(h)), ad = side(next(g)), db = side(previous(g));
  set_triangle(t, c, d, b, outside);
  set_triangle(u, d, c, a, outside);
  link(3 * t, 3 * u);
  attach(3 * t + 1, db);
  attach(3 * t + 2, bc);
  attach(3 * u + 1, ca);
  attach(3 * u + 2, ad);
}

// Each pending edge is opposite to the new vertex in its triangle. A flip replaces it by a spoke and exposes two edges
// beyond it.
void Triangulation::legalize_star(FlipRule* rule) {
  while (!pending_.empty()) {
    const HalfEdge h = pending_.back();
    pending_.pop_back();
    if (!(rule ? is_free(h) && rule->should_flip(*this, h) : should_flip(h))) continue;
    // flip() makes corner c of t = (a, b, c) its first corner: c is the new vertex, since h faces it.
    const Triangle t = h / 3, u = twins_[h] / 3;
    flip(h);
    pending_.push_back(3 * u + 2);
    pending_.push_back(3 * t + 1);
  }
}

void Triangulation::improve(std::vector<HalfEdge>& edges, FlipRule& rule, std::size_t most) {
  for (std::size_t flips = 0; !edges.empty() && flips < most;) {
    const HalfEdge h = edges.back();
    edges.pop_back();
    if (!is_free(h) || !rule.should_flip(*this, h)) continue;
    const Triangle t = h / 3, u = twins_[h] / 3;
    flip(h);
    ++flips;
    for (HalfEdge around : {3 * t + 1, 3 * t + 2, 3 * u + 1, 3 * u + 2}) edges.push_back(around);
  }
  edges.clear();
}

HalfEdge Triangulation::edge_out_of(Vertex v) const {
  for (HalfEdge h = 3 * last_; h < 3 * last_ + 3; ++h) {
    if (corners_[h] == v) return h;
  }
  return locate(points_[v], last_).edge;
}

void Triangulation::star(Vertex v, std::vector<Triangle>& triangles) const {
  triangles.clear();
  const HalfEdge first = edge_out_of(v);
  HalfEdge h = first;
  do {
    triangles.push_back(h / 3);
    h = twins_[previous(h)];
  } while (h != kNone && h != first);
  if (h == first) return;
  for (h = twins_[first]; h != kNone; h = twins_[next(h)]) triangles.push_back(h / 3);
}

HalfEdge Triangulation::find_edge(Vertex a, Vertex b) const {
  const HalfEdge first = edge_out_of(a);
  HalfEdge h = first;
  do {
    if (corners_[next(h)] == b) return h;
    if (corners_[previous(h)] == b && twins_[previous(h)] == kNone) return kNone;
    h = twins_[previous(h)];
  } while (h != kNone && h != first);
  if (h == first) return kNone;
  for (HalfEdge g = twins_[first]; g != kNone; g = twins_[h]) {
    h = next(g);
    if (corners_[next(h)] == b) return h;
  }
  return kNone;
}

}  // namespace scarp::tin
