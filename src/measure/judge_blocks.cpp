#include "measure/judge_blocks.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/caught.h"
#include "measure/hull_gaps.h"
#include "measure/point_judge.h"
#include "scarp/points.h"

namespace scarp::judge {

Result<void> visit_blocks(const PointBlocks& blocks, std::string_view pass, const ProgressCallback& progress,
                          const std::function<Result<void>(const PointSet&)>& visit) {
  for (std::size_t i = 0; i < blocks.block_count(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(blocks.block_count());
    if (progress && !progress({pass, share, 0, 0}))
      return fail(ErrorKind::kCancelled, "cancelled while reading the points");
    SCARP_TRY(const PointSet& block, blocks.read(i));
    if (block.size() == 0) continue;
    SCARP_RETURN_IF_ERROR(visit(block));
  }
  return {};
}

Result<std::optional<PointSet>> judge_blocks(
    const PointBlocks& blocks, const Mesh& mesh, double tolerance, const MeasureOptions& options,
    const std::function<Result<void>(const PointSet&, const std::vector<double>&)>& see, Measurement& result) {
  MeasureOptions silent = options;
  silent.run.progress = {};
  ErrorTally tally;
  std::optional<PointSet> worst;
  result.uncovered = 0;
  SCARP_RETURN_IF_ERROR(
      visit_blocks(blocks, "measure", options.run.progress, [&](const PointSet& block) -> Result<void> {
        SCARP_TRY(const auto& errors, judge_block(block, mesh, tolerance, silent));
        result.uncovered += static_cast<std::uint64_t>(
            std::count_if(errors.begin(), errors.end(), [](double error) { return std::isnan(error); }));
        if (const auto at = tally.add(errors)) {
          worst.emplace();
          worst->x = {block.x[*at]};
          worst->y = {block.y[*at]};
          worst->z = {block.z[*at]};
        }
        return see(block, errors);
      }));
  tally.finish(result);
  return worst;
}

namespace {

/// The corners of the hulls of all blocks.
Result<PointSet> find_outline(const PointBlocks& blocks, const ProgressCallback& progress) {
  PointSet outline;
  SCARP_RETURN_IF_ERROR(visit_blocks(blocks, "topology", progress, [&](const PointSet& block) -> Result<void> {
    return append_points(hull_corners(block), outline);
  }));
  return outline;
}

double size_of(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return *most - *least;
}

/// Without the triangles that face down: the walls and the underside of a solid.
Mesh top_of(const Mesh& mesh) {
  Mesh top;
  top.origin = mesh.origin;
  top.positions = mesh.positions;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const std::uint32_t* const corners = &mesh.triangles[3 * t];
    const double *a = &mesh.positions[3 * std::size_t{corners[0]}], *b = &mesh.positions[3 * std::size_t{corners[1]}],
                 *c = &mesh.positions[3 * std::size_t{corners[2]}];
    if ((b[0] - a[0]) * (c[1] - a[1]) > (b[1] - a[1]) * (c[0] - a[0]))
      top.triangles.insert(top.triangles.end(), corners, corners + 3);
  }
  return top;
}

}  // namespace

}  // namespace scarp::judge

namespace scarp {

Result<MeasuredBlocks> measure_points(const PointBlocks& blocks, const Mesh& mesh, const MeasureOptions& options) try {
  if (!options.tolerance.empty() || options.tolerance_source != nullptr || options.cutline != nullptr ||
      options.collect_above || options.on_row)
    return fail(ErrorKind::kUsage, "points in blocks are judged without tolerances, cutline, offenders and rows");
  if (blocks.size() == 0) return fail(ErrorKind::kInput, "there are no points");
  SCARP_TRY(const auto& outline, judge::find_outline(blocks, options.run.progress));
  const double tolerance =
      options.coverage_tolerance *
      std::sqrt(judge::size_of(outline.x) * judge::size_of(outline.y) / static_cast<double>(blocks.size()));
  MeasureOptions of_outline = options;
  of_outline.coverage_tolerance *= std::sqrt(static_cast<double>(outline.size()) / static_cast<double>(blocks.size()));
  MeasuredBlocks result;
  SCARP_TRY(result.measured, measure_points(outline, mesh, DuplicatePolicy::kFirst, of_outline));
  SCARP_TRY(auto&& worst,
            judge::judge_blocks(
                blocks, result.measured.closed ? judge::top_of(mesh) : mesh, tolerance, options,
                [](const PointSet&, const std::vector<double>&) -> Result<void> { return {}; }, result.measured));
  result.measured.max_error_at = {worst ? 0 : -1, worst ? 0 : -1};
  if (worst) result.worst = std::move(*worst);
  return result;
} catch (...) {
  return caught(ErrorKind::kInput, "measure the mesh");
}

}  // namespace scarp
