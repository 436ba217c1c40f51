#include "live/bound_ladder.h"

#include <algorithm>
#include <cmath>

namespace scarp::live {

namespace {

constexpr std::int64_t kRungs = 4;  // to a factor of 2

std::int64_t divide_down(std::int64_t value, std::int64_t by) { return value / by - (value % by < 0 ? 1 : 0); }

/// 2^(rung / kRungs + small / (kRungs · steps)). Square roots and products are the same on every machine, as those of a
/// library's exp2() are not. REQUIRES: `steps` is a power of two.
double bound_at(std::int64_t rung, std::int64_t small = 0, std::int64_t steps = 1) {
  const std::int64_t power = divide_down(rung, kRungs);
  double bound = 1, root = 2;
  for (std::int64_t part = (rung - power * kRungs) * steps + small, whole = kRungs * steps; part > 0;) {
    root = std::sqrt(root);
    whole /= 2;
    if (part >= whole) bound *= root;
    part %= whole;
  }
  return std::ldexp(bound, static_cast<int>(power));
}

}  // namespace

BoundLadder::BoundLadder(const CellLattice& lattice, double max_error, bool has_budget)
    : lattice_(lattice), max_error_(max_error), has_budget_(has_budget), slots_(lattice.slot_count()) {}

std::int64_t BoundLadder::level_of(double bound) const {
  std::int64_t rung = kLowest;
  while (rung < kHighest && bound_at(rung + 1) <= bound) ++rung;
  return rung * step();
}

double BoundLadder::bound_of(SampleAt cell, std::int64_t level) const {
  const std::int64_t rung = divide_down(level, step()), rest = level - rung * step();
  const std::int64_t climbed = rest / kSmallSteps, slot = lattice_.slot_of(cell);
  if (slot == climbed) return std::max(max_error_, bound_at(rung, rest % kSmallSteps, kSmallSteps));
  return std::max(max_error_, bound_at(rung + (slot < climbed ? 1 : 0)));
}

CellBounds BoundLadder::bounds_of(SampleAt cell, std::int64_t level) const {
  if (!has_budget_) return {max_error_, {max_error_, max_error_, max_error_, max_error_}};
  const double inside = bound_of(cell, level);
  const auto with = [&](std::int32_t cols, std::int32_t rows) {
    return std::min(inside, bound_of({cell.col + cols, cell.row + rows}, level));
  };
  return {inside, {with(0, -1), with(0, 1), with(-1, 0), with(1, 0)}};
}

bool BoundLadder::is_lowest(std::int64_t level) const {
  const std::int64_t rung = divide_down(level, step());
  return rung <= kLowest || bound_at(rung + 1) <= max_error_;
}

/// Steps that are too short cost little, since no cell is made twice on the way. So steps are for counts that a rung
/// halves; only far from the budget they grow. Levels come from sums, products and quotients of doubles alone, which
/// are the same on every machine.
std::int64_t LevelSearch::estimate(const Trial& now) const {
  const double middle = 0.99 * static_cast<double>(budget_), surplus = now.triangles - middle;
  const auto rungs = [&](double of) { return of * static_cast<double>(step_); };
  double by = rungs(surplus / std::max(now.triangles, middle));
  if (last_ && std::abs(surplus) > middle / 4) {
    const auto walked = static_cast<double>(now.level - last_->level);
    const double most = 4 * std::abs(walked), slope = (last_->triangles - now.triangles) / walked;
    by = slope > 0 ? std::clamp(surplus / slope, -most, most) : std::copysign(most, surplus);
  }
  return now.level + static_cast<std::int64_t>(std::clamp(by, rungs(-8), rungs(8)));
}

std::optional<std::int64_t> LevelSearch::next(std::int64_t level, std::uint64_t triangles, bool is_finest) {
  const Trial now{level, static_cast<double>(triangles)};
  // A search that moves continues to the middle of the range, so that the next change seldom needs one.
  const std::uint64_t spare = last_ ? budget_ / 200 : 0;
  const bool is_over = triangles > budget_ - spare;
  (is_over ? over_ : within_) = now;
  if (!is_over && (triangles >= budget_ - budget_ / 50 + spare || is_finest)) return std::nullopt;
  if (over_ && within_ && within_->level <= over_->level + 1) {
    if (level == within_->level) return std::nullopt;
    return within_->level;
  }
  std::int64_t to = is_over ? std::max(estimate(now), level + 1) : std::min(estimate(now), level - 1);
  if (over_) to = std::max(to, over_->level + 1);
  if (within_) to = std::min(to, within_->level - 1);
  last_ = now;
  constexpr int kEstimates = 12;
  return over_ && within_ && ++tries_ > kEstimates ? over_->level + (within_->level - over_->level) / 2 : to;
}

}  // namespace scarp::live
