// Sets samples outside runs to nodata.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>

#include "grid/sample_runs.h"

namespace scarp::grid {

/// Sets the samples [begin, end) of a row to nodata (NaN), except those in runs. `runs`: of that row, ascending,
/// disjoint. `samples`: starts at `begin`.
inline void mask_beside(std::span<const SampleRun> runs, std::int32_t begin, std::int32_t end, float* samples) {
  std::int32_t done = begin;
  const auto mask_up_to = [&](std::int32_t to) {
    if (to > done) std::fill(samples + (done - begin), samples + (to - begin), std::numeric_limits<float>::quiet_NaN());
  };
  for (const SampleRun& run : runs) {
    mask_up_to(std::min(run.begin, end));
    done = std::max(done, run.end);
  }
  mask_up_to(end);
}

}  // namespace scarp::grid
