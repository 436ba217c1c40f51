// The plain error metric: vertical errors of heights against one threshold.
#pragma once

#include "grid/raster.h"
#include "metric/error_metric.h"

namespace scarp::metric {

class HeightMetric final : public ErrorMetric {
 public:
  HeightMetric(const grid::Raster& raster, double threshold) : raster_(raster), threshold_(threshold) {}

  Fit fit(const std::array<Point, 3>& corners, const FitQuestion& question) const override;
  std::optional<Candidate> find_candidate(const std::array<Point, 3>& corners, const Fit& fit) const override;
  double goal() const override { return threshold_; }
  double squares_between(Point a, Point b) const override;
  double bend(const std::array<Point, 3>& a, const std::array<Point, 3>& b) const override;

 private:
  grid::Raster raster_;
  double threshold_;
};

}  // namespace scarp::metric
