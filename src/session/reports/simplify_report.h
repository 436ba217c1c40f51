// The report of `scarp simplify`.
#pragma once

#include <string>
#include <vector>

#include "session/plan/simplify_plan.h"
#include "session/reports/simplify_outcome.h"
#include "session/reports/simplify_run.h"
#include "session/text/json.h"

namespace scarp::cli {

/// The JSON of --report.
Json make_report(const SimplifyPlan& plan, const Outcome& outcome, const std::vector<ReadyFile>& files,
                 const std::string& command_line);
/// The lines on standard output.
std::string make_summary(const SimplifyPlan& plan, const Outcome& outcome, const std::vector<ReadyFile>& files);

}  // namespace scarp::cli
