#include "metric/sample_metric.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "geom/exact_error.h"
#include "geom/scan.h"
#include "metric/between.h"
#include "metric/fine_lattice.h"
#include "metric/importance.h"
#include "scarp/height_field.h"

namespace scarp::metric {

namespace {

/// Number of a row's samples that are scanned together.
constexpr std::int32_t kChunkSamples = 64;

/// If the importance is 0, the error times this replaces it, far below any other importance.
constexpr double kUnimportant = 1e-280;

/// Combining kMaxChannels + 1 errors causes about as many roundings, plus a few, each by at most 2^-53.
constexpr double kNormRounding = 0x1p-46;

/// Adds one error to a norm; `total` holds Σ, Σ² or max.
void add_to_norm(Norm norm, double error, double& total) {
  if (norm == Norm::kSum) {
    total += error;
  } else if (norm == Norm::kSquares) {
    total += error * error;
  } else {
    total = std::max(total, error);
  }
}

double distance_from_corner(const std::array<Point, 3>& corners, Point p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Point& corner : corners) {
    const double dx = double{1} * p.x - corner.x, dy = double{1} * p.y - corner.y;
    nearest = std::min(nearest, dx * dx + dy * dy);
  }
  return std::sqrt(nearest);
}

}  // namespace

/// A plane for each field. The usual few fields need no allocation and no clearing of many planes.
struct SampleMetric::Surface {
  static constexpr std::size_t kFew = 4;
  std::array<geom::Plane, kFew> few;
  std::vector<geom::Plane> more;
  double guard = 0;

  void add(std::size_t k, const geom::Plane& plane) {
    if (k < kFew) {
      few[k] = plane;
    } else {
      more.push_back(plane);
    }
  }
  const geom::Plane& plane(std::size_t k) const { return k < kFew ? few[k] : more[k - kFew]; }
};

MetricSettings settings_by_bounds(const grid::Raster& raster, std::span<const float> bounds) {
  MetricSettings settings{raster, {{raster.samples, 1}}};
  settings.bounds = bounds.data();
  settings.per_bound = true;
  settings.goal = 1;
  return settings;
}

SampleMetric::SampleMetric(MetricSettings settings) : settings_(std::move(settings)) {}

std::array<float, 3> SampleMetric::values_at(const MetricField& field, const std::array<Point, 3>& corners) const {
  return {field.samples[index_of(corners[0])], field.samples[index_of(corners[1])],
          field.samples[index_of(corners[2])]};
}

SampleMetric::Surface SampleMetric::surface(const std::array<Point, 3>& corners) const {
  Surface surface;
  for (std::size_t k = 0; k < settings_.fields.size(); ++k) {
    surface.add(k, geom::Plane::through(corners, values_at(settings_.fields[k], corners)));
    surface.guard += settings_.fields[k].scale * surface.plane(k).guard;
  }
  return surface;
}

void SampleMetric::combine_row(const Surface& surface, Point start, std::span<double> errors) const {
  const std::size_t index = index_of(start);
  std::fill(errors.begin(), errors.end(), 0.0);
  for (std::size_t k = 0; k < settings_.fields.size(); ++k) {
    const geom::Plane& plane = surface.plane(k);
    const double row_height = plane.row_height(start.y), scale = settings_.fields[k].scale;
    const float* samples = settings_.fields[k].samples + index;
    const auto each = [&](auto&& add) {
      for (std::size_t i = 0; i < errors.size(); ++i) {
        const double along = static_cast<double>(start.x - plane.base.x + static_cast<std::int32_t>(i));
        add(errors[i], scale * std::abs(row_height + plane.slope_x * along - double{samples[i]}));
      }
    };
    if (settings_.norm == Norm::kSum || settings_.fields.size() == 1) {
      each([](double& total, double error) { total += error; });
    } else if (settings_.norm == Norm::kSquares) {
      each([](double& total, double error) { total += error * error; });
    } else {
      each([](double& total, double error) { total = std::max(total, error); });
    }
  }
  if (settings_.norm == Norm::kSquares && settings_.fields.size() > 1) {
    for (double& error : errors) error = std::sqrt(error);
  }
}

double SampleMetric::combine(const Surface& surface, Point p) const {
  double error = 0;
  combine_row(surface, p, {&error, 1});
  return error;
}

double SampleMetric::weighted(double error, std::size_t index) const {
  if (settings_.per_bound) return error * double{per_bound(settings_.bounds[index])};
  return settings_.factors != nullptr && settings_.by_error ? error * double{settings_.factors[index]} : error;
}

double SampleMetric::importance(double error, std::size_t index, const std::array<Point, 3>& corners, Point p) const {
  double value = weighted(error, index);
  if (!settings_.by_error) value = settings_.factors != nullptr ? double{settings_.factors[index]} : 1;
  if (settings_.distance) value *= damped(distance_from_corner(corners, p), *settings_.distance);
  return value > 0 ? value : error * kUnimportant;
}

Fit SampleMetric::fit(const std::array<Point, 3>& corners, const FitQuestion& question) const {
  const Surface surface = this->surface(corners);
  Fit fit;
  fit.guard = surface.guard;
  double doubtful = -1;
  std::array<double, kChunkSamples> errors;
  geom::scan_rows(corners, [&](std::int32_t y, std::int32_t first, std::int32_t last) {
    if (!fit.complete) return;
    fit.scanned += static_cast<std::uint64_t>(last - first + 1);
    for (std::int32_t begin = first; begin <= last; begin += kChunkSamples) {
      const auto count = static_cast<std::size_t>(std::min(kChunkSamples, last - begin + 1));
      combine_row(surface, {begin, y}, {errors.data(), count});
      const std::size_t index = index_of({begin, y});
      for (std::size_t i = 0; i < count; ++i) {
        const double error = errors[i];
        if (std::isnan(settings_.heights.samples[index + i])) continue;
        const double score = weighted(error, index + i);
        fit.max_error = std::max(fit.max_error, score);
        fit.sum_squares += score * score;
        const Point p{begin + static_cast<std::int32_t>(i), y};
        const double value = importance(error, index + i, corners, p);
        if (value <= fit.worst.error) continue;  // not a candidate, for any bound
        const double bound = bound_at(index + i), margin = surface.guard + kNormRounding * error;
        if (error < bound - margin) continue;
        if (error > bound + margin) {
          fit.worst = {value, p};
        } else {
          doubtful = std::max(doubtful, value);
        }
      }
    }
    fit.complete = !question.is_given_up(fit.max_error, fit.sum_squares);
  });
  fit.unsettled = doubtful >= 0 && doubtful >= fit.worst.error;
  if (question.lattice > 1 && fit.complete) refine_scores(surface, corners, question, fit);
  return fit;
}

void SampleMetric::refine_scores(const Surface& surface, const std::array<Point, 3>& corners,
                                 const FitQuestion& question, Fit& fit) const {
  const auto error_at = [&](std::int32_t x, std::int32_t y, double fx, double fy) {
    double total = 0;
    for (std::size_t k = 0; k < settings_.fields.size(); ++k) {
      const geom::Plane& plane = surface.plane(k);
      const double height = plane.height + plane.slope_y * (fy - plane.base.y) + plane.slope_x * (fx - plane.base.x);
      const double sample = interpolate(settings_.fields[k].samples, settings_.heights.cols, x, y, question.lattice);
      add_to_norm(settings_.norm, settings_.fields[k].scale * std::abs(height - sample), total);
    }
    return settings_.norm == Norm::kSquares ? std::sqrt(total) : total;
  };
  double most = 0, squares = 0;
  scan_fine(corners, question.lattice, [&](std::int32_t x, std::int32_t y, double fx, double fy) {
    const std::size_t nearest = index_of({static_cast<std::int32_t>(fx + 0.5), static_cast<std::int32_t>(fy + 0.5)});
    const double error = weighted(error_at(x, y, fx, fy), nearest);
    ++fit.scanned;
    if (!std::isnan(error)) {
      most = std::max(most, error);
      squares += error * error;
    }
  });
  fit.max_error = most;
  fit.sum_squares = squares / (double{1} * question.lattice * question.lattice);
}

bool SampleMetric::exceeds(const std::array<Point, 3>& corners, Point p, std::size_t index) const {
  const double bound = bound_at(index);
  const auto field_exceeds = [&](const MetricField& field) {
    return geom::exceeds_exactly(corners, values_at(field, corners), p, field.samples[index], bound);
  };
  if (std::find(corners.begin(), corners.end(), p) != corners.end()) return false;
  if (bound == 0 || (settings_.fields.size() == 1 && settings_.fields[0].scale == 1))
    return std::any_of(settings_.fields.begin(), settings_.fields.end(), field_exceeds);
  return true;
}

std::optional<Candidate> SampleMetric::find_candidate(const std::array<Point, 3>& corners, const Fit& fit) const {
  std::optional<Candidate> worst;
  if (fit.worst.error >= 0) worst = fit.worst;
  if (!fit.unsettled) return worst;
  const Surface surface = this->surface(corners);
  geom::scan_rows(corners, [&](std::int32_t y, std::int32_t first, std::int32_t last) {
    for (std::int32_t x = first; x <= last; ++x) {
      const Point p{x, y};
      const std::size_t index = index_of(p);
      if (std::isnan(settings_.heights.samples[index])) continue;
      const double error = combine(surface, p), bound = bound_at(index);
      const double margin = surface.guard + kNormRounding * error;
      if (!(std::abs(error - bound) <= margin)) continue;
      const Candidate candidate{importance(error, index, corners, p), p};
      if ((!worst || is_worse(candidate, *worst)) && exceeds(corners, p, index)) worst = candidate;
    }
  });
  return worst;
}

double SampleMetric::squares_between(Point a, Point b) const {
  double squares = 0;
  visit_between(a, b, [&](Point p, double share) {
    const std::size_t index = index_of(p);
    if (std::isnan(settings_.heights.samples[index])) return;
    double total = 0;
    for (const MetricField& field : settings_.fields) {
      const double from = field.samples[index_of(a)], rise = double{field.samples[index_of(b)]} - from;
      add_to_norm(settings_.norm, field.scale * std::abs(from + share * rise - double{field.samples[index]}), total);
    }
    const double error = weighted(settings_.norm == Norm::kSquares ? std::sqrt(total) : total, index);
    squares += error * error;
  });
  return squares;
}

double SampleMetric::bend(const std::array<Point, 3>& a, const std::array<Point, 3>& b) const {
  double sum = 0;
  for (const MetricField& field : settings_.fields)
    sum += field.scale *
           geom::bend_of(geom::Plane::through(a, values_at(field, a)), geom::Plane::through(b, values_at(field, b)));
  return sum;
}

}  // namespace scarp::metric
