#include "fit/triangle_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fit/triangle_scan.h"
#include "geom/exact_error.h"

namespace scarp {

namespace {

/// Adds up lanes, in an order that is part of the result.
float sum_of(Floats low, Floats high) {
  const Floats s = low + high;
  return std::min((s[0] + s[2]) + (s[1] + s[3]), std::numeric_limits<float>::max());
}

/// Largest error, lane by lane.
struct Largest {
  Floats worst{};

  void add(Floats low, Floats high) {
    const Floats larger = low > high ? low : high;
    worst = larger > worst ? larger : worst;
  }
  bool exceeds(float cut) const { return any(worst > all(cut)); }
  float largest() const { return std::max(std::max(worst[0], worst[2]), std::max(worst[1], worst[3])); }
};

/// And the sum of squares.
struct Squares : Largest {
  Floats low_sum{}, high_sum{};

  void add(Floats low, Floats high, float) {
    Largest::add(low, high);
    low_sum += low * low;
    high_sum += high * high;
  }
  float energy(float per_square) const { return sum_of(low_sum, high_sum) * per_square; }
};

/// Or of eighth powers, of errors in thresholds.
struct EighthPowers : Largest {
  Floats low_sum{}, high_sum{};

  void add(Floats low, Floats high, float per_square) {
    Largest::add(low, high);
    const Floats low2 = low * low * all(per_square), high2 = high * high * all(per_square);
    const Floats low4 = low2 * low2, high4 = high2 * high2;
    low_sum += low4 * low4;
    high_sum += high4 * high4;
  }
  float energy(float) const { return sum_of(low_sum, high_sum); }
};

}  // namespace

TriangleError::TriangleError(const Raster& raster, Point first, double threshold, const ErrorRule& rule)
    : raster_(raster),
      first_(first),
      threshold_(threshold),
      limit_(rule.slack * threshold),
      power_(rule.power),
      per_threshold_(threshold > 0x1p-60 && threshold < 0x1p60 ? static_cast<float>(1 / threshold) : 0),
      per_square_(per_threshold_ > 0 ? static_cast<float>(1 / (threshold * threshold)) : 0),
      end_(raster.row(raster.rows)) {}

namespace {

/// A triangle as exact arithmetic wants it.
struct Outline {
  std::array<Point, 3> corners;
  std::array<float, 3> heights;

  explicit Outline(const std::array<FitCorner, 3>& of) {
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = {of[k].x, of[k].y};
      heights[k] = of[k].z;
    }
  }
};

/// By Pick's theorem: the smallest triangle whose corners are samples.
bool holds_corners_only(const FitCorner& a, const FitCorner& b, const FitCorner& c) {
  if (((a.x | a.y | b.x | b.y | c.x | c.y) & (kLatticeSteps - 1)) != 0) return false;
  return orient({a.x, a.y}, {b.x, b.y}, {c.x, c.y}) == kLatticeSteps * kLatticeSteps;
}

}  // namespace

TriangleError::Verdict TriangleError::judge(const FitCorner& a, const FitCorner& b, const FitCorner& c,
                                            float energy_limit) const {
  if (holds_corners_only(a, b, c)) return judge_corners({a, b, c}, energy_limit);
  return power_ == ErrorRule::Power::kTwo ? judge_by<Squares>(a, b, c, energy_limit)
                                          : judge_by<EighthPowers>(a, b, c, energy_limit);
}

template <class Sums>
TriangleError::Verdict TriangleError::judge_by(const FitCorner& a, const FitCorner& b, const FitCorner& c,
                                               float energy_limit) const {
  const TriangleTask task(a, b, c, threshold_, limit_);
  TriangleScan scan(task, end_);
  Sums sums;
  Verdict verdict;
  const auto add = [&](Floats, Floats low, Masks low_meant, Floats high, Masks high_meant) {
    sums.add(magnitudes(low, low_meant), magnitudes(high, high_meant), per_square_);
  };
  const bool is_whole = each_row(task, [&](std::int32_t y, std::int32_t first, std::int32_t last) {
    scan.each_eight(raster_.row(first_.y + y) + first_.x, y, first, last, add);
    if (sums.exceeds(task.cut)) {
      verdict.kind = Verdict::Kind::kBreaks;
      verdict.witness = find_worst(task, y, first, last);
      return false;
    }
    if (scan.is_time_to_look() && sums.energy(per_square_) >= energy_limit) {
      verdict.kind = Verdict::Kind::kCostly;
      return false;
    }
    return true;
  });
  if (!is_whole) return verdict;
  verdict.worst = sums.largest();
  verdict.energy = sums.energy(per_square_);
  if (verdict.energy >= energy_limit) {
    verdict.kind = Verdict::Kind::kCostly;
  } else if (!decide(task, verdict) && limit_ == threshold_) {
    verdict.kind = Verdict::Kind::kBreaks;
  }
  return verdict;
}

/// Whether the triangle keeps the threshold; `worst` is brought into line.
bool TriangleError::decide(const TriangleTask& task, Verdict& verdict) const {
  const bool in_doubt = verdict.worst > task.doubt || double{task.plane.guard} > threshold_;
  const bool keeps = !(verdict.worst > task.certain) && (!in_doubt || settle(task, verdict));
  take_side(keeps, verdict);
  return keeps;
}

/// Moves `worst` to the side of the threshold where it belongs.
void TriangleError::take_side(bool keeps, Verdict& verdict) const {
  auto nearest = static_cast<float>(threshold_);
  if (keeps) {
    if (double{nearest} > threshold_) nearest = std::nextafter(nearest, 0.0f);
    verdict.worst = std::min(verdict.worst, nearest);
  } else {
    if (double{nearest} <= threshold_) nearest = std::nextafter(nearest, std::numeric_limits<float>::infinity());
    verdict.worst = std::max(verdict.worst, nearest);
  }
}

float TriangleError::energy_of(float error) const {
  const float square = error * error * per_square_;
  return power_ == ErrorRule::Power::kTwo ? square : square * square * (square * square);
}

/// REQUIRES: corners are samples' places, and no other sample lies in the triangle.
TriangleError::Verdict TriangleError::judge_corners(const std::array<FitCorner, 3>& corners, float energy_limit) const {
  const Outline outline(corners);
  Verdict verdict;
  bool keeps = true;
  for (const FitCorner& corner : corners) {
    const Point at{corner.x / kLatticeSteps, corner.y / kLatticeSteps};
    const float sample = height_at(at), error = std::abs(corner.z - sample);
    if (corner.z == sample || std::isnan(error)) continue;
    if (exceeds_exactly(outline.corners, outline.heights, {corner.x, corner.y}, sample, threshold_)) {
      keeps = false;
      if (limit_ == threshold_ || double{error} > limit_) {
        verdict.kind = Verdict::Kind::kBreaks;
        verdict.witness = at;
        return verdict;
      }
    }
    verdict.worst = std::max(verdict.worst, error);
    verdict.energy += energy_of(error);
  }
  take_side(keeps, verdict);
  if (verdict.energy >= energy_limit) verdict.kind = Verdict::Kind::kCostly;
  return verdict;
}

/// Decides in exact arithmetic about the samples that rounding leaves in doubt; false where one breaks the threshold.
bool TriangleError::settle(const TriangleTask& task, Verdict& verdict) const {
  const Outline outline(task.corners);
  const bool all_in_doubt = double{task.plane.guard} > threshold_;
  return each_row(task, [&](std::int32_t y, std::int32_t first, std::int32_t last) {
    const float row = task.row_height(y);
    for (std::int32_t x = first; x <= last; ++x) {
      const float sample = height_at({x, y});
      if (std::isnan(sample) || (!all_in_doubt && !(task.error(x, row, sample) > task.doubt))) continue;
      verdict.witness = {x, y};
      if (exceeds_exactly(outline.corners, outline.heights, {x * kLatticeSteps, y * kLatticeSteps}, sample, threshold_))
        return false;
    }
    return true;
  });
}

/// The sample of a row with the largest error.
Point TriangleError::find_worst(const TriangleTask& task, std::int32_t y, std::int32_t first, std::int32_t last) const {
  const float row = task.row_height(y);
  float worst = -1;
  Point at{first, y};
  for (std::int32_t x = first; x <= last; ++x) {
    if (const float error = task.error(x, row, height_at({x, y})); error > worst) {
      worst = error;
      at.x = x;
    }
  }
  return at;
}

}  // namespace scarp
