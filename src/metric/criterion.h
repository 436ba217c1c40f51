// The error criterion from the options and the field, prepared for the engine and for the proof.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "metric/bound_rule.h"
#include "metric/error_metric.h"
#include "metric/request.h"
#include "metric/sample_metric.h"
#include "metric/source_bounds.h"
#include "scarp/height_field.h"
#include "scarp/options.h"

namespace scarp::metric {

/// True if samples have individual tolerances, in memory or in a source.
bool has_tolerances(const SimplifyOptions& options);
/// True if samples in memory have individual bounds, by tolerances or weights, or because some are ignored.
bool has_own_bounds(const SimplifyOptions& options, bool is_streamed);
/// The bound at a sample of a raster in memory, from tolerances, weights and `max_error` (none: no general bound);
/// +infinity: no bound.
double asked_bound(const SimplifyOptions& options, std::optional<double> max_error, Point at, std::int32_t cols);

/// Owns the arrays of the engine's error metric: at most 12 bytes per sample, 0 for plain heights and for bounds read
/// in windows.
class Criterion {
 public:
  /// Checks mask, tolerance, channels and importance against the raster. Fails with kUsage, kInput (a channel has no
  /// value at a sample, which the error names) and kPromise (a tolerance below the rounding of the samples). `field`,
  /// `options` and the raster's samples must outlive it. `aim`: the fraction of the bounds that the metric targets if
  /// only heights have bounds. `factor`: multiplies all tolerances.
  static Result<Criterion> make(const HeightField& field, const Request& options, const grid::Raster& raster,
                                double aim = 1, double factor = 1);
  /// A temporary Request, converted from SimplifyOptions, would not live long enough.
  static Result<Criterion> make(const HeightField&, Request&&, const grid::Raster&, double = 1, double = 1) = delete;

  const ErrorMetric& metric() const { return *metric_; }
  /// Bound of the combined error if samples have no individual bounds; none without an error goal.
  std::optional<double> bound() const { return bound_; }
  /// The metric's target instead of bound().
  double aim() const { return aim_ * bound_.value_or(0); }
  /// Factor of all tolerances.
  double factor() const { return factor_; }
  /// The max error of all samples; +infinity: none.
  double most() const { return options_->goals.max_error.value_or(HUGE_VAL); }
  /// The reserve of bounds for the rounding of samples.
  double reserve() const { return field_->sample_rounding; }
  /// Bounds of the samples; empty if bound() applies to all.
  std::span<const float> bounds() const { return bounds_; }
  /// Bounds read in windows; null: bound() and bounds() are complete.
  const SourceBounds* source_bounds() const { return source_bounds_.get(); }
  /// The metric's largest target at a valid sample; +infinity if a sample has none. REQUIRES: samples in memory.
  double largest_aim() const;
  /// The metric's targets.
  std::span<const float> aims() const { return aims_.empty() ? bounds_ : aims_; }
  /// True if the engine's importance is an error that grows and shrinks with the bounded error.
  bool importance_is_error() const { return importance_is_error_; }
  /// Order of insertion for one pass, without unbounded samples; empty if not used.
  std::vector<Point> ranking() const;
  /// Number of samples without a bound. Those of source_bounds() are not included: the proof counts them.
  std::uint64_t ignored() const { return ignored_; }
  /// The channels of the field.
  const std::vector<Channel>& channels() const { return field_->channels; }
  /// The fields whose errors count.
  std::vector<MetricField> metric_fields() const;
  bool has_error_goal() const { return bound_.has_value() || has_tolerances(*options_); }

 private:
  Result<void> check_weights() const;
  Result<void> check_strategy() const;  // in importance.cpp
  Result<void> check_channels() const;
  Result<void> set_bounds();
  void set_factors();
  BoundRule rule() const { return {field_->sample_rounding, aim_}; }
  Point place(std::size_t index) const;

  const HeightField* field_ = nullptr;
  const Request* options_ = nullptr;
  grid::Raster raster_;
  std::optional<double> bound_;
  double aim_ = 1, factor_ = 1;
  std::vector<float> bounds_, aims_, factors_;
  std::unique_ptr<SourceBounds> source_bounds_;
  std::uint64_t ignored_ = 0;
  bool importance_is_error_ = true;
  std::unique_ptr<ErrorMetric> metric_;
};

}  // namespace scarp::metric
