#include "metric/source_metric.h"

#include <algorithm>
#include <initializer_list>
#include <memory>
#include <vector>

#include "grid/source_failure.h"
#include "grid/window.h"
#include "metric/height_metric.h"
#include "metric/sample_metric.h"

namespace scarp::metric {

namespace {

void or_throw(const Result<void>& read) {
  if (!read) throw grid::SourceFailure{read.error()};
}

/// The samples around some points, the samples' bounds, and the points relative to the window.
class Window {
 public:
  Window(const HeightField& field, double threshold, const SourceBounds* bounds, std::initializer_list<Point> points)
      : first_(*points.begin()) {
    Point last = first_;
    for (const Point p : points) {
      first_ = {std::min(first_.x, p.x), std::min(first_.y, p.y)};
      last = {std::max(last.x, p.x), std::max(last.y, p.y)};
    }
    const std::int32_t cols = last.x - first_.x + 1, rows = last.y - first_.y + 1;
    samples_.resize(static_cast<std::size_t>(cols) * static_cast<std::size_t>(rows));
    or_throw(grid::read_window(field, first_.x, first_.y, cols, rows, samples_.data(), cols));
    const grid::Raster raster{samples_.data(), cols, rows};
    if (bounds == nullptr) {
      metric_ = std::make_unique<HeightMetric>(raster, threshold);
      return;
    }
    bounds_.resize(samples_.size());
    or_throw(bounds->read_aims(first_, cols, rows, bounds_.data(), cols));
    metric_ = std::make_unique<SampleMetric>(settings_by_bounds(raster, bounds_));
  }
  const ErrorMetric& metric() const { return *metric_; }
  Point inside(Point p) const { return {p.x - first_.x, p.y - first_.y}; }
  std::array<Point, 3> inside(const std::array<Point, 3>& p) const {
    return {inside(p[0]), inside(p[1]), inside(p[2])};
  }
  Candidate outside(Candidate candidate) const {
    candidate.at = {candidate.at.x + first_.x, candidate.at.y + first_.y};
    return candidate;
  }

 private:
  Point first_;
  std::vector<float> samples_, bounds_;
  std::unique_ptr<ErrorMetric> metric_;
};

}  // namespace

Fit SourceMetric::fit(const std::array<Point, 3>& corners, const FitQuestion& question) const {
  const Window window(field_, threshold_, bounds_, {corners[0], corners[1], corners[2]});
  Fit fit = window.metric().fit(window.inside(corners), question);
  fit.worst = window.outside(fit.worst);
  return fit;
}

std::optional<Candidate> SourceMetric::find_candidate(const std::array<Point, 3>& corners, const Fit& fit) const {
  const Window window(field_, threshold_, bounds_, {corners[0], corners[1], corners[2]});
  Fit inside = fit;
  inside.worst.at = window.inside(fit.worst.at);
  const auto found = window.metric().find_candidate(window.inside(corners), inside);
  return found ? std::optional(window.outside(*found)) : std::nullopt;
}

double SourceMetric::squares_between(Point a, Point b) const {
  const Window window(field_, threshold_, bounds_, {a, b});
  return window.metric().squares_between(window.inside(a), window.inside(b));
}

double SourceMetric::bend(const std::array<Point, 3>& a, const std::array<Point, 3>& b) const {
  const Window window(field_, threshold_, bounds_, {a[0], a[1], a[2], b[0], b[1], b[2]});
  return window.metric().bend(window.inside(a), window.inside(b));
}

}  // namespace scarp::metric
