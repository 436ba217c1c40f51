// The plain error metric of samples that are not in memory as floats.
#pragma once

#include "metric/error_metric.h"
#include "metric/source_bounds.h"
#include "scarp/height_field.h"

namespace scarp::metric {

/// Equals HeightMetric, bit for bit, or SampleMetric if samples have individual bounds. Suits only few queries, because
/// each query reads a window of the source around a triangle. Throws SourceFailure if a source fails.
class SourceMetric final : public ErrorMetric {
 public:
  /// `bounds`: null if the threshold applies to all; must outlive it.
  SourceMetric(const HeightField& field, double threshold, const SourceBounds* bounds = nullptr)
      : field_(field), threshold_(threshold), bounds_(bounds) {}

  Fit fit(const std::array<Point, 3>& corners, const FitQuestion& question) const override;
  std::optional<Candidate> find_candidate(const std::array<Point, 3>& corners, const Fit& fit) const override;
  double goal() const override { return bounds_ != nullptr ? 1 : threshold_; }
  double squares_between(Point a, Point b) const override;
  double bend(const std::array<Point, 3>& a, const std::array<Point, 3>& b) const override;

 private:
  const HeightField& field_;
  double threshold_;
  const SourceBounds* bounds_;
};

}  // namespace scarp::metric
