#include "metric/criterion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "metric/height_metric.h"
#include "metric/importance.h"
#include "metric/source_metric.h"

namespace scarp::metric {

namespace {

constexpr float kUnbounded = std::numeric_limits<float>::infinity();

tl::unexpected<Error> usage(std::string message) { return fail(ErrorKind::kUsage, std::move(message)); }

/// The requested bound at a sample that is not ignored.
double asked_of(const SimplifyOptions& options, std::optional<double> max_error, std::size_t i, double factor) {
  const Tolerances& tolerances = options.tolerances;
  double asked = max_error.value_or(tolerances.values.empty() ? 0 : HUGE_VAL);
  if (!tolerances.values.empty()) asked = std::min(asked, factor * tolerances.values[i]);
  if (tolerances.weights.empty()) return asked;
  const double weight = tolerances.weights[i];
  return weight > 0 ? divide_down(asked, weight) : HUGE_VAL;
}

}  // namespace

bool has_tolerances(const SimplifyOptions& options) {
  return !options.tolerances.values.empty() || options.tolerances.source != nullptr;
}

bool has_own_bounds(const SimplifyOptions& options, bool is_streamed) {
  const Tolerances& asked = options.tolerances;
  return !is_streamed && !(asked.weights.empty() && asked.values.empty() && asked.ignored.empty());
}

double asked_bound(const SimplifyOptions& options, std::optional<double> max_error, Point at, std::int32_t cols) {
  const std::span<const SampleAt> ignored = options.tolerances.ignored;
  if (std::find(ignored.begin(), ignored.end(), SampleAt{at.x, at.y}) != ignored.end()) return HUGE_VAL;
  const std::size_t i =
      static_cast<std::size_t>(at.y) * static_cast<std::size_t>(cols) + static_cast<std::size_t>(at.x);
  return asked_of(options, max_error, i, 1);
}

Result<Criterion> Criterion::make(const HeightField& field, const Request& options, const grid::Raster& raster,
                                  double aim, double factor) {
  Criterion criterion;
  criterion.field_ = &field;
  criterion.options_ = &options;
  criterion.raster_ = raster;
  criterion.aim_ = aim;
  criterion.factor_ = factor;
  for (const auto check : {&Criterion::check_weights, &Criterion::check_strategy, &Criterion::check_channels}) {
    SCARP_RETURN_IF_ERROR((criterion.*check)());
  }
  if (options.goals.max_error) criterion.bound_ = tightened(*options.goals.max_error, field.sample_rounding);
  SCARP_RETURN_IF_ERROR(criterion.set_bounds());
  criterion.set_factors();
  if (aim < 1) {
    for (const float of : criterion.bounds_) criterion.aims_.push_back(criterion.rule().aim_at(of));
  }
  const Importance& importance = options.strategy.importance;
  criterion.importance_is_error_ = importance.global && importance.feature == Importance::Feature::kNoFeature;
  const double bound = criterion.aim();
  const bool plain = field.channels.empty() && field.height_scale == 1 && criterion.bounds_.empty() &&
                     criterion.factors_.empty() && importance.feature != Importance::Feature::kDistance;
  if (plain) {
    if (field.samples != nullptr) {
      criterion.metric_ = std::make_unique<HeightMetric>(raster, bound);
    } else {
      criterion.metric_ = std::make_unique<SourceMetric>(field, bound, criterion.source_bounds());
    }
  } else {
    MetricSettings settings{raster, criterion.metric_fields(), options.goals.norm, bound};
    if (!criterion.bounds_.empty()) settings.bounds = criterion.aims().data();
    if (!criterion.factors_.empty()) settings.factors = criterion.factors_.data();
    settings.per_bound = !options.tolerances.values.empty() && criterion.factors_.empty();
    settings.by_error = importance.global;
    if (importance.feature == Importance::Feature::kDistance) settings.distance = importance.damping;
    if (criterion.importance_is_error_) settings.goal = options.tolerances.values.empty() ? bound : 1;
    criterion.metric_ = std::make_unique<SampleMetric>(std::move(settings));
  }
  return criterion;
}

double Criterion::largest_aim() const {
  if (bounds_.empty()) return aim();
  double largest = 0;
  for (std::size_t i = 0; i < bounds_.size(); ++i) {
    if (!std::isnan(raster_.samples[i])) largest = std::max(largest, double{aims()[i]});
  }
  return largest;
}

Point Criterion::place(std::size_t index) const {
  const auto cols = static_cast<std::size_t>(raster_.cols);
  return {static_cast<std::int32_t>(index % cols), static_cast<std::int32_t>(index / cols)};
}

Result<void> Criterion::check_weights() const {
  if ((options_->tolerances.source != nullptr || options_->tolerances.weights_source != nullptr) &&
      field_->samples != nullptr)
    return usage(
        "tolerances and weights are read in windows where samples are: beside samples in memory give them as an array");
  const auto samples = static_cast<std::size_t>(raster_.cols) * static_cast<std::size_t>(raster_.rows);
  for (const auto& [name, values] :
       {std::pair{"the mask", options_->tolerances.weights}, {"the tolerance", options_->tolerances.values}}) {
    if (values.empty()) continue;
    if (values.size() != samples)
      return usage(fmt::format("{} has {} values for {} samples", name, values.size(), samples));
    const bool is_mask = values.data() == options_->tolerances.weights.data();
    const auto bad =
        std::find_if(values.begin(), values.end(), [&](float v) { return !(v >= 0) || (is_mask && v == kUnbounded); });
    if (bad != values.end())
      return tl::unexpected(refuse_value(name, place(static_cast<std::size_t>(bad - values.begin())), *bad,
                                         is_mask ? ", and finite" : ""));
  }
  for (const std::span<const SampleAt> named : {options_->tolerances.ignored, std::span(options_->features.points)}) {
    for (const auto& [col, row] : named) {
      if (col < 0 || row < 0 || col >= raster_.cols || row >= raster_.rows)
        return usage(fmt::format("sample ({}, {}) is named, but the raster has {} x {} samples", col, row, raster_.cols,
                                 raster_.rows));
    }
  }
  return {};
}

Result<void> Criterion::check_channels() const {
  const auto samples = static_cast<std::size_t>(raster_.cols) * static_cast<std::size_t>(raster_.rows);
  if (field_->channels.size() > static_cast<std::size_t>(kMaxChannels))
    return usage(fmt::format("{} channels are more than {}", field_->channels.size(), kMaxChannels));
  if (!(field_->height_scale >= 0 && std::isfinite(field_->height_scale)))
    return usage(fmt::format("the weight of the heights must be at least 0, not {}", field_->height_scale));
  for (std::size_t k = 0; k < field_->channels.size(); ++k) {
    const Channel& channel = field_->channels[k];
    if (!(channel.scale >= 0 && std::isfinite(channel.scale)))
      return usage(fmt::format("the weight of channel {} must be at least 0, not {}", k + 1, channel.scale));
    for (std::size_t i = 0; i < samples; ++i) {
      if (!std::isnan(raster_.samples[i]) && !std::isfinite(channel.samples[i]))
        return fail(
            ErrorKind::kInput,
            fmt::format("channel {} at sample ({}, {}) has no value though the height has one: fill the channel "
                        "there, or make the height nodata too",
                        k + 1, place(i).x, place(i).y));
    }
  }
  if (metric_fields().empty()) return usage("every weight is 0: nothing is left to be judged");
  return {};
}

std::vector<MetricField> Criterion::metric_fields() const {
  std::vector<MetricField> fields;
  if (field_->height_scale > 0) fields.push_back({raster_.samples, field_->height_scale});
  for (const Channel& channel : field_->channels) {
    if (channel.scale > 0) fields.push_back({channel.samples, channel.scale});
  }
  return fields;
}

Result<void> Criterion::set_bounds() {
  if (has_source_bounds(*options_, field_->samples == nullptr)) {
    source_bounds_ = std::make_unique<SourceBounds>(*options_, rule(), factor_);
    return {};
  }
  if (!has_own_bounds(*options_, field_->samples == nullptr)) return {};
  const auto samples = static_cast<std::size_t>(raster_.cols) * static_cast<std::size_t>(raster_.rows);
  bounds_.resize(samples);
  for (std::size_t i = 0; i < samples; ++i) {
    const double asked = asked_of(*options_, options_->goals.max_error, i, factor_);
    if (has_error_goal() && asked < rule().reserve && !std::isnan(raster_.samples[i]))
      return tl::unexpected(rule().refuse(place(i), asked));
    bounds_[i] = rule().bound(asked);
  }
  for (const auto& [col, row] : options_->tolerances.ignored)
    bounds_[static_cast<std::size_t>(row) * static_cast<std::size_t>(raster_.cols) + static_cast<std::size_t>(col)] =
        kUnbounded;
  for (std::size_t i = 0; i < samples; ++i) ignored_ += std::isinf(bounds_[i]) && !std::isnan(raster_.samples[i]);
  return {};
}

void Criterion::set_factors() {
  const bool has_feature = has_raster_feature(options_->strategy.importance);
  if (has_feature) factors_ = measure_feature(raster_, options_->strategy.importance);
  const bool has_tolerance = !options_->tolerances.values.empty();
  if (options_->tolerances.weights.empty() && !(has_tolerance && has_feature)) return;
  factors_.resize(bounds_.size(), 1);
  for (std::size_t i = 0; i < factors_.size(); ++i)
    factors_[i] =
        std::min(factors_[i] * (has_tolerance ? per_bound(bounds_[i]) : options_->tolerances.weights[i]), kMostFactor);
}

std::vector<Point> Criterion::ranking() const {
  if (!options_->strategy.importance.one_pass) return {};
  std::vector<Point> points = rank_samples(raster_, factors_);
  std::erase_if(points, [this](Point p) {
    const auto row = static_cast<std::size_t>(p.y) * static_cast<std::size_t>(raster_.cols);
    return !bounds_.empty() && std::isinf(bounds_[row + static_cast<std::size_t>(p.x)]);
  });
  return points;
}

}  // namespace scarp::metric
