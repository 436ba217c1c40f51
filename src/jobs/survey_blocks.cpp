// Determines the fraction of each block that has heights.
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/parallel.h"
#include "base/reporter.h"
#include "scarp/tile.h"
#include "scarp/tile_job.h"

namespace scarp {
namespace {

/// Rows of nodes that are read together.
constexpr int kSurveyRows = 64;

Result<std::uint32_t> survey_block(const PyramidPlan& plan, TileId block, const NodeSource& nodes) {
  const NodeWindow window = plan.grid.window_of(block, plan.cells << (plan.max_zoom() - block.z));
  std::vector<float> heights;
  std::uint64_t count = 0;
  for (int first = 0; first < window.rows; first += kSurveyRows) {
    NodeWindow band = window;
    band.row += first;
    band.rows = std::min(kSurveyRows, window.rows - first);
    heights.resize(static_cast<std::size_t>(band.cols) * static_cast<std::size_t>(band.rows));
    SCARP_RETURN_IF_ERROR(nodes.read(band, heights));
    count += static_cast<std::uint64_t>(
        std::count_if(heights.begin(), heights.end(), [](float height) { return !std::isnan(height); }));
  }
  const std::uint64_t all = static_cast<std::uint64_t>(window.cols) * static_cast<std::uint64_t>(window.rows);
  return static_cast<std::uint32_t>(1 + (1000 * count + all - 1) / all);
}

}  // namespace

Result<void> survey_blocks(TileJob& job, const NodeSource& nodes, const Run& run) {
  const std::vector<TileId> blocks = find_blocks(job.plan);
  std::vector<std::uint32_t> costs(blocks.size(), 1);
  std::vector<Result<std::uint32_t>> found(blocks.size(), 1u);
  Result<void> result;
  Reporter reporter(run.progress);
  parallel_in_order(
      blocks.size(), run.threads,
      [&](std::size_t k, std::size_t) {
        // Blocks outside the sources are not read.
        if (block_cost(job.plan, blocks[k]) > 1) found[k] = survey_block(job.plan, blocks[k], nodes);
      },
      [&](std::size_t k) {
        const double share = static_cast<double>(k) / static_cast<double>(blocks.size());
        if (!found[k])
          result = tl::unexpected(found[k].error());
        else if (reporter.due() && !reporter.report("survey", share, 0, 0))
          result = fail(ErrorKind::kCancelled, "cancelled");
        else
          costs[k] = *found[k];
        return result.has_value();
      });
  SCARP_RETURN_IF_ERROR(result);
  job.costs = std::move(costs);
  return {};
}

}  // namespace scarp
