// Triangles of a triangulation in the plan of its mesh: edges, walls, sharp angles.
#pragma once

#include <algorithm>

#include "shape/plan_metric.h"
#include "tin/triangulation.h"

namespace scarp::shape {

/// True if the angle between two vectors is less than one of 0 … 90 degrees with this squared cosine. `squares`: the
/// product of the vectors' squared lengths.
inline bool is_sharper(double dot, double squares, double cosine2) { return dot > 0 && dot * dot > cosine2 * squares; }

/// cos² of 45 degrees: sharper corners between walls are acute. Corners of nodata outlines never are.
inline constexpr double kAcute = 0.5;

class PlanShapes {
 public:
  /// Borrows `tin` and `metric`. `cosine2`: squared cosine of the smallest allowed angle.
  PlanShapes(const tin::Triangulation& tin, const PlanMetric& metric, double cosine2)
      : tin_(tin), metric_(metric), cosine2_(cosine2) {}

  double square(tin::HalfEdge h) const {
    return metric_.square(tin_.point(tin_.origin(h)), tin_.point(tin_.origin(tin::Triangulation::next(h))));
  }
  tin::HalfEdge shortest(tin::Triangle t) const {
    return std::min({3 * t, 3 * t + 1, 3 * t + 2},
                    [&](tin::HalfEdge a, tin::HalfEdge b) { return square(a) < square(b); });
  }
  /// True if no edge may cross this edge.
  bool is_wall(tin::HalfEdge h) const {
    const tin::HalfEdge g = tin_.twin(h);
    return g == tin::kNone || tin_.is_constrained(h) || tin_.is_outside(g / 3);
  }
  /// True if an angle of the surface is too small.
  bool is_sharp(tin::Triangle t) const {
    if (tin_.is_outside(t)) return false;
    const tin::HalfEdge h = shortest(t);
    return is_sharper(dot_over(h), square(tin::Triangulation::next(h)) * square(tin::Triangulation::previous(h)),
                      cosine2_);
  }
  /// True if the input forces the small angle: the angle lies between two walls, or opposite an edge that joins two
  /// walls of an acute corner.
  bool is_forced(tin::Triangle t) const {
    const tin::HalfEdge h = shortest(t);
    const auto is_corner = [&](tin::HalfEdge side) {
      return is_wall(tin::Triangulation::next(side)) && is_wall(tin::Triangulation::previous(side));
    };
    if (is_corner(h)) return true;
    const tin::HalfEdge g = tin_.twin(h);
    if (is_wall(h) || !is_corner(g)) return false;
    return is_sharper(dot_over(g), square(tin::Triangulation::next(g)) * square(tin::Triangulation::previous(g)),
                      kAcute);
  }

 private:
  /// Dot product of the vectors from the opposite corner to the ends of the edge.
  double dot_over(tin::HalfEdge h) const {
    return metric_.dot(tin_.point(tin_.origin(tin::Triangulation::previous(h))), tin_.point(tin_.origin(h)),
                       tin_.point(tin_.origin(tin::Triangulation::next(h))));
  }

  const tin::Triangulation& tin_;
  const PlanMetric& metric_;
  double cosine2_;
};

}  // namespace scarp::shape
