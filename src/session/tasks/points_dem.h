// The surface of scattered points as a raster.
#pragma once

#include <cstdint>
#include <vector>

#include "scarp/result.h"
#include "session/reports/points_report.h"

namespace scarp::cli {

/// Fails with kUsage unless --cell-size is given exactly where OUTPUT is a raster.
Result<void> check_cell_size(const SimplifyPlan& plan, const GivenOptions& given);

/// Encodes the mesh's heights at the centres of cells of --cell-size, whose corners are multiples of it; nodata beyond
/// the mesh. REQUIRES: the mesh is where the points are. Fails with kUsage for more cells than a raster may have.
Result<std::vector<std::uint8_t>> encode_points_dem(const SimplifyPlan& plan, const PointsOutcome& outcome);

}  // namespace scarp::cli
