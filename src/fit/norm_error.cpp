#include "fit/norm_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "fit/norm_scan.h"

namespace scarp::fit {

namespace {

/// True if the triangle contains no samples except its corners.
bool holds_corners_alone(const NormError::Corners& corners) {
  return area2(corners[0], corners[1], corners[2]) == grid::kLatticeSteps * grid::kLatticeSteps;
}

/// The verdict on a triangle within the bound.
NormError::Verdict without_energy(float energy_limit) {
  NormError::Verdict verdict;
  if (!(energy_limit > 0)) verdict.kind = NormError::Verdict::Kind::kCostly;
  return verdict;
}

/// Moves `worst` to the exact side of 1.
float brought_to_side(float worst, bool keeps) {
  return keeps ? std::min(worst, 1.0f) : std::max(worst, std::nextafter(1.0f, 2.0f));
}

/// Comparisons and sums over the samples scanned so far, lane by lane.
template <Norm kNorm>
struct NormTally {
  float over_limit_at, over_at, doubt_at;  // factors that widen or narrow bounds before the guard is added
  float guard, least;
  bool is_eighth_power;
  Masks over_limit{}, over{}, doubt{};
  Floats worst{}, low_sum{}, high_sum{};  // sums of squares of errors in bounds

  NormTally(const NormPlanes& planes, const ErrorRule& rule)
      : over_limit_at(static_cast<float>(rule.slack) * (1 + planes.widening)),
        over_at(1 + planes.widening),
        doubt_at(1 - planes.widening),
        guard(planes.guard),
        least(least_bound(planes)),
        is_eighth_power(rule.power == ErrorRule::Power::kEight) {}

  void add(const NormEight<kNorm>& norms, const EightPlaces& places) {
    compare(norms.low, places.low_bound, places.low_meant);
    compare(norms.high, places.high_bound, places.high_meant);
    const Floats low = squares(norms.low, places.low_bound), high = squares(norms.high, places.high_bound);
    worst = larger_of(larger_of(low, high), worst);
    low_sum += powers(low);
    high_sum += powers(high);
  }
  /// NaN counts as doubtful.
  void compare(Floats error, Floats bound, Masks meant) {
    over_limit |= error > measure_of<kNorm>(bound * all(over_limit_at) + all(guard));
    over |= error > measure_of<kNorm>(bound * all(over_at) + all(guard));
    doubt |= meant & ~(error < measure_of<kNorm>(larger_of(bound * all(doubt_at) - all(guard), Floats{})));
  }
  Floats squares(Floats error, Floats bound) const {
    if constexpr (kNorm == Norm::kSquares) return per_bound(error, bound * bound, all(least * least));
    const Floats share = per_bound(error, bound, all(least));
    return share * share;
  }
  Floats powers(Floats squares) const {
    if (!is_eighth_power) return squares;
    const Floats fourth = squares * squares;
    return fourth * fourth;
  }
  float energy() const {
    const Floats s = low_sum + high_sum;
    return std::min((s[0] + s[2]) + (s[1] + s[3]), std::numeric_limits<float>::max());
  }
  float largest() const { return std::sqrt(std::max(std::max(worst[0], worst[2]), std::max(worst[1], worst[3]))); }
};

/// The sample of a row that exceeds its limit most.
template <Norm kNorm>
Point find_worst(const NormScan& scan, const NormPlanes& planes, std::int32_t y, std::int32_t first, std::int32_t last,
                 double slack) {
  float worst = -std::numeric_limits<float>::infinity();
  Point at{first, y};
  const auto look = [&](std::int32_t x, Floats errors, Floats bounds, Masks meant) {
    for (std::int32_t i = 0; i < 4; ++i) {
      const float error = kNorm == Norm::kSquares ? std::sqrt(errors[i]) : errors[i];
      const float excess = error - bounds[i] * static_cast<float>(slack);
      if (meant[i] == 0 || !(excess > worst)) continue;
      worst = excess;
      at.x = x + i;
    }
  };
  scan.each_eight<kNorm>(planes, y, first, last,
                         [&](std::int32_t x, const NormEight<kNorm>& norms, const EightPlaces& places) {
                           look(x, norms.low, places.low_bound, places.low_meant);
                           look(x + 4, norms.high, places.high_bound, places.high_meant);
                         });
  return at;
}

double per_unit_of(double unit) { return unit > 0x1p-60 && unit < 0x1p60 ? 1 / unit : 0; }

}  // namespace

NormError::NormError(const FitNorm& norm, Samples samples, double threshold)
    : norm_(norm), samples_(std::move(samples)), unit_(threshold), per_unit_(per_unit_of(threshold)) {}

NormError::NormError(const FitNorm& norm, Samples samples, const SampleBounds& bounds)
    : norm_(norm),
      samples_(std::move(samples)),
      bounds_{bounds.bounds, samples_.heights.cols, samples_.heights.rows},
      unit_(bounds.unit),
      per_unit_(per_unit_of(bounds.unit)) {}

NormScan NormError::scan() const { return {norm_, samples_, bounds_, per_unit_}; }

NormError::Verdict NormError::assess(const Corners& corners, float energy_limit, const ErrorRule& rule) const {
  if (holds_corners_alone(corners)) return without_energy(energy_limit);
  if (!has_energy()) return assess_slowly(corners, energy_limit);
  const NormPlanes planes(scan(), corners);
  if (!planes.are_finite) return assess_slowly(corners, energy_limit);
  if (norm() == Norm::kSum) return assess_by<Norm::kSum>(planes, energy_limit, rule);
  if (norm() == Norm::kSquares) return assess_by<Norm::kSquares>(planes, energy_limit, rule);
  return assess_by<Norm::kMax>(planes, energy_limit, rule);
}

template <Norm kNorm>
NormError::Verdict NormError::assess_by(const NormPlanes& planes, float energy_limit, const ErrorRule& rule) const {
  const NormScan scan = this->scan();
  NormTally<kNorm> tally(planes, rule);
  Verdict verdict;
  int rows = 0;
  const bool is_whole = each_row(planes.task, [&](std::int32_t y, std::int32_t first, std::int32_t last) {
    scan.each_eight<kNorm>(
        planes, y, first, last,
        [&](std::int32_t, const NormEight<kNorm>& norms, const EightPlaces& places) { tally.add(norms, places); });
    if (any(tally.over_limit)) {
      verdict.kind = Verdict::Kind::kBreaks;
      verdict.witness = find_worst<kNorm>(scan, planes, y, first, last, rule.slack);
      return false;
    }
    if (++rows % kRowsPerLook == 0 && tally.energy() >= energy_limit) {
      verdict.kind = Verdict::Kind::kCostly;
      return false;
    }
    return true;
  });
  if (!is_whole) return verdict;
  verdict.energy = tally.energy();
  if (verdict.energy >= energy_limit) {
    verdict.kind = Verdict::Kind::kCostly;
    return verdict;
  }
  bool keeps = !any(tally.over);
  if (keeps && any(tally.doubt)) {
    const auto breach = find_breach(planes.task.corners);
    keeps = !breach;
    if (breach) verdict.witness = *breach;
  }
  verdict.worst = brought_to_side(tally.largest(), keeps);
  if (!keeps && rule.slack == 1) verdict.kind = Verdict::Kind::kBreaks;
  return verdict;
}

NormError::Verdict NormError::assess_slowly(const Corners& corners, float energy_limit) const {
  if (const auto breach = find_breach(corners)) return {Verdict::Kind::kBreaks, 0, 0, *breach};
  return without_energy(energy_limit);
}

std::optional<Point> NormError::find_breach(const Corners& corners) const {
  std::array<Point, 3> points;
  for (std::size_t k = 0; k < 3; ++k)
    points[k] = {corners[k].x / grid::kLatticeSteps + samples_.origin.x,
                 corners[k].y / grid::kLatticeSteps + samples_.origin.y};
  auto breach = norm_.find_breach(points);
  if (breach) *breach = {breach->x - samples_.origin.x, breach->y - samples_.origin.y};
  return breach;
}

}  // namespace scarp::fit
