#include "refine/scattered.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "geom/convex_hull.h"
#include "geom/exact_error.h"

namespace scarp::refine {

namespace {

tin::Vertex insert_corner(ScatteredDomain& domain, const grid::SnappedPoints& points, std::uint32_t point) {
  const Point p = points.at[point];
  return domain.insert(point, p, domain.tin.locate(p, domain.tin.last_touched()));
}

/// The extent of the corners across the line between two far corners: the farthest from any corner, and the farthest
/// from that one.
double width_across(std::span<const Point> at, const std::vector<std::uint32_t>& hull) {
  const auto distance = [](Point a, Point b) { return std::hypot(double(b.x) - a.x, double(b.y) - a.y); };
  const auto farthest_from = [&](Point p) {
    return at[*std::max_element(hull.begin(), hull.end(), [&](std::uint32_t a, std::uint32_t b) {
      return distance(p, at[a]) < distance(p, at[b]);
    })];
  };
  const Point a = farthest_from(at[hull.front()]), b = farthest_from(a);
  std::int64_t least = 0, most = 0;
  for (const std::uint32_t corner : hull) {
    const std::int64_t side = orient(a, b, at[corner]);
    least = std::min(least, side);
    most = std::max(most, side);
  }
  return static_cast<double>(most - least) / distance(a, b);
}

/// True for a place inside rings by the even-odd rule. Coordinates of the place are three times those of points.
bool is_inside(const grid::SnappedPoints& points, const std::vector<std::vector<std::uint32_t>>& rings, std::int64_t x,
               std::int64_t y) {
  bool is_inside = false;
  for (const auto& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point a = points.at[ring[i]], b = points.at[ring[(i + 1) % ring.size()]];
      const std::int64_t ay = std::int64_t{3} * a.y - y, by = std::int64_t{3} * b.y - y;
      if ((ay > 0) == (by > 0)) continue;
      const std::int64_t ax = std::int64_t{3} * a.x - x, bx = std::int64_t{3} * b.x - x;
      const __int128 side = static_cast<__int128>(ax) * by - static_cast<__int128>(bx) * ay;
      if ((side > 0) == (by > ay)) is_inside = !is_inside;
    }
  }
  return is_inside;
}

/// Marks the triangles outside the rings, whose edges are constrained; all triangles of an area between rings get the
/// same mark.
void mark_beyond(const grid::SnappedPoints& points, ScatteredDomain& domain) {
  tin::Triangulation& tin = domain.tin;
  std::vector<bool> is_seen(tin.triangle_count());
  std::vector<tin::Triangle> area;
  for (tin::Triangle first = 0; first < tin.triangle_count(); ++first) {
    if (is_seen[first]) continue;
    const auto [a, b, c] = tin.corners(first);
    const bool is_outside =
        !is_inside(points, domain.outlines, std::int64_t{a.x} + b.x + c.x, std::int64_t{a.y} + b.y + c.y);
    area.assign(1, first);
    is_seen[first] = true;
    while (!area.empty()) {
      const tin::Triangle t = area.back();
      area.pop_back();
      if (is_outside) tin.set_outside(t, true);
      for (tin::HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
        const tin::HalfEdge g = tin.twin(h);
        if (g == tin::kNone || tin.is_constrained(h) || is_seen[g / 3]) continue;
        is_seen[g / 3] = true;
        area.push_back(g / 3);
      }
    }
  }
}

}  // namespace

tin::Vertex ScatteredDomain::insert(std::uint32_t point, Point at, const tin::Triangulation::Location& location) {
  const tin::Vertex v = tin.insert(at, location);
  if (v == point_of.size()) {
    point_of.push_back(point);
    if (!heights.empty()) heights.push_back(std::numeric_limits<double>::quiet_NaN());
  } else if (is_unused(v)) {
    point_of[v] = point;
    --unused;
  }
  return v;
}

tin::Vertex ScatteredDomain::insert_free(Point at, double z, const tin::Triangulation::Location& location) {
  heights.resize(point_of.size(), std::numeric_limits<double>::quiet_NaN());
  const tin::Vertex v = tin.insert(at, location);
  point_of.push_back(tin::kNone);
  heights.push_back(z);
  return v;
}

Result<ScatteredDomain> build_domain(const grid::SnappedPoints& points) {
  if (points.size() < 3)
    return fail(ErrorKind::kInput, points.size() == 1
                                       ? "all points lie at one place; a surface needs at least three places"
                                       : "all points lie at two places; a surface needs at least three places");
  const std::vector<std::uint32_t> hull = geom::convex_hull(points.at);
  if (hull.size() < 3) return fail(ErrorKind::kInput, "all points lie on one line, so there is no surface to simplify");
  auto domain = build_domain(points, {hull});
  if (domain) domain->width = points.lattice.step * width_across(points.at, hull);
  return domain;
}

Result<ScatteredDomain> build_domain(const grid::SnappedPoints& points,
                                     const std::vector<std::vector<std::uint32_t>>& outlines) {
  ScatteredDomain domain{tin::Triangulation(points.lattice.cols, points.lattice.rows), {}, outlines, 4};
  domain.point_of.assign(4, tin::kNone);
  std::vector<std::vector<tin::Vertex>> rings;
  for (const auto& outline : outlines) {
    // Coarse to fine: in order around a circle, every corner would change the triangles of all previous corners.
    for (std::size_t stride = std::bit_ceil(outline.size()); stride > 0; stride /= 2) {
      for (std::size_t i = 0; i < outline.size(); i += stride) {
        if (i % (2 * stride) != 0) insert_corner(domain, points, outline[i]);
      }
    }
    rings.emplace_back();
    for (const std::uint32_t point : outline) rings.back().push_back(insert_corner(domain, points, point));
  }
  for (const auto& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const tin::Vertex from = ring[i], to = ring[(i + 1) % ring.size()];
      if (from == to || domain.tin.constrain(from, to)) continue;
      const grid::PointLattice& lattice = points.lattice;
      const Point p = points.at[domain.point_of[from]];
      return fail(ErrorKind::kInput,
                  fmt::format("edges of the boundary cross near ({:.9g}, {:.9g})", lattice.west + lattice.step * p.x,
                              lattice.north - lattice.step * p.y));
    }
  }
  mark_beyond(points, domain);
  return domain;
}

ScatteredRefinement::ScatteredRefinement(const grid::SnappedPoints& points, std::span<const double> heights,
                                         ScatteredDomain& domain, double threshold, std::span<const double> bounds)
    : points_(points),
      heights_(heights),
      domain_(domain),
      threshold_(threshold),
      bounds_(bounds),
      first_(domain.tin.triangle_count(), tin::kNone),
      next_(points.size(), tin::kNone),
      worst_(domain.tin.triangle_count(), tin::kNone) {
  const tin::Triangulation& tin = domain.tin;
  queue_.grow(tin.triangle_count());
  tin::Triangle hint = 0;
  for (auto point = static_cast<std::uint32_t>(points.size()); point-- > 0;) {
    const auto location = tin.locate(points.at[point], hint);
    if (location.kind == tin::Triangulation::Location::Kind::kOnVertex) continue;
    hint = location.edge / 3;
    const tin::HalfEdge twin = tin.twin(location.edge);
    if (tin.is_outside(hint) && location.kind == tin::Triangulation::Location::Kind::kOnEdge && twin != tin::kNone)
      hint = twin / 3;
    // The point is beyond a boundary edge by the edge's rounding; the judge decides whether that is near enough.
    if (tin.is_outside(hint)) continue;
    next_[point] = first_[hint];
    first_[hint] = point;
  }
  for (tin::Triangle t = 0; t < tin.triangle_count(); ++t) {
    if (tin.is_outside(t)) continue;
    ++inside_;
    Wedge wedge = wedge_of(t, tin.origin(3 * t));
    for (std::uint32_t point = first_[t]; point != tin::kNone; point = next_[point]) {
      wedge.offer(error_of(wedge, point), points.at[point], point);
      ++scanned_;
    }
    settle(wedge);
  }
}

ScatteredRefinement::Wedge ScatteredRefinement::wedge_of(tin::Triangle t, tin::Vertex apex) const {
  tin::HalfEdge h = 3 * t;
  while (domain_.tin.origin(h) != apex) h = tin::Triangulation::next(h);
  return wedge_of(
      t, {apex, domain_.tin.origin(tin::Triangulation::next(h)), domain_.tin.origin(tin::Triangulation::previous(h))});
}

ScatteredRefinement::Wedge ScatteredRefinement::wedge_of(tin::Triangle t,
                                                         const std::array<tin::Vertex, 3>& corners) const {
  Wedge wedge;
  wedge.triangle = t;
  for (std::size_t k = 0; k < 3; ++k) {
    wedge.corners[k] = domain_.tin.point(corners[k]);
    wedge.heights[k] = domain_.height(corners[k], heights_);
  }
  wedge.plane = geom::Plane::through_double(wedge.corners, wedge.heights);
  return wedge;
}

bool ScatteredRefinement::exceeds(const Wedge& wedge, std::uint32_t point) const {
  return geom::exceeds_exactly(wedge.corners, wedge.heights, points_.at[point], points_.z[point],
                               bounds_.empty() ? threshold_ : bounds_[point]);
}

/// Queues the triangle with its worst point, if the point's error exceeds the threshold as a real number.
void ScatteredRefinement::settle(const Wedge& wedge) {
  ++dealt_;
  const tin::Triangle t = wedge.triangle;
  const double guard = guard_of(wedge), error = wedge.worst.error;
  const auto queue = [&](const metric::Candidate& candidate, std::uint32_t point) {
    queue_.set(t, candidate);
    worst_[t] = point;
  };
  if (error > threshold_ + guard) return queue(wedge.worst, wedge.worst_point);
  // A level plane has no guard: only one subtraction rounds, and monotonically, so only equality is uncertain.
  const bool is_certain = error < threshold_ - guard || (guard == 0 && (threshold_ == 0 || error != threshold_));
  if (is_certain) return queue_.remove(t);
  Wedge doubtful = wedge;
  doubtful.worst = {-1, {}};
  doubtful.worst_point = tin::kNone;
  for (std::uint32_t point = first_[t]; point != tin::kNone; point = next_[point]) {
    const Point p = points_.at[point];
    const double near = error_of(wedge, point);
    if (near >= threshold_ - guard && metric::is_worse({near, p}, doubtful.worst) && exceeds(wedge, point))
      doubtful.offer(near, p, point);
  }
  if (doubtful.worst_point == tin::kNone) return queue_.remove(t);
  queue(doubtful.worst, doubtful.worst_point);
}

/// Redistributes the points of the triangles around a new vertex among these triangles.
void ScatteredRefinement::deal(tin::Vertex v) {
  const tin::Triangulation& tin = domain_.tin;
  tin.star(v, star_);
  wedges_.clear();
  for (const tin::Triangle t : star_) {
    if (!tin.is_outside(t)) wedges_.push_back(wedge_of(t, v));
  }
  // All lists are moved out before any is written, because most of these triangles keep their ids and had lists.
  lists_.clear();
  for (const Wedge& wedge : wedges_) {
    lists_.push_back(first_[wedge.triangle]);
    first_[wedge.triangle] = tin::kNone;
  }
  const std::uint32_t inserted = domain_.point_of[v];
  Wedge* wedge = wedges_.data();
  Wedge* const end = wedge + wedges_.size();
  for (std::uint32_t point : lists_) {
    while (point != tin::kNone) {
      const std::uint32_t next = next_[point];
      if (point != inserted) {
        const Point p = points_.at[point];
        std::size_t turns = 0;
        for (; turns < wedges_.size() && !wedge->holds(p); ++turns)
          wedge = wedge + 1 == end ? wedges_.data() : wedge + 1;
        // A free vertex on the boundary may bend it by a step. The judge decides whether a point beyond is near enough.
        if (turns < wedges_.size()) {
          next_[point] = first_[wedge->triangle];
          first_[wedge->triangle] = point;
          wedge->offer(error_of(*wedge, point), p, point);
        }
        ++scanned_;
      }
      point = next;
    }
  }
  for (const Wedge& w : wedges_) settle(w);
}

std::uint32_t ScatteredRefinement::gain(const tin::Triangulation::Location& location) const {
  const tin::Triangulation& tin = domain_.tin;
  const auto counts = [&](tin::HalfEdge h) { return h != tin::kNone && !tin.is_outside(h / 3) ? 1u : 0u; };
  switch (location.kind) {
    case tin::Triangulation::Location::Kind::kInside:
      return 2 * counts(location.edge);
    case tin::Triangulation::Location::Kind::kOnEdge:
      return counts(location.edge) + counts(tin.twin(location.edge));
    case tin::Triangulation::Location::Kind::kOnVertex:
      break;
  }
  return 0;
}

std::uint32_t ScatteredRefinement::next_gain() const {
  const tin::Triangle t = queue_.worst();
  return gain(domain_.tin.locate_in(queue_.candidate(t).at, t));
}

void ScatteredRefinement::insert_worst() {
  const tin::Triangle t = queue_.worst();
  insert_at(worst_[t], domain_.tin.locate_in(queue_.candidate(t).at, t));
}

std::uint32_t ScatteredRefinement::gain_at(std::uint32_t point) const {
  return gain(domain_.tin.locate(points_.at[point], domain_.tin.last_touched()));
}

void ScatteredRefinement::insert(std::uint32_t point) {
  insert_at(point, domain_.tin.locate(points_.at[point], domain_.tin.last_touched()));
}

void ScatteredRefinement::insert_at(std::uint32_t point, const tin::Triangulation::Location& location) {
  inside_ += gain(location);
  deal_out(domain_.insert(point, points_.at[point], location));
}

void ScatteredRefinement::insert_free(Point at, double z, const tin::Triangulation::Location& location) {
  inside_ += gain(location);
  deal_out(domain_.insert_free(at, z, location));
}

void ScatteredRefinement::deal_out(tin::Vertex v) {
  const std::size_t count = domain_.tin.triangle_count();
  queue_.grow(count);
  first_.resize(count, tin::kNone);
  worst_.resize(count, tin::kNone);
  deal(v);
}

}  // namespace scarp::refine
