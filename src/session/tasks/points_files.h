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
/// The surface as a raster of cells of --cell-size, by default the mean distance of neighbouring points. Sets the
/// outcome's cell size. REQUIRES: the mesh is where the points are. Fails with kUsage for too many cells, and if no
/// cell has a height.
Result<OwnedHeightField> draw_surface(const SimplifyPlan& plan, PointsOutcome& outcome);

/// Encodes all files except the report, OUTPUT first, after closing the mesh into a solid on request.
Result<std::vector<ReadyFile>> encode_files(const SimplifyPlan& plan, const Runner& runner, PointsOutcome& outcome);

/// The table of --error-raster: x, y, z and error of each point; omitted duplicates have no error. Sets
/// MeasureOptions::on_row, which fills `file`. Borrows `points` and `file`.
void collect_errors(const PointSet& points, std::vector<std::uint8_t>& file, MeasureOptions& options);

}  // namespace scarp::cli
