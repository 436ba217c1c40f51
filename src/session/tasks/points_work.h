// simplify and measure of points without their terminal.
#pragma once

#include "session/options/points_options.h"
#include "session/plan/simplify_plan.h"
#include "session/reports/points_report.h"
#include "session/tasks/runner.h"

namespace scarp::cli {

/// Plans, reads the points, simplifies, and checks the promise.
Result<void> make_points_mesh(const GivenOptions& given, const Runner& runner, SimplifyPlan& plan,
                              PointsOutcome& outcome);
/// Moves the mesh into its frame, and records its origin and place.
void place_mesh(const SimplifyPlan& plan, PointsOutcome& outcome);
/// Closes the mesh into a solid on request, then places it.
Result<void> complete_mesh(const SimplifyPlan& plan, PointsOutcome& outcome);

/// Reads the mesh and the points, and judges the mesh.
Result<void> judge_points(const GivenOptions& given, const Runner& runner, JudgedPoints& judged);

}  // namespace scarp::cli
