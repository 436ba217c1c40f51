// Treats a level of a run as the run's own mesh.
#pragma once

#include <utility>

#include "session/reports/simplify_run.h"

namespace scarp::cli {

/// Swaps a level into the outcome while `work` uses it.
template <class Work>
auto with_level(SimplifyRun& outcome, Level& level, Work&& work) {
  const auto swap = [&] {
    std::swap(outcome.simplified, level.simplified);
    std::swap(outcome.asked, level.asked);
  };
  swap();
  auto result = work();
  swap();
  return result;
}

}  // namespace scarp::cli
