// scarp simplify without its terminal: from a plan to a mesh in memory that satisfies the bound.
#pragma once

#include "session/inputs/memory.h"
#include "session/options/given_options.h"
#include "session/plan/simplify_plan.h"
#include "session/reports/simplify_outcome.h"
#include "session/tasks/runner.h"

namespace scarp::cli {

/// Reads the inputs, simplifies, and checks the bound. Warnings go to `plan` and `outcome`.
Result<void> make_mesh(const GivenOptions& given, SimplifyPlan& plan, const Runner& runner, Outcome& outcome);

/// The process's limit, and the bytes in use except those of the mesh; zeros without a limit.
MemoryShare memory_of(const SimplifyPlan& plan, const Outcome& outcome);

}  // namespace scarp::cli
