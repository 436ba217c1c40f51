// Triangles of a triangulation in the plan of its mesh: edges, walls, sharp angles.
#pragma once

#include <algorithm>

#include "shape/plan_metric.h"
#include "tin/triangulation.h"

namespace scarp {

/// True if the angle between two vectors is less than one of 0 … 90 degrees with this squared cosine. `squares`: the
/// product of the vectors' squared lengths.
inline bool is_sharper(double dot, double squares, double cosine2) { return dot > 0 && dot * dot > cosine2 * squares; }

/// cos² of 45 degrees: sharper corners between walls are acute. Corners of nodata outlines never are.
inline constexpr double kAcute = 0.5;

class PlanShapes {
 public:
  /// Borrows `tin` and `metric`. `cosine2`: squared cosine of the smallest allowed angle.
  PlanShapes(const Triangulation& tin, const PlanMetric& metric, double cosine2)
      : tin_(tin), metric_(metric), cosine2_(cosine2) {}

  double square(HalfEdge h) const {
    return metric_.square(tin_.point(tin_.origin(h)), tin_.point(tin_.origin(Triangulation::next(h))));
  }
  HalfEdge shortest(Triangle t) const {
    return std::min({3 * t, 3 * t + 1, 3 * t + 2}, [&](HalfEdge a, HalfEdge b) { return square(a) < square(b); });
  }
  /// True if no edge may cross this edge.
  bool is_wall(HalfEdge h) const {
    const HalfEdge g = tin_.twin(h);
    return g == kNone || tin_.is_constrained(h) || tin_.is_outside(g / 3);
  }
  /// True if an angle of the surface is too small.
  bool is_sharp(Triangle t) const {
    if (tin_.is_outside(t)) return false;
    const HalfEdge h = shortest(t);
    return is_sharper(dot_over(h), square(Triangulation::next(h)) * square(Triangulation::previous(h)), cosine2_);
  }
  /// True if the input forces the small angle: the angle lies between two walls, or opposite an edge that joins two
  /// walls of an acute corner.
  bool is_forced(Triangle t) const {
    const HalfEdge h = shortest(t);
    const auto is_corner = [&](HalfEdge side) {
      return is_wall(Triangulation::next(side)) && is_wall(Triangulation::previous(side));
    };
    if (is_corner(h)) return true;
    const HalfEdge g = tin_.twin(h);
    if (is_wall(h) || !is_corner(g)) return false;
    return is_sharper(dot_over(g), square(Triangulation::next(g)) * square(Triangulation::previous(g)), kAcute);
  }

 private:
  /// Dot product of the vectors from the opposite corner to the ends of the edge.
  double dot_over(HalfEdge h) const {
    return metric_.dot(tin_.point(tin_.origin(Triangulation::previous(h))), tin_.point(tin_.origin(h)),
                       tin_.point(tin_.origin(Triangulation::next(h))));
  }

  const Triangulation& tin_;
  const PlanMetric& metric_;
  double cosine2_;
};

}  // namespace scarp
