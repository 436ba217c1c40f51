#include "metric/height_metric.h"

#include <algorithm>
#include <cmath>

#include "geom/exact_error.h"
#include "geom/plane.h"
#include "geom/scan.h"
#include "geom/scan_kernels.h"
#include "metric/between.h"
#include "metric/fine_lattice.h"

namespace scarp::metric {

namespace {

std::array<float, 3> heights_at(const grid::Raster& raster, const std::array<Point, 3>& corners) {
  return {raster.at(corners[0]), raster.at(corners[1]), raster.at(corners[2])};
}

/// The worst of a row's samples, if worse than `worst`. NaN samples lose every comparison.
void find_worst(const geom::ScanKernels& kernels, const geom::Plane& plane, const float* samples, std::int32_t y,
                std::int32_t first, std::int32_t last, Candidate& worst) {
  const double row_height = plane.row_height(y);
  if (last - first + 1 >= geom::kMinVectorRow) {
    std::int32_t at = 0;
    if (kernels.scan_row(samples + first, last - first + 1, row_height, plane.slope_x, first - plane.base.x,
                         worst.error, at))
      worst.at = {first + at, y};
    return;
  }
  for (std::int32_t x = first; x <= last; ++x) {
    const double error =
        std::abs(row_height + plane.slope_x * static_cast<double>(x - plane.base.x) - double{samples[x]});
    if (error > worst.error) worst = {error, {x, y}};
  }
}

/// Adds the worst error and the squared errors of a row's samples.
void add_row(const geom::Plane& plane, const float* samples, std::int32_t y, std::int32_t first, std::int32_t last,
             Candidate& worst, double& squares) {
  const double row_height = plane.row_height(y);
  for (std::int32_t x = first; x <= last; ++x) {
    const double error =
        std::abs(row_height + plane.slope_x * static_cast<double>(x - plane.base.x) - double{samples[x]});
    if (error > worst.error) worst = {error, {x, y}};
    if (!std::isnan(error)) squares += error * error;
  }
}

/// Fits with the plane's own arithmetic.
template <bool kSquares>
Fit scan(const grid::Raster& raster, const std::array<Point, 3>& corners, const FitQuestion& question) {
  const geom::Plane plane = geom::Plane::through(corners, heights_at(raster, corners));
  [[maybe_unused]] const geom::ScanKernels& kernels = geom::scan_kernels();
  Candidate worst{-1, {}};
  Fit fit;
  double squares = 0;
  geom::scan_rows(corners, [&](std::int32_t y, std::int32_t first, std::int32_t last) {
    if (!fit.complete) return;
    fit.scanned += static_cast<std::uint64_t>(last - first + 1);
    if constexpr (kSquares) {
      add_row(plane, raster.row(y), y, first, last, worst, squares);
    } else {
      find_worst(kernels, plane, raster.row(y), y, first, last, worst);
    }
    fit.complete = !question.is_given_up(worst.error, squares);
  });
  fit.worst = worst;
  fit.guard = plane.guard;
  fit.max_error = std::max(worst.error, 0.0);
  fit.sum_squares = squares;
  return fit;
}

/// Computes the scores again, on a finer lattice.
void refine_scores(const grid::Raster& raster, const std::array<Point, 3>& corners, const FitQuestion& question,
                   Fit& fit) {
  const geom::Plane plane = geom::Plane::through(corners, heights_at(raster, corners));
  double most = 0, squares = 0;
  scan_fine(corners, question.lattice, [&](std::int32_t x, std::int32_t y, double fx, double fy) {
    const double surface = plane.height + plane.slope_y * (fy - plane.base.y) + plane.slope_x * (fx - plane.base.x);
    const double error = std::abs(surface - interpolate(raster.samples, raster.cols, x, y, question.lattice));
    ++fit.scanned;
    if (!std::isnan(error)) {
      most = std::max(most, error);
      squares += error * error;
    }
  });
  fit.max_error = most;
  fit.sum_squares = squares / (double{1} * question.lattice * question.lattice);
}

/// The worst sample that exceeds the threshold in exact arithmetic.
std::optional<Candidate> scan_exactly(const grid::Raster& raster, const std::array<Point, 3>& corners,
                                      const geom::Plane& plane, double threshold) {
  const auto heights = heights_at(raster, corners);
  std::optional<Candidate> worst;
  geom::scan_rows(corners, [&](std::int32_t y, std::int32_t first, std::int32_t last) {
    for (std::int32_t x = first; x <= last; ++x) {
      const Point p{x, y};
      const float sample = raster.at(p);
      const double error = std::abs(plane.height_at(p) - double{sample});
      if (!(error >= threshold - plane.guard) || (worst && error <= worst->error)) continue;
      if (geom::exceeds_exactly(corners, heights, p, sample, threshold)) worst = Candidate{error, p};
    }
  });
  return worst;
}

}  // namespace

Fit HeightMetric::fit(const std::array<Point, 3>& corners, const FitQuestion& question) const {
  Fit fit = question.squares ? scan<true>(raster_, corners, question) : scan<false>(raster_, corners, question);
  if (question.lattice > 1 && fit.complete) refine_scores(raster_, corners, question, fit);
  return fit;
}

std::optional<Candidate> HeightMetric::find_candidate(const std::array<Point, 3>& corners, const Fit& fit) const {
  const Candidate& worst = fit.worst;
  if (worst.error > threshold_ + fit.guard) return worst;
  if (worst.error < threshold_ - fit.guard) return std::nullopt;
  // A level plane has no guard: only one subtraction rounds, and monotonically, so only equality is uncertain.
  if (fit.guard == 0 && (threshold_ == 0 || worst.error != threshold_)) return std::nullopt;
  return scan_exactly(raster_, corners, geom::Plane::through(corners, heights_at(raster_, corners)), threshold_);
}

double HeightMetric::squares_between(Point a, Point b) const {
  double squares = 0;
  const double from = raster_.at(a), rise = double{raster_.at(b)} - from;
  visit_between(a, b, [&](Point p, double share) {
    const double error = from + share * rise - double{raster_.at(p)};
    if (!std::isnan(error)) squares += error * error;
  });
  return squares;
}

double HeightMetric::bend(const std::array<Point, 3>& a, const std::array<Point, 3>& b) const {
  return geom::bend_of(geom::Plane::through(a, heights_at(raster_, a)),
                       geom::Plane::through(b, heights_at(raster_, b)));
}

}  // namespace scarp::metric
