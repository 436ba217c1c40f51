// What the samples of a triangle want of one of its corners.
#include <algorithm>

#include "fit/norm_error.h"
#include "fit/triangle_scan.h"

namespace scarp {

namespace {

double exact_sum_of(Floats s) { return (double{s[0]} + s[2]) + (double{s[1]} + s[3]); }

}  // namespace

/// Out of line it costs 1.7 % of the instructions of repair.
[[gnu::always_inline]] inline TriangleTask TriangleError::task_of(const FitCorner& a, const FitCorner& b,
                                                                  const FitCorner& c) const {
  return {a, b, c, has_bounds() ? 0 : threshold_, has_bounds() ? 0 : limit_};
}

template <bool kBounded, class Add>
void TriangleError::each_residual_by(const TriangleTask& task, const std::array<FitCorner, 3>& corners,
                                     const Add& add) const {
  const auto& [a, b, c] = corners;
  constexpr double kStep = 1.0 / kLatticeSteps;
  const ScanPlane weight = ScanPlane::spanned(
      1, {(b.x - a.x) * kStep, (b.y - a.y) * kStep, (c.x - a.x) * kStep, (c.y - a.y) * kStep, -1, -1}, 0);
  TriangleScan scan(task, end_);
  [[maybe_unused]] const Floats least = all(least_bound(task)), unit = all(static_cast<float>(unit_));
  each_row(task, [&](std::int32_t y, std::int32_t first, std::int32_t last) {
    const Floats row = all(1 + weight.slope_y * (static_cast<float>(y) - task.base_y));
    const auto give = [&](Floats offset, Floats error, Masks counts, [[maybe_unused]] Floats bounds) {
      const Floats share = row + all(weight.slope_x) * offset;
      if constexpr (kBounded) {
        add(per_bound(kept(error, counts), bounds, least), per_bound(kept(share, counts) * unit, bounds, least));
      } else {
        add(kept(error, counts) * all(per_threshold_), kept(share, counts));
      }
    };
    scan.each_eight(raster_.row(first_.y + y) + first_.x, y, first, last,
                    [&](std::int32_t x, Floats left, Floats low, Masks low_meant, Floats high, Masks high_meant) {
                      low_meant &= low == low;
                      high_meant &= high == high;
                      if constexpr (kBounded) {
                        const EightBounds by(bounds_.row(first_.y + y) + first_.x + x, bounds_.row(bounds_.rows),
                                             low_meant, high_meant);
                        give(left, low, low_meant, by.low);
                        give(left + all(4), high, high_meant, by.high);
                      } else {
                        give(left, low, low_meant, Floats{});
                        give(left + all(4), high, high_meant, Floats{});
                      }
                    });
    return true;
  });
}

/// Calls add(t, λ) for each four samples: errors in thresholds or bounds, and what a unit's rise of the first corner
/// adds to them; both 0 where none is meant.
template <class Add>
void TriangleError::each_residual(const TriangleTask& task, const std::array<FitCorner, 3>& corners,
                                  const Add& add) const {
  if (has_bounds()) {
    each_residual_by<true>(task, corners, add);
  } else {
    each_residual_by<false>(task, corners, add);
  }
}

TriangleError::Pull TriangleError::pull(const FitCorner& a, const FitCorner& b, const FitCorner& c) const {
  const TriangleTask task = task_of(a, b, c);
  Floats stiffness{}, push{};
  const auto add = [&](Floats weighed, Floats t, Floats share) {
    stiffness += weighed * share;
    push += weighed * t;
  };
  if (power_ == ErrorRule::Power::kTwo) {
    each_residual(task, {a, b, c}, [&](Floats t, Floats share) { add(share, t, share); });
  } else {
    each_residual(task, {a, b, c}, [&](Floats t, Floats share) {
      const Floats t2 = t * t;
      add(t2 * t2 * t2 * share, t, share);
    });
  }
  return {exact_sum_of(stiffness), exact_sum_of(push), double{task.plane.slope_x} / unit_,
          double{task.plane.slope_y} / unit_};
}

void TriangleError::pull(const FitCorner& a, const FitCorner& b, const FitCorner& c, std::vector<Pull>& pulls) const {
  if (norm_ != nullptr) {
    norm_->pull({a, b, c}, power_, pulls);
  } else {
    pulls.assign(1, pull(a, b, c));
  }
}

void TriangleError::add_moments(const FitCorner& a, const FitCorner& b, const FitCorner& c, Moments& moments) const {
  const TriangleTask task = task_of(a, b, c);
  std::array<Floats, 9> sums{};
  if (power_ == ErrorRule::Power::kTwo) {
    each_residual(task, {a, b, c}, [&](Floats t, Floats share) {
      sums[0] += t * t;
      sums[1] += t * share;
      sums[2] += share * share;
    });
    for (std::size_t k = 0; k < 3; ++k) moments[k] += exact_sum_of(sums[k]);
    return;
  }
  each_residual(task, {a, b, c}, [&](Floats t, Floats share) {
    const Floats t2 = t * t, t4 = t2 * t2, share2 = share * share, share4 = share2 * share2, both = t * share;
    sums[0] += t4 * t4;
    sums[1] += t4 * t2 * both;
    sums[2] += t4 * t2 * share2;
    sums[3] += t4 * both * share2;
    sums[4] += t4 * share4;
    sums[5] += t2 * both * share4;
    sums[6] += t2 * share4 * share2;
    sums[7] += both * share4 * share2;
    sums[8] += share4 * share4;
  });
  for (std::size_t k = 0; k < sums.size(); ++k) moments[k] += exact_sum_of(sums[k]);
}

void TriangleError::narrow(const FitCorner& a, const FitCorner& b, const FitCorner& c, Room& room) const {
  const TriangleTask task = task_of(a, b, c);
  constexpr float kLeastShare = 1e-5f;
  Floats lowest = all(room.lowest), highest = all(room.highest);
  each_residual(task, {a, b, c}, [&](Floats t, Floats share) {
    const Masks weighs = share > all(kLeastShare);
    const Floats down = (all(-1) - t) / share, up = (all(1) - t) / share;
    lowest = (weighs & (down > lowest)) ? down : lowest;
    highest = (weighs & (up < highest)) ? up : highest;
  });
  room.lowest = std::max({lowest[0], lowest[1], lowest[2], lowest[3]});
  room.highest = std::min({highest[0], highest[1], highest[2], highest[3]});
}

}  // namespace scarp
