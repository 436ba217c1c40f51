// Errors of trial triangles where samples are scattered: what triangle_error.h does on a raster's rows.
//
// A sample's weights in a triangle are areas, and these are exact: coordinates are whole steps below 2²⁴, so products
// of their differences fit a double. A sample on an edge counts in both triangles. Errors are computed in double and
// decided exactly where rounding could matter.
#pragma once

#include <array>
#include <cstddef>

#include "base/point.h"
#include "fit/point_samples.h"
#include "fit/triangle_error.h"

namespace scarp {

class PointError {
 public:
  using Corners = std::array<FitCorner, 3>;
  using Verdict = TriangleError::Verdict;

  /// The window stays alive. REQUIRES: threshold >= 0, finite.
  PointError(const PointWindow& window, double threshold, double rounding);

  /// The functions of TriangleError with these names, for points; `limit`: slack × threshold. A sample is {its index in
  /// the window, 0}. Triangles so steep that the samples' rounding counts break the bound, too, but have an energy.
  Verdict assess(const Corners& corners, float energy_limit, double limit, ErrorRule::Power power) const;
  TriangleError::Pull pull(const Corners& corners, ErrorRule::Power power) const;
  void add_moments(const Corners& corners, ErrorRule::Power power, TriangleError::Moments& moments) const;
  void narrow(const Corners& corners, TriangleError::Room& room) const;

  double threshold() const { return threshold_; }
  FitCorner at(Point sample) const { return window_.at(static_cast<std::size_t>(sample.x)); }
  Point nearest(const FitCorner& place) const { return {static_cast<std::int32_t>(window_.nearest(place)), 0}; }

  /// The slopes of the plane of least squares through the samples around a place, heights a kLatticeSteps; 0 where
  /// there are too few.
  std::array<double, 2> slope_at(const FitCorner& place) const;

 private:
  struct Task;
  template <class Visit>
  bool each_run(const Task& task, const Visit& visit) const;
  template <class Sums>
  Sums ask(const Corners& corners, Sums sums) const;
  bool keeps_exactly(const Task& task, std::size_t sample) const;

  const PointWindow& window_;
  double threshold_;
  double per_threshold_;  // 0 where energies end
  double steepest_;       // largest slope of new triangles, heights a step
};

}  // namespace scarp
