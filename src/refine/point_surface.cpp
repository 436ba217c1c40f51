#include "refine/point_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "refine/concave_outline.h"

namespace scarp::refine {

Result<PointSurface> PointSurface::make(const PointSet& points, DuplicatePolicy duplicates) {
  SCARP_TRY(auto&& snapped, grid::snap_points(points, duplicates, grid::PointSteps::kFit));
  SCARP_TRY(auto&& domain, build_domain(snapped));
  add_points(snapped, 1, domain);
  return PointSurface(std::move(snapped), std::move(domain));
}

PointSurface::Height PointSurface::at(double x, double y) const {
  const grid::PointLattice& lattice = snapped_.lattice;
  const double col = (x - lattice.west) / lattice.step, row = (lattice.north - y) / lattice.step;
  if (!(col >= 0 && row >= 0 && col <= lattice.cols - 1 && row <= lattice.rows - 1)) return beyond(x, y);
  const tin::Triangulation& tin = domain_.tin;
  const Point near{static_cast<std::int32_t>(std::lround(col)), static_cast<std::int32_t>(std::lround(row))};
  const auto found = tin.locate(near, hint_);
  tin::Triangle t = found.edge / 3;
  hint_ = t;
  if (found.kind == tin::Triangulation::Location::Kind::kOnVertex) {
    const std::uint32_t point = domain_.point_of[tin.origin(found.edge)];
    return point == tin::kNone ? beyond(x, y) : Height{snapped_.z[point], 0};
  }
  const tin::HalfEdge twin = tin.twin(found.edge);
  if (tin.is_outside(t) && found.kind == tin::Triangulation::Location::Kind::kOnEdge && twin != tin::kNone)
    t = twin / 3;
  if (tin.is_outside(t)) return beyond(x, y);
  std::array<double, 3> z{};
  for (unsigned k = 0; k < 3; ++k) z[k] = snapped_.z[domain_.point_of[tin.origin(3 * t + k)]];
  return {geom::Plane::through_double(tin.corners(t), z).height_at(near), 0};
}

double PointSurface::spacing() const {
  double doubled = 0;
  const tin::Triangulation& tin = domain_.tin;
  for (tin::Triangle t = 0; t < tin.triangle_count(); ++t) {
    const auto [a, b, c] = tin.corners(t);
    if (!tin.is_outside(t)) doubled += static_cast<double>(orient(a, b, c));
  }
  return snapped_.lattice.step * std::sqrt(doubled / 2 / static_cast<double>(snapped_.size()));
}

PointSurface::Height PointSurface::beyond(double x, double y) const {
  const grid::PointLattice& lattice = snapped_.lattice;
  const auto& outline = domain_.outlines.front();
  Height nearest{0, std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const std::uint32_t from = outline[i], to = outline[(i + 1) % outline.size()];
    const auto place = [&](std::uint32_t point) {
      const Point p = snapped_.at[point];
      return std::array{lattice.west + lattice.step * p.x, lattice.north - lattice.step * p.y};
    };
    const auto [ax, ay] = place(from);
    const auto [bx, by] = place(to);
    const double dx = bx - ax, dy = by - ay;
    const double share = std::clamp(((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
    const double distance = std::hypot(x - ax - share * dx, y - ay - share * dy);
    if (distance < nearest.distance)
      nearest = {snapped_.z[from] + share * (snapped_.z[to] - snapped_.z[from]), distance};
  }
  return nearest;
}

}  // namespace scarp::refine
