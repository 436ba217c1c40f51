// The files of `scarp simplify` on scattered points, ready to be written.
#pragma once

#include <string>
#include <vector>

#include "scarp/measure.h"
#include "session/reports/points_report.h"
#include "session/tasks/runner.h"

namespace scarp::cli {

/// Fails with kUsage for --cell-size without a raster as OUTPUT.
Result<void> check_cell_size(const SimplifyPlan& plan, const GivenOptions& given);
/// The default of --cell-size: the mean distance of neighbouring points, rounded down to 1, 2 or 5 times a power of 10.
double find_cell_size(const PointsOutcome& outcome);
/// The mesh's heights at the centres of cells, whose corners are multiples of `size`; NaN outside the mesh. REQUIRES:
/// the mesh is where the points are. Fails with kUsage for more cells than a raster may have.
Result<OwnedHeightField> draw_raster(const PointsOutcome& outcome, double size, int threads);

/// Encodes all files except the report, OUTPUT first, after closing the mesh into a solid on request.
Result<std::vector<ReadyFile>> encode_files(const SimplifyPlan& plan, const Runner& runner, PointsOutcome& outcome);

/// The table of --error-raster: x, y, z and error of each point; omitted duplicates have no error. Sets
/// MeasureOptions::on_row, which fills `file`. Borrows `points` and `file`.
void collect_errors(const PointSet& points, std::vector<std::uint8_t>& file, MeasureOptions& options);

}  // namespace scarp::cli
