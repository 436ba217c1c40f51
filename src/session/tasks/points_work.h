// simplify and measure of points without their terminal.
#pragma once

#include "session/options/measure_options.h"
#include "session/options/points_options.h"
#include "session/options/simplify_options.h"
#include "session/plan/simplify_plan.h"
#include "session/reports/points_report.h"
#include "session/tasks/runner.h"

namespace CLI {
class App;
}

namespace scarp::cli {

/// Plans, reads the points, simplifies, and checks the promise. `command` is asked which options were given.
Result<void> make_points_mesh(const CLI::App& command, const SimplifyArguments& given, const PointsArguments& arguments,
                              const Runner& runner, SimplifyPlan& plan, PointsOutcome& outcome);
/// Closes the mesh into a solid where that was asked for, and writes into it who made it and where it lies.
Result<void> complete_mesh(const SimplifyPlan& plan, const PointsArguments& arguments, PointsOutcome& outcome);

/// Reads the mesh and the points, and judges the one by the other.
Result<void> judge_points(const CLI::App& command, const MeasureArguments& given, const Runner& runner,
                          JudgedPoints& judged);

}  // namespace scarp::cli
