// The general error metric: combined errors of heights and channels, with a bound and an importance factor per sample.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "geom/plane.h"
#include "grid/raster.h"
#include "metric/error_metric.h"
#include "scarp/options.h"

namespace scarp::metric {

/// A field whose errors are combined. It is valid wherever the heights are valid.
struct MetricField {
  const float* samples = nullptr;
  double scale = 1;  ///< above 0
};

/// Keeps factors finite, so that errors still count.
inline constexpr float kMostFactor = 1e30f;
/// The importance factor of a sample, for ranking by error / bound. A bound of 0 outranks all others.
inline float per_bound(float bound) { return std::min(1 / bound, kMostFactor); }

/// Borrows everything.
struct MetricSettings {
  grid::Raster heights;             ///< determine which samples are valid
  std::vector<MetricField> fields;  ///< at least one
  Norm norm = Norm::kSum;
  double threshold = 0;            ///< bound of the combined error, if `bounds` is null
  const float* bounds = nullptr;   ///< bound of each sample, +infinity: none
  const float* factors = nullptr;  ///< importance = error · factor; null: the error
  bool per_bound = false;          ///< importance = error · per_bound(bound); without `factors`
  bool by_error = true;            ///< false: importance = factor
  /// Importance is also multiplied by the damped distance from the nearest corner. DEFAULT: off.
  std::optional<Importance::Damping> distance = {};
  double goal = 0;  ///< see ErrorMetric::goal()
};

/// Settings for heights only, with individual bounds, ranked by error over bound.
MetricSettings settings_by_bounds(const grid::Raster& raster, std::span<const float> bounds);

/// With one field of scale 1, comparisons with bounds are exact. A norm of several fields is compared with a margin for
/// its rounding, on the safe side, and exactly only for the bound 0. So a sample whose norm equals its bound may be
/// inserted, but no sample above its bound remains.
class SampleMetric final : public ErrorMetric {
 public:
  explicit SampleMetric(MetricSettings settings);

  Fit fit(const std::array<Point, 3>& corners, const FitQuestion& question) const override;
  std::optional<Candidate> find_candidate(const std::array<Point, 3>& corners, const Fit& fit) const override;
  double goal() const override { return settings_.goal; }
  double squares_between(Point a, Point b) const override;
  double bend(const std::array<Point, 3>& a, const std::array<Point, 3>& b) const override;

 private:
  struct Surface;
  Surface surface(const std::array<Point, 3>& corners) const;
  /// The combined errors of consecutive samples of a row.
  void combine_row(const Surface& surface, Point start, std::span<double> errors) const;
  double combine(const Surface& surface, Point p) const;
  double bound_at(std::size_t index) const {
    return settings_.bounds != nullptr ? double{settings_.bounds[index]} : settings_.threshold;
  }
  double importance(double error, std::size_t index, const std::array<Point, 3>& corners, Point p) const;
  double weighted(double error, std::size_t index) const;
  bool exceeds(const std::array<Point, 3>& corners, Point p, std::size_t index) const;
  std::array<float, 3> values_at(const MetricField& field, const std::array<Point, 3>& corners) const;
  std::size_t index_of(Point p) const {
    return static_cast<std::size_t>(p.y) * static_cast<std::size_t>(settings_.heights.cols) +
           static_cast<std::size_t>(p.x);
  }
  void refine_scores(const Surface& surface, const std::array<Point, 3>& corners, const FitQuestion& question,
                     Fit& fit) const;

  MetricSettings settings_;
};

}  // namespace scarp::metric
