// Errors of trial triangles at scattered samples; triangle_error.h handles samples of rasters.
//
// A sample's weights in a triangle are exact areas: coordinates are integer steps below 2²⁴, so products of their
// differences fit a double. A sample on an edge counts in both triangles. Errors are computed in double and decided
// exactly where rounding could matter.
#pragma once

#include <array>
#include <cstddef>

#include "base/point.h"
#include "fit/point_samples.h"
#include "fit/triangle_error.h"

namespace scarp::fit {

/// A sample is {its index in the window, 0}.
class PointError final : public ScatteredErrors {
 public:
  using Verdict = TriangleError::Verdict;

  /// REQUIRES: threshold >= 0, finite.
  void read(const PointSamples& samples, const Patch::Window& window, double threshold);

  /// A triangle so steep that the rounding of sample places matters also breaks the bound, but has an energy.
  Verdict assess(const Corners& corners, float energy_limit, double limit, ErrorRule::Power power) const override;
  TriangleError::Pull pull(const Corners& corners, ErrorRule::Power power) const override;
  void add_moments(const Corners& corners, ErrorRule::Power power, TriangleError::Moments& moments) const override;
  void narrow(const Corners& corners, TriangleError::Room& room) const override;

  double threshold() const override { return threshold_; }
  FitCorner at(Point sample) const override { return window_.at(static_cast<std::size_t>(sample.x)); }
  Point nearest(const FitCorner& place) const override {
    return {static_cast<std::int32_t>(window_.nearest(place)), 0};
  }
  std::array<double, 2> slope_at(const FitCorner& place) const override;

 private:
  struct Task;
  template <class Visit>
  bool each_run(const Task& task, const Visit& visit) const;
  template <class Sums>
  Sums ask(const Corners& corners, Sums sums) const;
  bool keeps_exactly(const Task& task, std::size_t sample) const;

  PointWindow window_;
  double threshold_ = 0;
  double per_threshold_ = 0;  // 0 where errors have no energy
  double steepest_ = 0;       // largest slope of new triangles, height per step
};

}  // namespace scarp::fit
