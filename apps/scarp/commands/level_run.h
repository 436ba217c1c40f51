// The levels of a run apart from the finest, which is the run's own mesh.
#pragma once

#include <string>
#include <vector>

#include "commands/simplify_run.h"
#include "reports/simplify_outcome.h"

namespace scarp::cli {

/// Simplifies all levels. The finest is what is returned, the others are the outcome's.
Result<Simplified> simplify_as_levels(const SimplifyPlan& plan, const SimplifyOptions& options, Outcome& outcome);
/// Swaps a level into the outcome while `work` uses it.
template <class Work>
auto with_level(Outcome& outcome, Level& level, Work&& work) {
  const auto swap = [&] {
    std::swap(outcome.simplified, level.simplified);
    std::swap(outcome.asked, level.asked);
  };
  swap();
  auto result = work();
  swap();
  return result;
}

/// The "levels" of the report, the finest first; null without --lods.
Json describe_levels(const SimplifyPlan& plan, const Outcome& outcome);
/// Lines of the summary; empty without --lods.
std::string levels_lines(const Outcome& outcome);

}  // namespace scarp::cli
