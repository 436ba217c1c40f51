#include "simplify/once.h"

#include <utility>

#include "grid/samples.h"
#include "pieces/effort.h"
#include "pieces/goals.h"
#include "scarp/features.h"
#include "simplify/checks.h"
#include "simplify/line_work.h"
#include "simplify/orders.h"

namespace scarp {

namespace {

/// Soft lines follow the raster to within this share of the error that they are inserted for.
constexpr double kLineShare = 0.5;

/// `lines`: to be inserted, prepared or such as may wait; null: none.
Result<Simplified> simplify_in_order(const HeightField& field, const Request& options, const Scale& scale,
                                     LineWork* lines) {
  SCARP_RETURN_IF_ERROR(check_values(field, options));
  SCARP_RETURN_IF_ERROR(check_size(field));
  const auto run = [&](const Plan& plan) {
    if (plan.options.domain.border.is_locked) return run_locked(plan, lines);
    return may_be_dominant(field, options) ? run_by_tiles(plan, lines) : run_greedily(plan, lines);
  };
  const Plan plan(field, options, scale);
  auto result = run(plan);
  if (result || result.error().kind != ErrorKind::kPromise || options.quality.vertices != Vertices::kAuto)
    return result;
  if (!plan.frees_vertices) return result;
  Request on_samples = options;
  on_samples.quality.vertices = Vertices::kSamples;
  return run(Plan(field, on_samples, scale));
}

/// Towards the error `error`, with the lines of `options`.
Result<Simplified> simplify_with_lines(const HeightField& field, Request& options, double error, const Scale& scale,
                                       double seconds) {
  options.run.memory.taken += line_bytes(field, options.features.breaklines) +
                              line_bytes(field, options.features.cutline.rings, options.features.cutline.affine);
  SCARP_RETURN_IF_ERROR(memory_budget(field, options).check_start(0));
  LineWork work(field, options, kLineShare * error);
  if (!work.may_wait()) {
    SCARP_RETURN_IF_ERROR(work.prepare());
  }
  SCARP_TRY(auto&& result, simplify_in_order(work.field(), options, scale, &work));
  FieldLines* const lines = &work.lines();
  result.passes.insert(result.passes.begin(), Pass{"arrange", seconds + work.seconds()});
  result.edits = std::move(lines->edits);
  result.lines_inserted = lines->inserted;
  result.farthest_line = std::move(lines->farthest);
  const Measurement& measured = result.measurement;
  // If the field has a source, samples beyond a cut are nodata to refinement only.
  const std::uint64_t valid = lines->valid > 0 ? lines->valid : measured.heights.valid;
  if (lines->graph.cut) result.cut_off = valid - measured.samples - measured.uncovered - measured.stray;
  return result;
}

Result<Simplified> simplify_with_features(const HeightField& field, const Request& asked, const Scale& scale) {
  SCARP_RETURN_IF_ERROR(check_size(field));
  const auto start = Clock::now();
  const double error = asked.goals.max_error.value_or(scale.line_error);
  SCARP_TRY(auto&& fitted, fit_features(field, asked.features, {error, asked.run}));
  Request options = asked;
  options.features = {.breaklines = fitted.lines, .points = asked.features.points, .cutline = asked.features.cutline};
  // No wall and no ridge may be found.
  SCARP_TRY(auto&& result, has_lines(options) ? simplify_with_lines(field, options, error, scale, seconds_since(start))
                                              : simplify_in_order(field, options, scale, nullptr));
  result.features = std::move(fitted);
  result.lines_for = error;
  return result;
}

}  // namespace

bool insertion_stops(const HeightField& field, const SimplifyOptions& options) {
  return field.samples != nullptr && options.quality.order != Order::kDominant && !options.quality.shape.any() &&
         !has_lines(options);
}

Result<Simplified> simplify_once(const HeightField& field, const Request& options, const Scale& scale) {
  return has_lines(options) ? simplify_with_features(field, options, scale)
                            : simplify_in_order(field, options, scale, nullptr);
}

}  // namespace scarp
