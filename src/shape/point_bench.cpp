#include "shape/point_bench.h"

#include <algorithm>
#include <array>

#include "geom/plane.h"

namespace scarp::shape {

bool PointBench::insert(Point p, const tin::Triangulation::Location& location) {
  const tin::Triangulation& tin = domain_.tin;
  const tin::Triangle t = location.edge / 3;
  std::array<double, 3> z{};
  for (tin::HalfEdge h = 3 * t; h < 3 * t + 3; ++h) z[h - 3 * t] = domain_.height(tin.origin(h), heights_);
  insert_at(p, geom::Plane::through_double(tin.corners(t), z).height_at(p), location);
  return true;
}

void PointBench::insert_on_edge(Point p, tin::HalfEdge h, double share) {
  const tin::Triangulation& tin = domain_.tin;
  const double za = domain_.height(tin.origin(h), heights_);
  const double zb = domain_.height(tin.origin(tin::Triangulation::next(h)), heights_);
  insert_at(p, za + (zb - za) * share, {tin::Triangulation::Location::Kind::kOnEdge, std::min(h, tin.twin(h))});
}

void PointBench::insert_at(Point p, double z, const tin::Triangulation::Location& location) {
  if (const std::uint32_t point = grid::find_point(points_, p); point != points_.size())
    return refinement_.insert_at(point, location);
  refinement_.insert_free(p, double{static_cast<float>(z)}, location);
}

}  // namespace scarp::shape
