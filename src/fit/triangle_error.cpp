#include "fit/triangle_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fit/norm_error.h"
#include "fit/scattered_samples.h"
#include "fit/triangle_kernels.h"
#include "fit/triangle_scan.h"
#include "fit/triangle_sums.h"
#include "geom/exact_error.h"

namespace scarp::fit {

TriangleError::TriangleError(const grid::Raster& raster, Point first, double threshold, const ErrorRule& rule)
    : raster_(raster),
      first_(first),
      threshold_(threshold),
      limit_(rule.slack * threshold),
      unit_(threshold),
      power_(rule.power),
      per_threshold_(threshold > 0x1p-60 && threshold < 0x1p60 ? static_cast<float>(1 / threshold) : 0),
      per_square_(per_threshold_ > 0 ? static_cast<float>(1 / (threshold * threshold)) : 0),
      end_(raster.row(raster.rows)),
      kernels_(&triangle_kernels()) {}

TriangleError::TriangleError(const grid::Raster& raster, Point first, const SampleBounds& bounds, const ErrorRule& rule)
    : TriangleError(raster, first, 1, rule) {
  bounds_ = {bounds.bounds, raster.cols, raster.rows};
  unit_ = bounds.unit;
}

TriangleError::TriangleError(const NormError& norm, const ErrorRule& rule)
    : TriangleError(norm.heights(), norm.first(), 1, rule) {
  unit_ = norm.unit();
  if (!norm.has_energy()) per_threshold_ = per_square_ = 0;
  norm_ = &norm;
}

TriangleError::TriangleError(const ScatteredErrors& points, const ErrorRule& rule)
    : TriangleError(grid::Raster{}, {}, points.threshold(), rule) {
  points_ = &points;
}

TriangleError TriangleError::with(const ErrorRule& rule) const {
  if (points_ != nullptr) return TriangleError(*points_, rule);
  if (norm_ != nullptr) return TriangleError(*norm_, rule);
  if (has_bounds()) return {raster_, first_, SampleBounds{bounds_.samples, unit_}, rule};
  return {raster_, first_, threshold_, rule};
}

SampleRows TriangleError::rows() const { return {raster_.row(first_.y) + first_.x, raster_.cols, end_}; }

/// Comparison of a triangle's samples with one threshold.
struct TriangleError::ByThreshold {
  const TriangleError& of;
  TriangleTask task;

  ByThreshold(const TriangleError& error, const FitCorner& a, const FitCorner& b, const FitCorner& c)
      : of(error), task(a, b, c, error.threshold_, error.limit_) {}

  bool breaks(float worst) const { return worst > task.certain; }
  bool is_in_doubt(float worst) const { return worst > task.doubt || double{task.plane.guard} > of.threshold_; }
  bool is_in_doubt(float error, Point) const { return error > task.doubt || double{task.plane.guard} > of.threshold_; }
  float excess(float error, Point) const { return error; }
};

/// The same with bounds of samples. Among the roundings in a guard (scan_plane.h), only 2u·error and those of the bound
/// grow with the bound; u = 2⁻²⁴. So the guard for a threshold of 0 suffices if bounds are widened or narrowed by 16u.
template <class Sums>
struct TriangleError::ByBounds {
  static constexpr float kWider = 1 + 0x1p-20f, kNarrower = 1 - 0x1p-20f;

  const TriangleError& of;
  TriangleTask task;
  Sums sums;  // sums of errors in bounds
  float limit;
  const float* end;
  // Excess of errors over bounds, lane by lane; without doubt beyond the guard, in either direction.
  Floats over_limit, over, nearly_over;

  ByBounds(const TriangleError& error, const FitCorner& a, const FitCorner& b, const FitCorner& c)
      : of(error),
        task(a, b, c, 0, 0),
        limit(static_cast<float>(error.limit_) * kWider),
        end(error.bounds_.row(error.bounds_.rows)) {
    over_limit = over = nearly_over = all(std::numeric_limits<float>::lowest());
  }

  void add_row(TriangleScan& scan, std::int32_t y, std::int32_t first, std::int32_t last) {
    const float* const bounds = of.bounds_.row(of.first_.y + y) + of.first_.x;
    const Floats least = all(least_bound(task));
    scan.each_eight(of.raster_.row(of.first_.y + y) + of.first_.x, y, first, last,
                    [&](std::int32_t x, Floats, Floats low, Masks low_meant, Floats high, Masks high_meant) {
                      const EightBounds by(bounds + x, end, low_meant & (low == low), high_meant & (high == high));
                      const Floats low_error = magnitudes(low, low_meant), high_error = magnitudes(high, high_meant);
                      compare(low_error, by.low);
                      compare(high_error, by.high);
                      sums.add(per_bound(low_error, by.low, least), per_bound(high_error, by.high, least), 1);
                    });
  }
  void compare(Floats error, Floats bound) {
    over_limit = larger_of(error - bound * all(limit), over_limit);
    over = larger_of(error - bound * all(kWider), over);
    nearly_over = larger_of(error - bound * all(kNarrower), nearly_over);
  }
  float energy() const { return sums.energy(1); }
  bool breaks_limit() const { return any(over_limit > all(task.plane.guard)); }
  bool breaks(float) const { return any(over > all(task.plane.guard)); }
  bool is_in_doubt(float) const { return any(nearly_over > all(-task.plane.guard)); }
  bool is_in_doubt(float error, Point at) const { return error - of.bound_at(at) * kNarrower > -task.plane.guard; }
  float excess(float error, Point at) const { return error - of.bound_at(at) * limit; }
};

namespace {

struct ExactTriangle {
  std::array<Point, 3> corners;
  std::array<float, 3> heights;

  explicit ExactTriangle(const std::array<FitCorner, 3>& of) {
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = {of[k].x, of[k].y};
      heights[k] = of[k].z;
    }
  }
};

/// By Pick's theorem, true for the smallest triangles with corners on samples.
bool holds_corners_only(const FitCorner& a, const FitCorner& b, const FitCorner& c) {
  if (((a.x | a.y | b.x | b.y | c.x | c.y) & (grid::kLatticeSteps - 1)) != 0) return false;
  return orient({a.x, a.y}, {b.x, b.y}, {c.x, c.y}) == grid::kLatticeSteps * grid::kLatticeSteps;
}

}  // namespace

TriangleError::Verdict TriangleError::assess(const FitCorner& a, const FitCorner& b, const FitCorner& c,
                                             float energy_limit) const {
  if (norm_ != nullptr) return norm_->assess({a, b, c}, energy_limit, {limit_, power_});
  if (points_ != nullptr) return points_->assess({a, b, c}, energy_limit, limit_, power_);
  if (holds_corners_only(a, b, c)) return assess_corners({a, b, c}, energy_limit);
  if (!has_bounds()) return assess_by_threshold(a, b, c, energy_limit);
  return power_ == ErrorRule::Power::kTwo ? assess_by_bounds<ByBounds<Squares>>(a, b, c, energy_limit)
                                          : assess_by_bounds<ByBounds<EighthPowers>>(a, b, c, energy_limit);
}

std::size_t TriangleError::field_count() const { return norm_ != nullptr ? norm_->field_count() : 1; }

Norm TriangleError::norm() const { return norm_ != nullptr ? norm_->norm() : Norm::kMax; }

double TriangleError::norm_value_at(std::size_t field, Point sample) const { return norm_->value_at(field, sample); }

double TriangleError::norm_bound_at(Point sample) const { return norm_->bound_at(sample); }

FitCorner TriangleError::point_at(Point sample) const { return points_->at(sample); }

Point TriangleError::point_near(const FitCorner& place) const { return points_->nearest(place); }

std::array<double, 2> TriangleError::point_slope(const FitCorner& place) const {
  const auto [x, y] = points_->slope_at(place);
  return {x / unit_, y / unit_};
}

TriangleError::Verdict TriangleError::assess_by_threshold(const FitCorner& a, const FitCorner& b, const FitCorner& c,
                                                          float energy_limit) const {
  const ByThreshold tally(*this, a, b, c);
  const auto power = static_cast<std::size_t>(power_);
  const TriangleSums sums = kernels_->assess[power](tally.task, rows(), {tally.task.cut, energy_limit, per_square_});
  Verdict verdict{sums.kind, sums.worst, sums.energy, {}};
  if (verdict.kind == Verdict::Kind::kBreaks) {
    verdict.witness = find_worst(tally, sums.y, sums.first, sums.last);
  } else if (verdict.kind == Verdict::Kind::kKeeps && !decide(tally, verdict) && limit_ == threshold_) {
    verdict.kind = Verdict::Kind::kBreaks;
  }
  return verdict;
}

template <class Tally>
TriangleError::Verdict TriangleError::assess_by_bounds(const FitCorner& a, const FitCorner& b, const FitCorner& c,
                                                       float energy_limit) const {
  Tally tally(*this, a, b, c);
  TriangleScan scan(tally.task, end_);
  Verdict verdict;
  const bool is_whole = each_row(tally.task, [&](std::int32_t y, std::int32_t first, std::int32_t last) {
    tally.add_row(scan, y, first, last);
    if (tally.breaks_limit()) {
      verdict.kind = Verdict::Kind::kBreaks;
      verdict.witness = find_worst(tally, y, first, last);
      return false;
    }
    if (scan.is_time_to_look() && tally.energy() >= energy_limit) {
      verdict.kind = Verdict::Kind::kCostly;
      return false;
    }
    return true;
  });
  if (!is_whole) return verdict;
  verdict.worst = tally.sums.largest();
  verdict.energy = tally.energy();
  if (verdict.energy >= energy_limit) {
    verdict.kind = Verdict::Kind::kCostly;
  } else if (!decide(tally, verdict) && limit_ == threshold_) {
    verdict.kind = Verdict::Kind::kBreaks;
  }
  return verdict;
}

/// True if the triangle is within the threshold. Adjusts `worst`.
template <class Tally>
bool TriangleError::decide(const Tally& tally, Verdict& verdict) const {
  const bool keeps = !tally.breaks(verdict.worst) && (!tally.is_in_doubt(verdict.worst) || settle(tally, verdict));
  verdict.worst = on_side_of(threshold_, keeps, verdict.worst);
  return keeps;
}

float on_side_of(double threshold, bool keeps, float error) {
  auto nearest = static_cast<float>(threshold);
  if (keeps) {
    if (double{nearest} > threshold) nearest = std::nextafter(nearest, 0.0f);
    return std::min(error, nearest);
  }
  if (double{nearest} <= threshold) nearest = std::nextafter(nearest, std::numeric_limits<float>::infinity());
  return std::max(error, nearest);
}

/// The error in bounds, if there are any, else the error.
float TriangleError::in_thresholds(float error, Point sample) const {
  if (!has_bounds()) return error;
  const float bound = bound_at(sample);
  return bound > kLeastBound ? error / bound : 0;
}

float TriangleError::energy_of(float error) const {
  const float square = error * error * per_square_;
  return power_ == ErrorRule::Power::kTwo ? square : square * square * (square * square);
}

/// REQUIRES: corners are samples, and no other sample lies in the triangle.
TriangleError::Verdict TriangleError::assess_corners(const std::array<FitCorner, 3>& corners,
                                                     float energy_limit) const {
  const ExactTriangle outline(corners);
  Verdict verdict;
  bool keeps = true;
  for (const FitCorner& corner : corners) {
    const Point at{corner.x / grid::kLatticeSteps, corner.y / grid::kLatticeSteps};
    const float sample = height_at(at), error = std::abs(corner.z - sample);
    if (corner.z == sample || std::isnan(error)) continue;
    const double threshold = threshold_at(at);
    if (!std::isinf(threshold) &&
        geom::exceeds_exactly(outline.corners, outline.heights, {corner.x, corner.y}, sample, threshold)) {
      keeps = false;
      if (limit_ == threshold_ || double{error} > limit_at(at)) {
        verdict.kind = Verdict::Kind::kBreaks;
        verdict.witness = at;
        return verdict;
      }
    }
    const float share = in_thresholds(error, at);
    verdict.worst = std::max(verdict.worst, share);
    verdict.energy += energy_of(share);
  }
  verdict.worst = on_side_of(threshold_, keeps, verdict.worst);
  if (verdict.energy >= energy_limit) verdict.kind = Verdict::Kind::kCostly;
  return verdict;
}

/// Decides in exact arithmetic about samples that are doubtful because of rounding; false if one breaks the threshold.
template <class Tally>
bool TriangleError::settle(const Tally& tally, Verdict& verdict) const {
  const TriangleTask& task = tally.task;
  const ExactTriangle outline(task.corners);
  return each_row(task, [&](std::int32_t y, std::int32_t first, std::int32_t last) {
    const float row = task.row_height(y);
    for (std::int32_t x = first; x <= last; ++x) {
      const float sample = height_at({x, y});
      if (std::isnan(sample) || !tally.is_in_doubt(task.error(x, row, sample), {x, y})) continue;
      verdict.witness = {x, y};
      if (geom::exceeds_exactly(outline.corners, outline.heights, {x * grid::kLatticeSteps, y * grid::kLatticeSteps},
                                sample, threshold_at({x, y})))
        return false;
    }
    return true;
  });
}

/// The sample of a row with the largest error or, with bounds, the largest excess.
template <class Tally>
Point TriangleError::find_worst(const Tally& tally, std::int32_t y, std::int32_t first, std::int32_t last) const {
  const float row = tally.task.row_height(y);
  float worst = -1;
  Point at{first, y};
  for (std::int32_t x = first; x <= last; ++x) {
    const float error = tally.excess(tally.task.error(x, row, height_at({x, y})), {x, y});
    if (error > worst) {
      worst = error;
      at.x = x;
    }
  }
  return at;
}

}  // namespace scarp::fit
