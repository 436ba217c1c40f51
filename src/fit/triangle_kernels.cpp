// The scan of trial triangles in vectors of four, and the choice of the scan.
#include "fit/triangle_kernels.h"

#include <vector>

#include "base/instruction_sets.h"
#include "fit/triangle_scan.h"
#include "fit/triangle_sums.h"

namespace scarp::fit {

namespace trial {

namespace {

template <class Sums>
TriangleSums assess(const TriangleTask& task, const SampleRows& rows, const ErrorLimits& limits) {
  TriangleScan scan(task, rows.end);
  Sums sums;
  TriangleSums result;
  const bool is_whole = each_row(task, [&](std::int32_t y, std::int32_t first, std::int32_t last) {
    scan.each_eight(rows.first + y * rows.stride, y, first, last,
                    [&](std::int32_t, Floats, Floats low, Masks low_meant, Floats high, Masks high_meant) {
                      sums.add(magnitudes(low, low_meant), magnitudes(high, high_meant), limits.per_square);
                    });
    if (sums.exceeds(limits.cut)) {
      result.kind = TriangleError::Verdict::Kind::kBreaks;
      result.y = y;
      result.first = first;
      result.last = last;
      return false;
    }
    if (scan.is_time_to_look() && sums.energy(limits.per_square) >= limits.energy) {
      result.kind = TriangleError::Verdict::Kind::kCostly;
      return false;
    }
    return true;
  });
  if (!is_whole) return result;
  result.worst = sums.largest();
  result.energy = sums.energy(limits.per_square);
  if (result.energy >= limits.energy) result.kind = TriangleError::Verdict::Kind::kCostly;
  return result;
}

/// Calls add(t, λ) for every four samples: of `low_sums` for the first four of eight, of `high_sums` for the others.
/// Both values are 0 where masked.
template <class Sums>
void ask(const TriangleTask& task, const SampleRows& rows, const CornerWeight& weight, Sums& low_sums,
         Sums& high_sums) {
  TriangleScan scan(task, rows.end);
  each_row(task, [&](std::int32_t y, std::int32_t first, std::int32_t last) {
    const Floats row = all(1 + weight.slope_y * (static_cast<float>(y) - task.base_y));
    const auto give = [&](Sums& sums, Floats offset, Floats error, Masks counts) {
      const Floats share = row + all(weight.slope_x) * offset;
      sums.add(kept(error, counts) * all(weight.per_threshold), kept(share, counts));
    };
    scan.each_eight(rows.first + y * rows.stride, y, first, last,
                    [&](std::int32_t, Floats left, Floats low, Masks low_meant, Floats high, Masks high_meant) {
                      give(low_sums, left, low, low_meant & (low == low));
                      give(high_sums, left + all(4), high, high_meant & (high == high));
                    });
    return true;
  });
}

template <class Sums>
CornerPull pull(const TriangleTask& task, const SampleRows& rows, const CornerWeight& weight) {
  Sums sums;
  ask(task, rows, weight, sums, sums);
  return {exact_sum_of(sums.stiffness), exact_sum_of(sums.push)};
}

template <class Sums>
void add_moments(const TriangleTask& task, const SampleRows& rows, const CornerWeight& weight,
                 TriangleError::Moments& moments) {
  Sums low_sums, high_sums;
  ask(task, rows, weight, low_sums, high_sums);
  low_sums.join(high_sums);
  add_up(low_sums, moments);
}

void narrow(const TriangleTask& task, const SampleRows& rows, const CornerWeight& weight, TriangleError::Room& room) {
  RoomLeft left(room);
  ask(task, rows, weight, left, left);
  room = left.room();
}

}  // namespace

const TriangleKernels& plain_triangle_kernels() {
  static constexpr TriangleKernels kernels{"SCALAR",
                                           {assess<Squares>, assess<EighthPowers>},
                                           {pull<SquarePull>, pull<EighthPull>},
                                           {add_moments<SquareMoments>, add_moments<EighthMoments>},
                                           narrow};
  return kernels;
}

}  // namespace trial

const TriangleKernels& triangle_kernels() {
  static const TriangleKernels& kernels = choose_kernels(available_triangle_kernels());
  return kernels;
}

std::span<const TriangleKernels> available_triangle_kernels() {
  static const std::vector<TriangleKernels> all =
      list_kernels<&trial::plain_triangle_kernels>(trial::vector_triangle_kernels());
  return all;
}

}  // namespace scarp::fit
