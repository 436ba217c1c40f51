// The files of `scarp simplify` on scattered points, ready to be written.
#pragma once

#include <string>
#include <vector>

#include "scarp/measure.h"
#include "session/reports/points_report.h"
#include "session/tasks/runner.h"

namespace scarp::cli {

/// Fails with kUsage for --cell-size without a raster as OUTPUT, and for such a raster without it.
Result<void> check_cell_size(const SimplifyPlan& plan, const GivenOptions& given);

/// Encodes all files except the report, OUTPUT first, after closing the mesh into a solid on request.
Result<std::vector<ReadyFile>> encode_files(const SimplifyPlan& plan, const Runner& runner, PointsOutcome& outcome);

/// The table of --error-raster: x, y, z and error of each point; omitted duplicates have no error. Sets
/// MeasureOptions::on_row, which fills `file`. Borrows `points` and `file`.
void collect_errors(const PointSet& points, std::vector<std::uint8_t>& file, MeasureOptions& options);

}  // namespace scarp::cli
