#include "shape/plan_metric.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace scarp::shape {

PlanMetric::PlanMetric(const std::array<double, 6>& affine, std::int32_t steps) {
  const double scale = 1.0 / steps, determinant = affine[1] * affine[5] - affine[2] * affine[4];
  to_plan_ = {affine[1] * scale, affine[2] * scale, affine[4] * scale, affine[5] * scale};
  to_lattice_ = {affine[5] / determinant * steps, -affine[2] / determinant * steps, -affine[4] / determinant * steps,
                 affine[1] / determinant * steps};
  const double across = affine[1] * affine[1] + affine[4] * affine[4],
               down = affine[2] * affine[2] + affine[5] * affine[5];
  short_side_ = std::sqrt(std::min(across, down));
  long_side_ = std::sqrt(std::max(across, down));
  is_similar_ = across == down && affine[1] * affine[2] + affine[4] * affine[5] == 0;
}

PlanMetric::Vector PlanMetric::to_plan(const Vector& offset) const {
  return {to_plan_[0] * offset[0] + to_plan_[1] * offset[1], to_plan_[2] * offset[0] + to_plan_[3] * offset[1]};
}

PlanMetric::Vector PlanMetric::to_lattice(const Vector& offset) const {
  return {to_lattice_[0] * offset[0] + to_lattice_[1] * offset[1],
          to_lattice_[2] * offset[0] + to_lattice_[3] * offset[1]};
}

double PlanMetric::square(Point a, Point b) const { return dot(a, b, b); }

double PlanMetric::dot(Point apex, Point a, Point b) const {
  const Vector u = between(apex, a), v = between(apex, b);
  return u[0] * v[0] + u[1] * v[1];
}

bool PlanMetric::is_in_circle(const std::array<Point, 3>& corners, Point d) const {
  if (is_similar_) return geom::in_circle(corners[0], corners[1], corners[2], d) > 0;
  // The frame may mirror triangles, so signs come from offsets on the lattice, and squares from the plan.
  std::array<double, 3> x, y, squares;
  for (std::size_t k = 0; k < 3; ++k) {
    x[k] = double(corners[k].x) - d.x;
    y[k] = double(corners[k].y) - d.y;
    squares[k] = square(corners[k], d);
  }
  double sum = 0, size = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    sum += squares[k] * (x[i] * y[j] - x[j] * y[i]);
    size += squares[k] * (std::abs(x[i] * y[j]) + std::abs(x[j] * y[i]));
  }
  return sum > 1e-13 * size;
}

bool PlanDelaunay::should_flip(const tin::Triangulation& tin, tin::HalfEdge h) {
  const tin::HalfEdge g = tin.twin(h);
  const std::array<Point, 3> corners = tin.corners(h / 3);
  const Point a = tin.point(tin.origin(h)), b = tin.point(tin.origin(g)),
              c = tin.point(tin.origin(tin::Triangulation::previous(h))),
              d = tin.point(tin.origin(tin::Triangulation::previous(g)));
  return metric_.is_in_circle(corners, d) && orient(c, d, b) > 0 && orient(d, c, a) > 0;
}

void restore_delaunay(tin::Triangulation& tin, PlanDelaunay& rule) {
  std::vector<tin::HalfEdge> edges;
  for (tin::HalfEdge h = 0; h < 3 * tin.triangle_count(); ++h) {
    if (tin.twin(h) != tin::kNone && h < tin.twin(h)) edges.push_back(h);
  }
  tin.improve(edges, rule, std::numeric_limits<std::size_t>::max());
}

SquaredAngle squares_of(double degrees) {
  const double angle = degrees * (std::numbers::pi / 180);
  double sine = 0, term = angle;
  for (int k = 1; k < 30; k += 2) {
    sine += term;
    term *= -angle * angle / ((k + 1) * (k + 2));
  }
  return {sine * sine, 1 - sine * sine};
}

}  // namespace scarp::shape
