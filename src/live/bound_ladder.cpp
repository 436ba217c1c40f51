#include "live/bound_ladder.h"

#include <algorithm>
#include <cmath>

namespace scarp::live {

namespace {

constexpr std::int64_t kRungs = 4;  // to a factor of 2

std::int64_t divide_down(std::int64_t value, std::int64_t by) { return value / by - (value % by < 0 ? 1 : 0); }

/// 2^(part / (kRungs · steps)). Square roots and products are the same on every machine, unlike the results of a
/// library's exp2(). REQUIRES: `steps` is a power of two.
double bound_at(std::int64_t part, std::int64_t steps) {
  std::int64_t whole = kRungs * steps;
  const std::int64_t power = divide_down(part, whole);
  double bound = 1, root = 2;
  for (part -= power * whole; part > 0; part %= whole) {
    root = std::sqrt(root);
    whole /= 2;
    if (part >= whole) bound *= root;
  }
  return std::ldexp(bound, static_cast<int>(power));
}

}  // namespace

BoundLadder::BoundLadder(const CellLattice& lattice, double max_error, bool has_budget)
    : lattice_(lattice), max_error_(max_error), has_budget_(has_budget), slots_(lattice.slot_count()) {}

std::int64_t BoundLadder::level_of(double bound) const {
  std::int64_t rung = -kRange;
  while (rung < kRange && bound_at(rung + 1, 1) <= bound) ++rung;
  return rung * step();
}

std::array<std::int64_t, 5> BoundLadder::heights_of(SampleAt cell, std::int64_t level) const {
  const std::int64_t rung = divide_down(level, step()), climbed = level - rung * step();
  const auto height = [&](std::int32_t cols, std::int32_t rows) {
    const std::int64_t before = kSmallSteps * lattice_.slot_of({cell.col + cols, cell.row + rows});
    return rung * kSmallSteps + std::clamp<std::int64_t>(climbed - before, 0, kSmallSteps);
  };
  const std::int64_t own = height(0, 0);
  return {own, std::min(own, height(0, -1)), std::min(own, height(0, 1)), std::min(own, height(-1, 0)),
          std::min(own, height(1, 0))};
}

CellBounds BoundLadder::bounds_of(SampleAt cell, std::int64_t level) const {
  if (!has_budget_) return {max_error_, {max_error_, max_error_, max_error_, max_error_}};
  const auto heights = heights_of(cell, level);
  const auto bound = [&](std::size_t k) { return std::max(max_error_, bound_at(heights[k], kSmallSteps)); };
  return {bound(0), {bound(1), bound(2), bound(3), bound(4)}};
}

/// Steps that are too short cost little, since no cell is made twice on the way. So the first steps are those for
/// counts that a rung halves; later steps double until the budget lies between two levels. Levels are computed only
/// from sums, products and quotients of doubles, which are the same on every machine.
std::int64_t LevelSearch::estimate(std::int64_t level, double surplus) const {
  const auto step = static_cast<double>(ladder_.step()), budget = static_cast<double>(budget_);
  const double growth = over_ && within_ ? 1 : std::ldexp(1, std::clamp(tries_ - 2, 0, 10));
  const double by = step * growth * surplus / std::max(budget, budget + surplus);
  const auto whole = static_cast<std::int64_t>(by);
  return level + (surplus > 0 ? std::max<std::int64_t>(whole, 1) : std::min<std::int64_t>(whole, -1));
}

std::optional<std::int64_t> LevelSearch::next(std::int64_t level, std::uint64_t triangles, bool can_be_finer,
                                              bool can_be_coarser) {
  constexpr int kMostTries = 24, kEstimates = 8;
  // A search that changes the level continues to the middle of the range, so that the next change seldom needs a
  // search.
  const std::uint64_t spare = tries_ > 0 ? budget_ / 200 : 0;
  if (tries_++ > 0) least_ = enough(budget_) + spare;
  if (triangles <= budget_ && (!found_ || level < *found_)) found_ = level;
  const bool is_over = triangles > budget_ - spare;
  if (is_over && (!can_be_coarser || level >= ladder_.highest())) return std::nullopt;
  if (!is_over && (triangles >= least_ || !can_be_finer || level <= ladder_.lowest())) {
    found_ = level;
    return std::nullopt;
  }
  (is_over ? over_ : within_) = level;
  const bool is_between = over_ && within_;
  if (is_between && (*within_ <= *over_ + 1 || tries_ > kMostTries)) return std::nullopt;
  if (is_between && tries_ > kEstimates) return *over_ + (*within_ - *over_) / 2;
  const double surplus = static_cast<double>(triangles) - 0.99 * static_cast<double>(budget_);
  std::int64_t to = std::clamp(estimate(level, surplus), ladder_.lowest(), ladder_.highest());
  if (over_) to = std::max(to, *over_ + 1);
  if (within_) to = std::min(to, *within_ - 1);
  return to;
}

}  // namespace scarp::live
