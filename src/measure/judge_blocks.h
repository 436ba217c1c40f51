// Judging a mesh at points in blocks.
#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "scarp/measure.h"
#include "scarp/mesh.h"
#include "scarp/point_blocks.h"
#include "scarp/result.h"
#include "scarp/run.h"

namespace scarp::judge {

/// Reads all blocks that have points. Fails with kCancelled, and with the errors of read() and visit().
Result<void> visit_blocks(const PointBlocks& blocks, std::string_view pass, const ProgressCallback& progress,
                          const std::function<Result<void>(const PointSet&)>& visit);

/// The errors at the points of a block, NaN for uncovered points. Errors near `options.collect_above` are exact.
/// `tolerance`: the largest distance from the mesh of a covered point. Fails with kCancelled. REQUIRES: a mesh that
/// check_mesh() accepts, with all triangles facing up.
Result<std::vector<double>> judge_block(const PointSet& block, const Mesh& mesh, double tolerance,
                                        const MeasureOptions& options);

/// Judges a mesh at all points, and sets the statistics of their errors. `see`: called with each block and its errors.
/// Returns the point with the largest error; none if no point is covered.
Result<std::optional<PointSet>> judge_blocks(
    const PointBlocks& blocks, const Mesh& mesh, double tolerance, const MeasureOptions& options,
    const std::function<Result<void>(const PointSet&, const std::vector<double>&)>& see, Measurement& result);

}  // namespace scarp::judge
