#include "simplify/run.h"

#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "base/parallel.h"
#include "base/reporter.h"
#include "grid/samples.h"
#include "grid/sources/cut_source.h"
#include "metric/criterion.h"
#include "pieces/locked_border.h"
#include "pieces/strips.h"
#include "pieces/tile_worker.h"
#include "pieces/tiled.h"
#include "scarp/features.h"
#include "simplify/line_work.h"
#include "simplify/mesh_passes.h"
#include "simplify/pass_work.h"
#include "simplify/proof.h"

namespace scarp::run {

namespace {

/// Soft lines follow the raster to within this share of the error for which they are inserted.
constexpr double kLineShare = 0.5;

Result<metric::Criterion> make_criterion(const pieces::Recipe& recipe, const grid::Raster& raster) {
  return metric::Criterion::make(recipe.field, recipe.options, raster, recipe.aim * recipe.scale.start,
                                 recipe.scale.factor);
}

const lines::ConstraintGraph* graph_of(const LineWork* lines) { return lines != nullptr ? &lines->graph() : nullptr; }

Result<std::optional<pieces::Tiled>> refine_tiles(const pieces::Recipe& recipe, const grid::Raster& raster,
                                                  const metric::Criterion& criterion,
                                                  const lines::ConstraintGraph* lines, pieces::StripTotals& strips) {
  const HeightField& field = recipe.field;
  const SimplifyOptions& options = recipe.options;
  pieces::TiledOptions tiles;
  tiles.threshold = recipe.is_streamed ? criterion.aim() : criterion.largest_aim();
  tiles.threads = options.run.threads;
  tiles.memory = recipe.memory;
  // If bounds differ, tiles are made for the largest only.
  tiles.may_decline = !recipe.is_streamed && (options.quality.order == Order::kAuto || !criterion.bounds().empty());
  Reporter reporter(options.run.progress);
  if (options.run.progress) {
    if (!reporter.report("refine", 0, 0, 0)) return fail(ErrorKind::kCancelled, "cancelled while refining");
    tiles.progress = [&](double share, std::uint64_t vertices) {
      return !reporter.due() || reporter.report("refine", share, vertices, 0);
    };
  }
  const double threshold = criterion.bound() ? criterion.aim() : recipe.aim * recipe.scale.line_error;
  if (recipe.finishes_strips)
    pieces::work_by_strips(recipe, lines, criterion.source_bounds(), threshold, strips, tiles);
  HeightField seen = field;
  if (field.frame.space) seen.samples = raster.samples;
  if (!recipe.is_streamed || lines == nullptr || !lines->cut) return pieces::refine_tiled(seen, tiles);
  const grid::CutSource near(*field.source, lines->cut->rows);
  seen.source = &near;
  return pieces::refine_tiled(seen, tiles);
}

/// Calls refine_tiles() and prepares lines in parallel.
Result<std::optional<pieces::Tiled>> refine_beside_lines(const pieces::Recipe& recipe, const grid::Raster& raster,
                                                         const metric::Criterion& criterion, LineWork* lines,
                                                         pieces::StripTotals& strips) {
  if (lines == nullptr || lines->is_prepared()) return refine_tiles(recipe, raster, criterion, graph_of(lines), strips);
  Result<void> prepared;
  Result<std::optional<pieces::Tiled>> tiled;
  run_beside(
      recipe.options.run.threads, [&] { prepared = lines->prepare(); },
      [&] { tiled = refine_tiles(recipe, raster, criterion, nullptr, strips); });
  SCARP_RETURN_IF_ERROR(prepared);
  return tiled;
}

/// The passes of tiles and strips, `seconds` in all.
std::vector<Pass> list_passes(const pieces::Recipe& recipe, const Work& tiles, const pieces::StripTotals& strips,
                              bool has_lines, double seconds) {
  const double beside = strips.seconds_of_fit + strips.seconds_of_lines + strips.seconds_of_refinement;
  std::vector<Pass> passes{pass_of("tiles", seconds - beside, tiles)};
  if (recipe.finishes_strips && has_lines) passes.push_back(pass_of("lines", strips.seconds_of_lines, strips.lines));
  if (strips.seconds_of_refinement > 0)
    passes.push_back(pass_of("refine", strips.seconds_of_refinement, strips.refinement));
  if (recipe.fits_strips) passes.push_back({"fit", strips.seconds_of_fit, 0, 0, 0, strips.removed});
  return passes;
}

/// Algorithm III over the whole raster. REQUIRES: samples in memory.
Result<Simplified> run_greedily(const pieces::Recipe& recipe, LineWork* lines) {
  if (lines != nullptr) {
    SCARP_RETURN_IF_ERROR(lines->prepare());
  }
  SCARP_TRY(auto&& samples, grid::Samples::to_refine(recipe.field, recipe.options.run.threads));
  const grid::Raster raster = samples.raster();
  SCARP_TRY(const auto& criterion, make_criterion(recipe, raster));
  return run_passes(recipe, raster, criterion, graph_of(lines), std::nullopt);
}

/// Runs by tiles, or greedily if heights or a coarse goal make tiles useless.
Result<Simplified> run_by_tiles(const pieces::Recipe& recipe, LineWork* lines) {
  const HeightField& field = recipe.field;
  // The engine accepts nodata; all other code that reads samples outside the mesh needs clean ones.
  grid::Raster raster{field.samples, field.cols, field.rows};
  std::optional<grid::Samples> samples;
  if (!recipe.is_streamed && recipe.reads_beyond) {
    SCARP_TRY(auto&& cleaned, grid::Samples::to_refine(field, recipe.options.run.threads));
    raster = samples.emplace(std::move(cleaned)).raster();
  }
  SCARP_TRY(const auto& criterion, make_criterion(recipe, raster));
  if (!recipe.is_streamed && std::isinf(criterion.largest_aim())) return run_greedily(recipe, lines);
  const std::uint64_t bytes = proof_bytes(recipe);
  SCARP_RETURN_IF_ERROR(recipe.memory.check_start(bytes));
  const auto start = Clock::now();
  pieces::StripTotals strips;
  SCARP_TRY(auto&& tiled, refine_beside_lines(recipe, raster, criterion, lines, strips));
  if (!tiled) {
    if (recipe.is_streamed)
      return fail(ErrorKind::kInput,
                  "heights of such different magnitudes can only be refined in memory: read the raster as a whole");
    return run_greedily(recipe, lines);
  }
  const refine::DomainMesh& domain = tiled->domain;
  SCARP_RETURN_IF_ERROR(recipe.memory.check_mesh(bytes, domain.tin.vertex_count() - domain.unused, 1));
  const double seconds = seconds_since(start);
  const std::vector<Pass> passes = list_passes(recipe, tiled->work, strips, lines != nullptr, seconds);
  pieces::add(tiled->work, strips.refinement);
  const lines::ConstraintGraph* left = recipe.finishes_strips ? nullptr : graph_of(lines);
  SCARP_TRY(auto&& result, run_passes(recipe, raster, criterion, left, std::move(tiled)));
  result.passes.insert(result.passes.begin(), passes.begin(), passes.end());
  result.seconds_refine += seconds;
  result.is_cut_short = result.is_cut_short || strips.is_cut_short;
  return result;
}

/// Runs with the border first. REQUIRES: samples in memory.
Result<Simplified> run_locked(const pieces::Recipe& recipe, LineWork* lines) {
  if (lines != nullptr) {
    SCARP_RETURN_IF_ERROR(lines->prepare());
  }
  const SimplifyOptions& options = recipe.options;
  SCARP_TRY(const auto& samples, grid::Samples::to_refine(recipe.field, options.run.threads));
  // The border's line needs valid tolerances.
  SCARP_RETURN_IF_ERROR(make_criterion(recipe, samples.raster()));
  SCARP_TRY(const auto& border, pieces::LockedBorder::make(recipe.field, options, samples.raster()));
  if (lines != nullptr) {
    SCARP_RETURN_IF_ERROR(border.check(lines->graph().points, grid::kLatticeSteps));
  }
  const grid::Raster raster = border.raster();
  const pieces::Recipe inside = recipe.on(border.with_channels(recipe.field));
  SCARP_TRY(const auto& criterion, make_criterion(inside, raster));
  const auto start = Clock::now();
  std::optional<pieces::Tiled> tiled;
  if (lines == nullptr && recipe.is_dominant && !std::isinf(criterion.largest_aim())) {
    std::vector<Point> points;
    for (const auto& [col, row] : options.features.points) points.push_back({col, row});
    pieces::TiledOptions alone;
    alone.threshold = criterion.largest_aim();
    alone.memory = recipe.memory;
    if (options.run.progress && !Reporter(options.run.progress).report("refine", 0, 0, 0))
      return fail(ErrorKind::kCancelled, "cancelled while refining");
    SCARP_TRY(tiled, pieces::refine_alone(raster, border.vertices(), points, alone));
  }
  const double seconds = seconds_since(start);
  const auto pass = tiled ? std::optional(pass_of("tiles", seconds, tiled->work)) : std::nullopt;
  auto result = run_passes(recipe, raster, criterion, graph_of(lines), std::move(tiled), border.vertices());
  if (!result || !pass) return result;
  result->passes.insert(result->passes.begin(), *pass);
  result->seconds_refine += seconds;
  return result;
}

Result<Simplified> run_along(const pieces::Recipe& recipe, LineWork* lines) {
  switch (recipe.route) {
    case pieces::Route::kLocked:
      return run_locked(recipe, lines);
    case pieces::Route::kTiles:
      return run_by_tiles(recipe, lines);
    case pieces::Route::kGreedy:
      break;
  }
  return run_greedily(recipe, lines);
}

/// `lines`: lines to insert, which are prepared or may wait; null: none. If free vertices break the bound, vertices on
/// samples may satisfy it.
Result<Simplified> run_with_lines(const pieces::Recipe& recipe, LineWork* lines) {
  auto result = run_along(recipe, lines);
  if (result || result.error().kind != ErrorKind::kPromise || !recipe.frees_vertices ||
      recipe.options.quality.vertices != Vertices::kAuto)
    return result;
  metric::Request on_samples = recipe.options;
  on_samples.quality.vertices = Vertices::kSamples;
  return run_along(pieces::Recipe(recipe.field, on_samples, recipe.scale), lines);
}

/// Prepares the lines of the features for the error `error` and runs with them.
Result<Simplified> insert_features(const pieces::Recipe& recipe, double error, double seconds) {
  SCARP_RETURN_IF_ERROR(recipe.memory.check_start(0));
  LineWork work(recipe, kLineShare * error);
  if (!work.may_wait()) {
    SCARP_RETURN_IF_ERROR(work.prepare());
  }
  SCARP_TRY(auto&& result, run_with_lines(recipe.on(work.field()), &work));
  lines::FieldLines* const lines = &work.lines();
  result.passes.insert(result.passes.begin(), Pass{"arrange", seconds + work.seconds()});
  result.edits = std::move(lines->edits);
  result.lines_inserted = lines->inserted;
  result.farthest_line = std::move(lines->farthest);
  const Measurement& measured = result.measurement;
  // If the field has a source, samples outside a cut are nodata only for refinement.
  const std::uint64_t valid = lines->valid > 0 ? lines->valid : measured.heights.valid;
  if (lines->graph.cut) result.cut_off = valid - measured.samples - measured.uncovered - measured.stray;
  return result;
}

Result<Simplified> run_with_features(const pieces::Recipe& recipe) {
  const auto start = Clock::now();
  const metric::Request& asked = recipe.options;
  const double error = asked.goals.max_error.value_or(recipe.scale.line_error);
  SCARP_TRY(auto&& fitted, fit_features(recipe.field, asked.features, {error, asked.run}));
  metric::Request options = asked;
  options.features = {.breaklines = fitted.lines, .points = asked.features.points, .cutline = asked.features.cutline};
  const Features& features = options.features;
  options.run.memory.taken += lines::line_bytes(recipe.field, features.breaklines) +
                              lines::line_bytes(recipe.field, features.cutline.rings, features.cutline.affine);
  const pieces::Recipe found(recipe.field, options, recipe.scale);
  // Perhaps neither walls nor ridges were found.
  SCARP_TRY(auto&& result,
            found.has_lines ? insert_features(found, error, seconds_since(start)) : run_with_lines(found, nullptr));
  result.features = std::move(fitted);
  result.lines_for = error;
  return result;
}

}  // namespace

Result<Simplified> run(const pieces::Recipe& recipe) {
  return recipe.has_lines ? run_with_features(recipe) : run_with_lines(recipe, nullptr);
}

}  // namespace scarp::run
