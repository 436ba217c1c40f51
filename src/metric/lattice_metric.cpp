#include "metric/lattice_metric.h"

#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "geom/exact_error.h"
#include "geom/sample_scan.h"
#include "geom/scan_kernels.h"
#include "metric/between.h"

namespace scarp::metric {

namespace {

Point lattice_point(std::int32_t x, std::int32_t y) { return {x * grid::kLatticeSteps, y * grid::kLatticeSteps}; }

}  // namespace

void LatticeHeights::set(Point point, float height) {
  Slot& slot = slots_[find(key(point))];
  if (slot.key == 0) ++taken_;
  slot = {key(point), height};
  has_samples_ = has_samples_ || is_sample(point);
  reserve(taken_);
}

void LatticeHeights::reserve(std::size_t count) {
  if (2 * count <= slots_.size()) return;
  const std::vector<Slot> old = std::exchange(slots_, std::vector<Slot>(std::bit_ceil(2 * count)));
  for (const Slot& moved : old) {
    if (moved.key != 0) slots_[find(moved.key)] = moved;
  }
}

std::array<float, 3> LatticeMetric::heights_at(const std::array<Point, 3>& corners) const {
  return {heights_.at(corners[0]), heights_.at(corners[1]), heights_.at(corners[2])};
}

double LatticeMetric::importance(double error, double bound) const {
  if (!bounds_) return error;
  return error == 0 ? 0 : error / bound;
}

Fit LatticeMetric::fit(const std::array<Point, 3>& corners, const FitQuestion&) const {
  return bounds_ ? fit_by_bounds(corners) : fit_evenly(corners);
}

/// The largest error, if it may exceed the threshold.
Fit LatticeMetric::fit_evenly(const std::array<Point, 3>& corners) const {
  const geom::Plane plane = plane_of(corners);
  const double least = threshold_ - plane.guard;
  double worst = std::nextafter(least, -1.0);  // an error equal to `least` is also uncertain
  Point at;
  const geom::ScanKernels& kernels = geom::scan_kernels();
  // kLatticeSteps is a power of two, so each product rounds like slope_x times steps.
  const double slope = plane.slope_x * grid::kLatticeSteps, base = plane.base.x / double{grid::kLatticeSteps};
  Fit fit;
  fit.guard = plane.guard;
  geom::scan_samples(corners, grid::kLatticeSteps, [&](std::int32_t y, std::int32_t first, std::int32_t last) {
    fit.scanned += static_cast<std::uint64_t>(last - first + 1);
    const float* const samples = samples_.samples(first, y, last - first + 1);
    const double row_height = plane.row_height(y * grid::kLatticeSteps);
    if (last - first + 1 >= geom::kMinVectorRow) {
      std::int32_t found = 0;
      if (kernels.scan_row(samples, last - first + 1, row_height, slope, first - base, worst, found))
        at = lattice_point(first + found, y);
      return;
    }
    for (std::int32_t x = first; x <= last; ++x) {
      const double error = std::abs(row_height + slope * (x - base) - double{samples[x - first]});
      if (!(error > worst)) continue;  // nodata, or not the worst
      worst = error;
      at = lattice_point(x, y);
    }
  });
  if (!(worst >= least && worst >= 0)) return fit;
  fit.unsettled = true;
  fit.max_error = worst;
  fit.worst = {worst, at};
  return fit;
}

Fit LatticeMetric::fit_by_bounds(const std::array<Point, 3>& corners) const {
  const geom::Plane plane = plane_of(corners);
  Fit fit;
  fit.guard = plane.guard;
  geom::scan_samples(corners, grid::kLatticeSteps, [&](std::int32_t y, std::int32_t first, std::int32_t last) {
    fit.scanned += static_cast<std::uint64_t>(last - first + 1);
    const float* const samples = samples_.samples(first, y, last - first + 1);
    const float* const bounds = bounds_->samples(first, y, last - first + 1);
    const double row_height = plane.row_height(y * grid::kLatticeSteps);
    for (std::int32_t x = first; x <= last; ++x) {
      const double offset = static_cast<double>(x * grid::kLatticeSteps - plane.base.x);
      const double error = std::abs(row_height + plane.slope_x * offset - double{samples[x - first]});
      const double bound = bounds[x - first];
      if (!(error >= bound - plane.guard)) continue;  // nodata, or certainly within its bound
      fit.max_error = std::max(fit.max_error, error);
      fit.unsettled = true;
      const double share = importance(error, bound);
      if (share > fit.worst.error) fit.worst = {share, lattice_point(x, y)};
    }
  });
  return fit;
}

std::optional<Candidate> LatticeMetric::find_candidate(const std::array<Point, 3>& corners, const Fit& fit) const {
  if (!fit.unsettled) return std::nullopt;
  if (!bounds_ && fit.worst.error > threshold_ + fit.guard) return fit.worst;
  const geom::Plane plane = plane_of(corners);
  const auto heights = heights_at(corners);
  std::optional<Candidate> worst;
  geom::scan_samples(corners, grid::kLatticeSteps, [&](std::int32_t y, std::int32_t first, std::int32_t last) {
    const float* const samples = samples_.samples(first, y, last - first + 1);
    const float* const bounds = bounds_ ? bounds_->samples(first, y, last - first + 1) : nullptr;
    for (std::int32_t x = first; x <= last; ++x) {
      const float sample = samples[x - first];
      const Point point = lattice_point(x, y);
      const double error = std::abs(plane.height_at(point) - double{sample});
      const double bound = bounds != nullptr ? double{bounds[x - first]} : threshold_;
      if (!(error >= bound - plane.guard) || std::isinf(bound)) continue;
      const double share = importance(error, bound);
      if (worst && share <= worst->error) continue;
      if (geom::exceeds_exactly(corners, heights, point, sample, bound)) worst = Candidate{share, point};
    }
  });
  return worst;
}

double LatticeMetric::squares_between(Point a, Point b) const {
  double squares = 0;
  const double from = heights_.at(a), rise = double{heights_.at(b)} - from;
  visit_between(a, b, [&](Point p, double share) {
    if (!LatticeHeights::is_sample(p)) return;
    const double error = from + share * rise - double{heights_.at(p)};
    if (!std::isnan(error)) squares += error * error;
  });
  return squares;
}

double LatticeMetric::bend(const std::array<Point, 3>& a, const std::array<Point, 3>& b) const {
  return geom::bend_of(plane_of(a), plane_of(b));
}

}  // namespace scarp::metric
