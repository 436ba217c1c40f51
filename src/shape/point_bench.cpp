#include "shape/point_bench.h"

#include <algorithm>
#include <array>

#include "geom/plane.h"

namespace scarp {

bool PointBench::insert(Point p, const Triangulation::Location& location) {
  const Triangulation& tin = domain_.tin;
  const Triangle t = location.edge / 3;
  std::array<double, 3> z{};
  for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) z[h - 3 * t] = domain_.height(tin.origin(h), heights_);
  insert_at(p, Plane::through_double(tin.corners(t), z).height_at(p), location);
  return true;
}

void PointBench::insert_on_edge(Point p, HalfEdge h, double share) {
  const Triangulation& tin = domain_.tin;
  const double za = domain_.height(tin.origin(h), heights_);
  const double zb = domain_.height(tin.origin(Triangulation::next(h)), heights_);
  insert_at(p, za + (zb - za) * share, {Triangulation::Location::Kind::kOnEdge, std::min(h, tin.twin(h))});
}

void PointBench::insert_at(Point p, double z, const Triangulation::Location& location) {
  if (const std::uint32_t point = find_point(points_, p); point != points_.size())
    return refinement_.insert_at(point, location);
  refinement_.insert_free(p, double{static_cast<float>(z)}, location);
}

}  // namespace scarp
