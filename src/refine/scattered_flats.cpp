// Flat triangles: in the bend of a contour, three of its points form a triangle without slope, a terrace that the land
// does not have. If the quadrilateral with the adjacent triangle is convex, its other diagonal leads to the next
// contour.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "refine/scattered.h"

namespace scarp::refine {

namespace {

/// False if the triangle is so thin that the rounding of a file may move a vertex beyond it.
bool is_thick(Point a, Point b, Point c) {
  constexpr double kThinnest = 1.0 / 64;  // height over longest side
  const auto square = [](Point p, Point q) {
    const double x = double(q.x) - p.x, y = double(q.y) - p.y;
    return x * x + y * y;
  };
  return static_cast<double>(orient(a, b, c)) >= kThinnest * std::max({square(a, b), square(b, c), square(c, a)});
}

}  // namespace

class ScatteredRefinement::FlatRule final : public tin::FlipRule {
 public:
  FlatRule(ScatteredRefinement& refinement, const std::vector<bool>& is_marked)
      : own_(refinement), is_marked_(is_marked) {}

  bool is_flat(const std::array<tin::Vertex, 3>& corners) const {
    const auto height = [&](std::size_t k) { return own_.domain_.height(corners[k], own_.heights_); };
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t point = own_.domain_.point_of[corners[k]];
      if (point == tin::kNone || !is_marked_[point] || height(k) != height(0)) return false;
    }
    return true;
  }
  bool is_flat(tin::Triangle t) const {
    const tin::Triangulation& tin = own_.domain_.tin;
    return is_flat({tin.origin(3 * t), tin.origin(3 * t + 1), tin.origin(3 * t + 2)});
  }

  bool should_flip(const tin::Triangulation& tin, tin::HalfEdge h) override {
    const tin::HalfEdge g = tin.twin(h);
    const tin::Triangle t = h / 3, u = g / 3;
    if (tin.is_outside(t) || tin.is_outside(u)) return false;
    const int before = is_flat(t) + is_flat(u);
    if (before == 0) return false;
    const tin::Vertex a = tin.origin(h), b = tin.origin(g), c = tin.origin(tin::Triangulation::previous(h)),
                      d = tin.origin(tin::Triangulation::previous(g));
    const std::array<tin::Vertex, 3> one{c, d, b}, other{d, c, a};
    if (is_flat(one) + is_flat(other) >= before) return false;
    const Point pc = tin.point(c), pd = tin.point(d);
    if (!is_thick(pc, pd, tin.point(b)) || !is_thick(pd, pc, tin.point(a))) return false;
    const Wedge wedges[] = {own_.wedge_of(t, one), own_.wedge_of(u, other)};
    std::array<std::vector<std::uint32_t>, 2> lists;
    for (const tin::Triangle triangle : {t, u}) {
      for (std::uint32_t point = own_.first_[triangle]; point != tin::kNone; point = own_.next_[point]) {
        const std::size_t side = orient(pc, pd, own_.points_.at[point]) >= 0 ? 0 : 1;
        if (breaks(wedges[side], point)) return false;
        lists[side].push_back(point);
      }
    }
    own_.first_[t] = own_.first_[u] = tin::kNone;
    for (std::size_t side = 0; side < 2; ++side) {
      std::uint32_t& first = own_.first_[wedges[side].triangle];
      for (const std::uint32_t point : lists[side]) {
        own_.next_[point] = first;
        first = point;
      }
    }
    return true;
  }

 private:
  bool breaks(const Wedge& wedge, std::uint32_t point) const {
    const double error = own_.error_of(wedge, point), guard = own_.guard_of(wedge);
    if (error < own_.threshold_ - guard) return false;
    return error > own_.threshold_ + guard || own_.exceeds(wedge, point);
  }

  ScatteredRefinement& own_;
  const std::vector<bool>& is_marked_;
};

std::uint64_t ScatteredRefinement::flip_flats(const std::vector<bool>& is_marked) {
  FlatRule rule(*this, is_marked);
  tin::Triangulation& tin = domain_.tin;
  std::vector<tin::HalfEdge> edges;
  for (tin::HalfEdge h = 0; h < 3 * tin.triangle_count(); ++h) {
    if (tin.twin(h) != tin::kNone && h < tin.twin(h)) edges.push_back(h);
  }
  tin.improve(edges, rule, std::numeric_limits<std::size_t>::max());
  std::uint64_t flats = 0;
  for (tin::Triangle t = 0; t < tin.triangle_count(); ++t) flats += !tin.is_outside(t) && rule.is_flat(t);
  return flats;
}

}  // namespace scarp::refine
