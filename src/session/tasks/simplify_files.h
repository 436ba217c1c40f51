// The files of a run of `scarp simplify`, encoded and ready to be written.
#pragma once

#include <vector>

#include "scarp/io.h"
#include "session/plan/simplify_plan.h"
#include "session/reports/simplify_outcome.h"
#include "session/reports/simplify_run.h"

namespace scarp::cli {

/// Compression, and the images that a GLB file holds.
Result<GlbOptions> glb_options(const SimplifyPlan& plan, const Outcome& outcome);
/// Closes the mesh into a solid where that was asked for, and writes into it who made it and where it lies.
Result<void> complete_mesh(const SimplifyPlan& plan, Outcome& outcome);

/// Every file but the report, OUTPUT first. Closes the mesh into a solid where that was asked for. The field's samples
/// are given back before OUTPUT is encoded, unless it is made from them.
Result<std::vector<ReadyFile>> encode_files(const SimplifyPlan& plan, const ProgressCallback& progress,
                                            Outcome& outcome);

}  // namespace scarp::cli
