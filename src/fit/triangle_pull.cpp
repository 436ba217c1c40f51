// What the samples of a triangle want of one of its corners.
#include "fit/triangle_scan.h"

namespace scarp {

namespace {

double exact_sum_of(Floats s) { return (double{s[0]} + s[2]) + (double{s[1]} + s[3]); }

}  // namespace

/// Calls add(t, λ) for each four samples: errors in thresholds, and weights of the first corner; both 0
/// where none is meant.
template <class Add>
void TriangleError::each_residual(const TriangleTask& task, const std::array<FitCorner, 3>& corners,
                                  const Add& add) const {
  const auto& [a, b, c] = corners;
  constexpr double kStep = 1.0 / kLatticeSteps;
  const ScanPlane weight = ScanPlane::spanned(
      1, {(b.x - a.x) * kStep, (b.y - a.y) * kStep, (c.x - a.x) * kStep, (c.y - a.y) * kStep, -1, -1}, 0);
  TriangleScan scan(task, end_);
  each_row(task, [&](std::int32_t y, std::int32_t first, std::int32_t last) {
    const Floats row = all(1 + weight.slope_y * (static_cast<float>(y) - task.base_y));
    const auto give = [&](Floats offset, Floats error, Masks meant) {
      const Floats share = row + all(weight.slope_x) * offset;
      const Masks counts = meant & (error == error);
      add(kept(error, counts) * all(per_threshold_), kept(share, counts));
    };
    scan.each_eight(raster_.row(first_.y + y) + first_.x, y, first, last,
                    [&](Floats left, Floats low, Masks low_meant, Floats high, Masks high_meant) {
                      give(left, low, low_meant);
                      give(left + all(4), high, high_meant);
                    });
    return true;
  });
}

TriangleError::Pull TriangleError::pull(const FitCorner& a, const FitCorner& b, const FitCorner& c) const {
  const TriangleTask task(a, b, c, threshold_, limit_);
  Floats stiffness{}, push{};
  each_residual(task, {a, b, c}, [&](Floats t, Floats share) {
    const Floats t2 = t * t, t6_share = t2 * t2 * t2 * share;
    stiffness += t6_share * share;
    push += t6_share * t;
  });
  return {exact_sum_of(stiffness), exact_sum_of(push), double{task.plane.slope_x} / threshold_,
          double{task.plane.slope_y} / threshold_};
}

void TriangleError::add_moments(const FitCorner& a, const FitCorner& b, const FitCorner& c, Moments& moments) const {
  const TriangleTask task(a, b, c, threshold_, limit_);
  std::array<Floats, 9> sums{};
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

}  // namespace scarp
