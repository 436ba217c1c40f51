// Lengths, angles and circles of lattice points in a mesh's coordinates, where samples need not be square.
#pragma once

#include <array>
#include <cstdint>

#include "tin/triangulation.h"

namespace scarp::shape {

/// Offsets of lattice points in an affine frame. Uses only IEEE arithmetic and square roots, which are the same on
/// every machine.
class PlanMetric {
 public:
  using Vector = std::array<double, 2>;

  /// `affine`: like Frame::affine, of samples; must be invertible. `steps`: lattice steps per sample.
  PlanMetric(const std::array<double, 6>& affine, std::int32_t steps);

  Vector to_plan(const Vector& offset) const;     ///< image of an offset in steps
  Vector to_lattice(const Vector& offset) const;  ///< inverse of to_plan()
  Vector between(Point a, Point b) const { return to_plan({double(b.x) - a.x, double(b.y) - a.y}); }
  double square(Point a, Point b) const;               ///< squared distance
  double dot(Point apex, Point a, Point b) const;      ///< Dot product of the vectors from the apex.
  double shorter_side() const { return short_side_; }  ///< Shorter side of a sample.
  double longer_side() const { return long_side_; }
  /// True if d lies inside the circumcircle of a positive triangle. Exact for square samples; otherwise false if
  /// rounding makes it doubtful.
  bool is_in_circle(const std::array<Point, 3>& corners, Point d) const;

 private:
  std::array<double, 4> to_plan_, to_lattice_;  ///< row by row
  double short_side_, long_side_;
  bool is_similar_;  ///< circles of the lattice remain circles
};

/// Flips towards Delaunay edges in that frame.
class PlanDelaunay final : public tin::FlipRule {
 public:
  explicit PlanDelaunay(const PlanMetric& metric) : metric_(metric) {}
  bool should_flip(const tin::Triangulation& tin, tin::HalfEdge h) override;

 private:
  const PlanMetric& metric_;
};

/// Flips free edges until all are Delaunay.
void restore_delaunay(tin::Triangulation& tin, PlanDelaunay& rule);

/// sin² and cos² of an angle of 0 … 90 degrees, by series, since C libraries differ in the last bit.
struct SquaredAngle {
  double sine, cosine;
};
SquaredAngle squares_of(double degrees);

}  // namespace scarp::shape
