// The levels of a run in the report and the summary.
#pragma once

#include <string>

#include "session/plan/simplify_plan.h"
#include "session/reports/simplify_run.h"
#include "session/text/json.h"

namespace scarp::cli {

/// The "levels" of the report, from the finest to the coarsest; null without --lods.
Json describe_levels(const SimplifyPlan& plan, const SimplifyRun& run);
/// Lines of the summary; empty without --lods.
std::string levels_lines(const SimplifyRun& run);

}  // namespace scarp::cli
