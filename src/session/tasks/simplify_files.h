// Encodes the files of `scarp simplify`, ready to be written.
#pragma once

#include <vector>

#include "scarp/io.h"
#include "session/plan/simplify_plan.h"
#include "session/reports/simplify_outcome.h"
#include "session/reports/simplify_run.h"

namespace scarp::cli {

/// Compression and images of a GLB file.
Result<GlbOptions> glb_options(const SimplifyPlan& plan, const Outcome& outcome);
/// Closes the mesh into a solid on request, and records its origin and place.
Result<void> complete_mesh(const SimplifyPlan& plan, Outcome& outcome);

/// Encodes all files except the report, OUTPUT first, after closing the mesh into a solid on request. Releases the
/// field's samples before encoding OUTPUT unless that needs them.
Result<std::vector<ReadyFile>> encode_files(const SimplifyPlan& plan, const ProgressCallback& progress,
                                            Outcome& outcome);

}  // namespace scarp::cli
