#include "metric/importance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "metric/criterion.h"

namespace scarp::metric {

namespace {

class Neighbourhood {
 public:
  explicit Neighbourhood(const grid::Raster& raster) : raster_(raster) {}

  bool has(std::int32_t x, std::int32_t y) const {
    return x >= 0 && y >= 0 && x < raster_.cols && y < raster_.rows && raster_.is_valid({x, y});
  }
  double at(std::int32_t x, std::int32_t y) const { return raster_.at({x, y}); }

  /// Sum of the two neighbours at ±d minus twice the sample; 0 and false if one is missing.
  bool second_difference(Point p, Point d, double& value) const {
    if (!has(p.x - d.x, p.y - d.y) || !has(p.x + d.x, p.y + d.y)) return false;
    value = at(p.x - d.x, p.y - d.y) + at(p.x + d.x, p.y + d.y) - 2 * at(p.x, p.y);
    return true;
  }

 private:
  const grid::Raster& raster_;
};

constexpr Point kDirections[] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}};

double local_error(const Neighbourhood& near, Point p, int pairs) {
  double sum = 0, difference = 0;
  int count = 0;
  for (Point d : std::span(kDirections).first(static_cast<std::size_t>(pairs))) {
    if (!near.second_difference(p, d, difference)) continue;
    sum += difference;
    ++count;
  }
  return count == 0 ? 0 : std::abs(sum) / (2 * count);
}

double curvature(const Neighbourhood& near, Point p) {
  double xx = 0, yy = 0, xy = 0;
  near.second_difference(p, {1, 0}, xx);
  near.second_difference(p, {0, 1}, yy);
  const auto [x, y] = p;
  if (near.has(x - 1, y - 1) && near.has(x + 1, y - 1) && near.has(x - 1, y + 1) && near.has(x + 1, y + 1))
    xy = (near.at(x + 1, y + 1) - near.at(x - 1, y + 1) - near.at(x + 1, y - 1) + near.at(x - 1, y - 1)) / 4;
  return std::sqrt(xx * xx + 2 * xy * xy + yy * yy);
}

}  // namespace

bool has_raster_feature(const Importance& importance) {
  return importance.feature != Importance::Feature::kNoFeature && importance.feature != Importance::Feature::kDistance;
}

double damped(double feature, Importance::Damping damping) {
  if (damping == Importance::Damping::kUndamped) return feature;
  return damping == Importance::Damping::kPlusOne ? feature + 1 : std::sqrt(feature + 1);
}

std::vector<float> measure_feature(const grid::Raster& raster, const Importance& importance) {
  const Neighbourhood near(raster);
  std::vector<float> values;
  values.reserve(static_cast<std::size_t>(raster.cols) * static_cast<std::size_t>(raster.rows));
  for (std::int32_t y = 0; y < raster.rows; ++y) {
    for (std::int32_t x = 0; x < raster.cols; ++x) {
      const Point p{x, y};
      double value = 0;
      if (raster.is_valid(p)) {
        const double feature = importance.feature == Importance::Feature::kCurvature
                                   ? curvature(near, p)
                                   : local_error(near, p, importance.feature == Importance::Feature::kLocal8 ? 4 : 2);
        value = damped(feature, importance.damping);
      }
      values.push_back(static_cast<float>(std::min(value, double{std::numeric_limits<float>::max()})));
    }
  }
  return values;
}

std::vector<Point> rank_samples(const grid::Raster& raster, const std::vector<float>& values) {
  std::vector<Point> points;
  for (std::int32_t y = 0; y < raster.rows; ++y) {
    for (std::int32_t x = 0; x < raster.cols; ++x) {
      if (raster.is_valid({x, y})) points.push_back({x, y});
    }
  }
  const auto value_at = [&](Point p) {
    return values[static_cast<std::size_t>(p.y) * static_cast<std::size_t>(raster.cols) +
                  static_cast<std::size_t>(p.x)];
  };
  std::stable_sort(points.begin(), points.end(), [&](Point a, Point b) { return value_at(a) > value_at(b); });
  return points;
}

Result<void> Criterion::check_strategy() const {
  const Importance& importance = options_->strategy.importance;
  const bool has_feature = importance.feature != Importance::Feature::kNoFeature;
  if (!importance.global && !has_feature)
    return fail(ErrorKind::kUsage, "an importance needs the global error or a feature");
  if (importance.one_pass && (importance.global || !has_raster_feature(importance)))
    return fail(ErrorKind::kUsage, "one pass ranks samples by a feature alone: local error or curvature");
  const Batch& batch = options_->strategy.batch;
  if (importance.one_pass && batch.rule != Batch::Rule::kSequential)
    return fail(ErrorKind::kUsage,
                "one pass ranks all samples once and never looks at the mesh: leave the batches out");
  if (batch.rule == Batch::Rule::kFraction && !(batch.fraction > 0 && batch.fraction <= 1))
    return fail(ErrorKind::kUsage,
                fmt::format("a batch takes a fraction above 0 and at most 1, not {}", batch.fraction));
  if (!(options_->strategy.edges.shape_threshold <= 1))
    return fail(ErrorKind::kUsage,
                fmt::format("the shape threshold must lie in 0 … 1, not {}", options_->strategy.edges.shape_threshold));
  if (!(options_->strategy.edges.supersample >= 0))
    return fail(ErrorKind::kUsage, fmt::format("supersampling needs a number of at least 0, not {}",
                                               options_->strategy.edges.supersample));
  return {};
}

}  // namespace scarp::metric
