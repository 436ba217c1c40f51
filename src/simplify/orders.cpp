#include "simplify/orders.h"

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/reporter.h"
#include "grid/samples.h"
#include "grid/sources/cut_source.h"
#include "metric/criterion.h"
#include "pieces/locked_border.h"
#include "pieces/strips.h"
#include "pieces/tile_worker.h"
#include "pieces/tiled.h"
#include "simplify/checks.h"
#include "simplify/pass_work.h"
#include "simplify/proof.h"
#include "simplify/run.h"

namespace scarp {

namespace {

const ConstraintGraph* graph_of(const LineWork* lines) { return lines != nullptr ? &lines->graph() : nullptr; }

/// `raster`: what is refined of samples in memory.
Result<std::optional<Tiled>> refine_tiles(const Plan& plan, const Raster& raster, const Criterion& criterion,
                                          const ConstraintGraph* lines, StripTotals& strips) {
  const HeightField& field = plan.field;
  const SimplifyOptions& options = plan.options;
  TiledOptions tiles;
  tiles.threshold = plan.is_streamed ? criterion.aim() : criterion.largest_aim();
  tiles.threads = options.run.threads;
  tiles.memory = plan.memory;
  // If bounds differ, tiles are made for the largest only.
  tiles.may_decline = !plan.is_streamed && (options.quality.order == Order::kAuto || !criterion.bounds().empty());
  Reporter reporter(options.run.progress);
  if (options.run.progress) {
    if (!reporter.report("refine", 0, 0, 0)) return fail(ErrorKind::kCancelled, "cancelled while refining");
    tiles.progress = [&](double share, std::uint64_t vertices) {
      return !reporter.due() || reporter.report("refine", share, vertices, 0);
    };
  }
  const double threshold = criterion.bound() ? criterion.aim() : plan.aim * plan.scale.line_error;
  if (plan.finishes_strips) work_by_strips(plan, lines, criterion.source_bounds(), threshold, strips, tiles);
  HeightField seen = field;
  if (field.frame.space) seen.samples = raster.samples;
  if (!plan.is_streamed || lines == nullptr || !lines->cut) return refine_tiled(seen, tiles);
  const CutSource near(*field.source, lines->cut->rows);
  seen.source = &near;
  return refine_tiled(seen, tiles);
}

/// And prepares lines that have waited for this.
Result<std::optional<Tiled>> refine_beside_lines(const Plan& plan, const Raster& raster, const Criterion& criterion,
                                                 LineWork* lines, StripTotals& strips) {
  if (lines == nullptr || lines->is_prepared()) return refine_tiles(plan, raster, criterion, graph_of(lines), strips);
  Result<void> prepared;
  Result<std::optional<Tiled>> tiled;
  run_beside(
      plan.options.run.threads, [&] { prepared = lines->prepare(); },
      [&] { tiled = refine_tiles(plan, raster, criterion, nullptr, strips); });
  SCARP_RETURN_IF_ERROR(prepared);
  return tiled;
}

/// The passes of tiles and strips, `seconds` in all.
std::vector<Pass> list_passes(const Plan& plan, const Work& tiles, const StripTotals& strips, bool has_lines,
                              double seconds) {
  const double beside = strips.seconds_of_fit + strips.seconds_of_lines + strips.seconds_of_refinement;
  std::vector<Pass> passes{pass_of("tiles", seconds - beside, tiles)};
  if (plan.finishes_strips && has_lines) passes.push_back(pass_of("lines", strips.seconds_of_lines, strips.lines));
  if (strips.seconds_of_refinement > 0)
    passes.push_back(pass_of("refine", strips.seconds_of_refinement, strips.refinement));
  if (plan.fits_strips) passes.push_back({"fit", strips.seconds_of_fit, 0, 0, 0, strips.removed});
  return passes;
}

}  // namespace

Result<Simplified> run_by_tiles(const Plan& plan, LineWork* lines) {
  const HeightField& field = plan.field;
  // The engine reads nodata as such; all other code that reads samples beyond the mesh's own needs them cleaned.
  Raster raster{field.samples, field.cols, field.rows};
  std::optional<Samples> samples;
  const bool looks_beyond = plan.options.output.normals || !field.frame.is_affine() || plan.fits || lines != nullptr ||
                            has_own_bounds(field, plan.options);
  if (!plan.is_streamed && looks_beyond) {
    SCARP_TRY(auto&& cleaned, Samples::to_refine(field, plan.options.run.threads));
    raster = samples.emplace(std::move(cleaned)).raster();
  }
  SCARP_TRY(const auto& criterion,
            Criterion::make(field, plan.options, raster, plan.aim * plan.scale.start, plan.scale.factor));
  if (!plan.is_streamed && std::isinf(criterion.largest_aim())) return run_greedily(plan, lines);
  const std::uint64_t bytes = proof_bytes(field, plan.options);
  SCARP_RETURN_IF_ERROR(plan.memory.check_start(bytes));
  const auto start = Clock::now();
  StripTotals strips;
  SCARP_TRY(auto&& tiled, refine_beside_lines(plan, raster, criterion, lines, strips));
  if (!tiled) {
    if (plan.is_streamed)
      return fail(ErrorKind::kInput,
                  "heights of such different magnitudes can only be refined in memory: read the raster as a whole");
    return run_greedily(plan, lines);
  }
  const DomainMesh& domain = tiled->domain;
  SCARP_RETURN_IF_ERROR(plan.memory.check_mesh(bytes, domain.tin.vertex_count() - domain.unused, 1));
  const double seconds = seconds_since(start);
  const std::vector<Pass> passes = list_passes(plan, tiled->work, strips, lines != nullptr, seconds);
  add(tiled->work, strips.refinement);
  const ConstraintGraph* left = plan.finishes_strips ? nullptr : graph_of(lines);
  SCARP_TRY(auto&& result, run_passes(plan, raster, criterion, left, std::move(tiled)));
  result.passes.insert(result.passes.begin(), passes.begin(), passes.end());
  result.seconds_refine += seconds;
  result.is_cut_short = result.is_cut_short || strips.is_cut_short;
  return result;
}

Result<Simplified> run_greedily(const Plan& plan, LineWork* lines) {
  if (lines != nullptr) {
    SCARP_RETURN_IF_ERROR(lines->prepare());
  }
  SCARP_TRY(auto&& samples, Samples::to_refine(plan.field, plan.options.run.threads));
  const Raster raster = samples.raster();
  SCARP_TRY(const auto& criterion,
            Criterion::make(plan.field, plan.options, raster, plan.aim * plan.scale.start, plan.scale.factor));
  return run_passes(plan, raster, criterion, graph_of(lines), std::nullopt);
}

Result<Simplified> run_locked(const Plan& plan, LineWork* lines) {
  if (lines != nullptr) {
    SCARP_RETURN_IF_ERROR(lines->prepare());
  }
  const SimplifyOptions& options = plan.options;
  SCARP_TRY(const auto& samples, Samples::to_refine(plan.field, options.run.threads));
  const auto make_criterion = [&](const Raster& raster) {
    return Criterion::make(plan.field, plan.options, raster, plan.aim * plan.scale.start, plan.scale.factor);
  };
  // The border's line needs tolerances that are sound.
  SCARP_RETURN_IF_ERROR(make_criterion(samples.raster()));
  SCARP_TRY(const auto& border, LockedBorder::make(plan.field, options, samples.raster()));
  if (lines != nullptr) {
    SCARP_RETURN_IF_ERROR(border.check(lines->graph().points, kLatticeSteps));
  }
  const Raster raster = border.raster();
  SCARP_TRY(const auto& criterion, make_criterion(raster));
  const auto start = Clock::now();
  std::optional<Tiled> tiled;
  if (lines == nullptr && may_be_dominant(plan.field, options) && !std::isinf(criterion.largest_aim())) {
    std::vector<Point> inside;
    for (const auto& [col, row] : options.features.points) inside.push_back({col, row});
    TiledOptions alone;
    alone.threshold = criterion.largest_aim();
    alone.memory = plan.memory;
    if (options.run.progress && !Reporter(options.run.progress).report("refine", 0, 0, 0))
      return fail(ErrorKind::kCancelled, "cancelled while refining");
    SCARP_TRY(tiled, refine_alone(raster, border.vertices(), inside, alone));
  }
  const double seconds = seconds_since(start);
  const auto pass = tiled ? std::optional(pass_of("tiles", seconds, tiled->work)) : std::nullopt;
  auto result = run_passes(plan, raster, criterion, graph_of(lines), std::move(tiled), border.vertices());
  if (!result || !pass) return result;
  result->passes.insert(result->passes.begin(), *pass);
  result->seconds_refine += seconds;
  return result;
}

}  // namespace scarp
