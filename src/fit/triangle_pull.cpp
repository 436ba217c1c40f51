// The pull of a triangle's samples on one of its corners.
#include "fit/norm_error.h"
#include "fit/scattered_samples.h"
#include "fit/triangle_kernels.h"
#include "fit/triangle_scan.h"
#include "fit/triangle_sums.h"

namespace scarp::fit {

/// Without inlining, repair needs 1.7 % more instructions.
[[gnu::always_inline]] inline TriangleTask TriangleError::task_of(const FitCorner& a, const FitCorner& b,
                                                                  const FitCorner& c) const {
  return {a, b, c, has_bounds() ? 0 : threshold_, has_bounds() ? 0 : limit_};
}

CornerWeight TriangleError::weight_of(const FitCorner& a, const FitCorner& b, const FitCorner& c) const {
  constexpr double kStep = 1.0 / grid::kLatticeSteps;
  const geom::ScanPlane weight = geom::ScanPlane::spanned(
      1, {(b.x - a.x) * kStep, (b.y - a.y) * kStep, (c.x - a.x) * kStep, (c.y - a.y) * kStep, -1, -1}, 0);
  return {weight.slope_x, weight.slope_y, per_threshold_};
}

/// Calls sums.add(t, λ) for every four samples: errors in bounds, and their change per unit rise of the first corner;
/// both are 0 where masked.
template <class Sums>
Sums TriangleError::ask_by_bounds(const TriangleTask& task, const CornerWeight& weight, Sums sums) const {
  TriangleScan scan(task, end_);
  const Floats least = all(least_bound(task)), unit = all(static_cast<float>(unit_));
  each_row(task, [&](std::int32_t y, std::int32_t first, std::int32_t last) {
    const Floats row = all(1 + weight.slope_y * (static_cast<float>(y) - task.base_y));
    const auto give = [&](Floats offset, Floats error, Masks counts, Floats bounds) {
      const Floats share = row + all(weight.slope_x) * offset;
      sums.add(per_bound(kept(error, counts), bounds, least), per_bound(kept(share, counts) * unit, bounds, least));
    };
    scan.each_eight(raster_.row(first_.y + y) + first_.x, y, first, last,
                    [&](std::int32_t x, Floats left, Floats low, Masks low_meant, Floats high, Masks high_meant) {
                      low_meant &= low == low;
                      high_meant &= high == high;
                      const EightBounds by(bounds_.row(first_.y + y) + first_.x + x, bounds_.row(bounds_.rows),
                                           low_meant, high_meant);
                      give(left, low, low_meant, by.low);
                      give(left + all(4), high, high_meant, by.high);
                    });
    return true;
  });
  return sums;
}

TriangleError::Pull TriangleError::pull(const FitCorner& a, const FitCorner& b, const FitCorner& c) const {
  if (points_ != nullptr) return points_->pull({a, b, c}, power_);
  const TriangleTask task = task_of(a, b, c);
  const CornerWeight weight = weight_of(a, b, c);
  const double slope_x = double{task.plane.slope_x} / unit_, slope_y = double{task.plane.slope_y} / unit_;
  if (!has_bounds()) {
    const CornerPull by = kernels_->pull[static_cast<std::size_t>(power_)](task, rows(), weight);
    return {by.stiffness, by.push, slope_x, slope_y};
  }
  const auto pull_of = [&](const auto& sums) {
    return Pull{exact_sum_of(sums.stiffness), exact_sum_of(sums.push), slope_x, slope_y};
  };
  return power_ == ErrorRule::Power::kTwo ? pull_of(ask_by_bounds(task, weight, SquarePull{}))
                                          : pull_of(ask_by_bounds(task, weight, EighthPull{}));
}

void TriangleError::pull(const FitCorner& a, const FitCorner& b, const FitCorner& c, std::vector<Pull>& pulls) const {
  if (norm_ != nullptr) {
    norm_->pull({a, b, c}, power_, pulls);
  } else {
    pulls.assign(1, pull(a, b, c));
  }
}

void TriangleError::add_moments(const FitCorner& a, const FitCorner& b, const FitCorner& c, Moments& moments) const {
  if (points_ != nullptr) return points_->add_moments({a, b, c}, power_, moments);
  const TriangleTask task = task_of(a, b, c);
  const CornerWeight weight = weight_of(a, b, c);
  if (!has_bounds()) {
    kernels_->add_moments[static_cast<std::size_t>(power_)](task, rows(), weight, moments);
  } else if (power_ == ErrorRule::Power::kTwo) {
    add_up(ask_by_bounds(task, weight, SquareMoments{}), moments);
  } else {
    add_up(ask_by_bounds(task, weight, EighthMoments{}), moments);
  }
}

void TriangleError::narrow(const FitCorner& a, const FitCorner& b, const FitCorner& c, Room& room) const {
  if (points_ != nullptr) return points_->narrow({a, b, c}, room);
  const TriangleTask task = task_of(a, b, c);
  const CornerWeight weight = weight_of(a, b, c);
  if (has_bounds()) {
    room = ask_by_bounds(task, weight, RoomLeft(room)).room();
  } else {
    kernels_->narrow(task, rows(), weight, room);
  }
}

}  // namespace scarp::fit
