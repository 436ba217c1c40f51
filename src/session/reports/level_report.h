// The levels of a run beside the finest, which is the run's own mesh.
#pragma once

#include <string>
#include <vector>

#include "session/reports/simplify_outcome.h"
#include "session/reports/simplify_run.h"

namespace scarp::cli {

/// Simplifies all levels. The finest is what is returned, the others are the outcome's.
Result<Simplified> simplify_as_levels(const SimplifyPlan& plan, const SimplifyOptions& options, Outcome& outcome);
/// Takes a level's place in the outcome while `work` looks at it.
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
