// simplify and measure of points without their terminal.
#pragma once

#include "commands/points_command.h"
#include "session/reports/points_report.h"
#include "session/work/runner.h"

namespace scarp::cli {

/// Plans, reads the points, simplifies, and checks the promise. `command` is asked which options were given.
Result<void> make_points_mesh(const CLI::App& command, const SimplifyArguments& given, const PointsArguments& arguments,
                              const Runner& runner, SimplifyPlan& plan, PointsOutcome& outcome);
/// Closes the mesh into a solid where that was asked for, and writes into it who made it and where it lies.
Result<void> complete_mesh(const SimplifyPlan& plan, const PointsArguments& arguments, PointsOutcome& outcome);

/// Reads the mesh and the points, and judges the one by the other.
Result<void> judge_points(const CLI::App& command, const MeasurePointsArguments& given,
                          const PointsArguments& arguments, const Runner& runner, JudgedPoints& judged);

}  // namespace scarp::cli
