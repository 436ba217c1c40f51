// The door: options are checked, an effort and an order chosen, lines made ready; orders.h does the rest.
#include "scarp/simplify.h"

#include <fmt/format.h>

#include <cmath>
#include <exception>
#include <new>
#include <optional>
#include <utility>
#include <vector>

#include "grid/raster.h"
#include "grid/samples.h"
#include "grid/source_failure.h"
#include "pieces/effort.h"
#include "pieces/goals.h"
#include "pieces/plan.h"
#include "simplify/checks.h"
#include "simplify/error_search.h"
#include "simplify/line_budget.h"
#include "simplify/line_work.h"
#include "simplify/orders.h"

namespace scarp {

namespace {

Result<void> check_options(const HeightField& field, const SimplifyOptions& options) {
  if (auto goals = check_goals(options); !goals) return goals;
  if (!(options.domain.outline_tolerance >= 0 && std::isfinite(options.domain.outline_tolerance)))
    return fail(ErrorKind::kUsage, fmt::format("outline_tolerance must be a finite number of at least 0, not {}",
                                               options.domain.outline_tolerance));
  if (options.goals.max_error && *options.goals.max_error < field.sample_rounding)
    return fail(
        ErrorKind::kPromise,
        fmt::format(
            "a max error of {} cannot be kept: the raster's values do not fit float32 and are rounded by up to {}; "
            "ask for at least that much",
            *options.goals.max_error, field.sample_rounding));
  return {};
}

/// Without a search for the error of a budget. `lines`: to be inserted, prepared or such as may wait; null: none.
Result<Simplified> simplify_once(const HeightField& field, const SimplifyOptions& options, LineWork* lines) {
  if (auto sound = check_options(field, options); !sound) return tl::unexpected(sound.error());
  if (auto sound = check_size(field); !sound) return tl::unexpected(sound.error());
  const auto run = may_be_dominant(field, options) ? run_by_tiles : run_greedily;
  const Plan plan(field, options);
  auto result = run(plan, lines);
  if (result || result.error().kind != ErrorKind::kPromise || options.quality.vertices != Vertices::kAuto)
    return result;
  if (!plan.frees_vertices) return result;
  SimplifyOptions on_samples = options;
  on_samples.quality.vertices = Vertices::kSamples;
  return run(Plan(field, on_samples), lines);
}

/// Soft lines follow the raster to within this share of the max error.
constexpr double kLineShare = 0.5;

/// Towards a max error.
Result<Simplified> simplify_with_lines(const HeightField& field, const SimplifyOptions& asked) {
  if (auto sound = check_size(field); !sound) return tl::unexpected(sound.error());
  const auto start = Clock::now();
  SimplifyOptions options = asked;
  if (asked.features.breaklines_for) {
    auto lines = asked.features.breaklines_for(*asked.goals.max_error);
    if (!lines) return tl::unexpected(lines.error());
    options.features.breaklines = std::move(*lines);
    if (auto sound = check_conflicts(field, options); !sound) return tl::unexpected(sound.error());
  }
  options.run.memory.taken += line_bytes(field, options.features.breaklines) +
                              line_bytes(field, options.features.cutline.rings, options.features.cutline.affine);
  if (auto fits = memory_budget(field, options).check_start(0); !fits) return tl::unexpected(fits.error());
  LineWork work(field, options, kLineShare * *options.goals.max_error);
  const double seconds = seconds_since(start);
  if (!work.may_wait()) {
    if (auto prepared = work.prepare(); !prepared) return tl::unexpected(prepared.error());
  }
  auto result = simplify_once(work.field(), options, &work);
  if (!result) return result;
  FieldLines* const lines = &work.lines();
  result->passes.insert(result->passes.begin(), Pass{"arrange", seconds + work.seconds()});
  result->edits = std::move(lines->edits);
  result->lines_laid = lines->laid;
  result->lines_for = *options.goals.max_error;
  const Measurement& measured = result->measurement;
  // Where the field has a source, what lies beyond a cut is void to refinement only.
  const std::uint64_t valid = lines->valid > 0 ? lines->valid : measured.heights.valid;
  if (lines->graph.cut) result->cut_off = valid - measured.samples - measured.uncovered - measured.stray;
  return result;
}

/// With the budgets there are, where insertion does not stop at them: lines are what they are for one error, and rows
/// of tiles are refined one after the other.
Result<Simplified> simplify_within(const HeightField& field, const SimplifyOptions& options) {
  constexpr double kNearlyFull = 0.97;
  const auto run_once = [&](const SimplifyOptions& once) {
    return has_lines(once) ? simplify_with_lines(field, once) : simplify_once(field, once, nullptr);
  };
  if (!has_budget(options)) return run_once(options);
  bool has_mesh = false;
  std::optional<Error> no_room;
  const RunOnce towards_error = [&](const SimplifyOptions& once) {
    auto made = run_once(once);
    // Slivers of a cutline may vanish at one error and not at another. What was possible once goes on.
    if (!made && has_mesh && made.error().kind == ErrorKind::kInput) made.error().kind = ErrorKind::kPromise;
    // A mesh that takes too much memory may be one that exceeds the budget, too.
    if (!made && has_mesh && made.error().kind == ErrorKind::kUsage) {
      no_room = made.error();
      made.error().kind = ErrorKind::kPromise;
    }
    has_mesh = has_mesh || made.has_value();
    return made;
  };
  const double most = largest_line_error(field, options);
  const RunOnce run = [&](const SimplifyOptions& once) {
    return has_budget(once) ? search_line_error(once, most, towards_error) : towards_error(once);
  };
  auto made = options.quality.effort == Effort::kFast ? run(options) : search_error(options, run);
  if (!made || !no_room || made->stop == StopReason::kMaxError || made->stop == StopReason::kExact) return made;
  const double used = Budget(options).used({made->mesh.vertex_count(), made->mesh.triangle_count()});
  if (used < kNearlyFull) return tl::unexpected(*no_room);
  return made;
}

}  // namespace

Result<Simplified> simplify(const HeightField& field, const SimplifyOptions& asked) try {
  for (const auto check : {check_options, check_conflicts, check_needs}) {
    if (auto sound = check(field, asked); !sound) return tl::unexpected(sound.error());
  }
  SimplifyOptions options = asked;
  options.quality.effort = choose_effort(field, asked);
  const bool inserts_towards_error =
      field.samples == nullptr || options.quality.order == Order::kDominant || options.quality.shape.any();
  if (has_lines(options) || (inserts_towards_error && has_budget(options))) return simplify_within(field, options);
  if (options.quality.effort == Effort::kFast || !has_budget(options)) return simplify_once(field, options, nullptr);
  const auto run = [&](const SimplifyOptions& once) { return simplify_once(field, once, nullptr); };
  if (has_norm(field)) options.quality.vertices = Vertices::kSamples;
  if (!options.tolerances.weights.empty()) return search_error(options, run, Judged::kWeighted);
  return search_error(options, run, has_norm(field) ? Judged::kNorm : Judged::kHeights);
} catch (const SourceFailure& failure) {
  return tl::unexpected(failure.error);
} catch (const std::bad_alloc&) {
  return fail(ErrorKind::kInput, "not enough memory for this raster and goal: allow a larger error or fewer triangles");
} catch (const std::exception& e) {
  return fail(ErrorKind::kInternal, fmt::format("an exception while simplifying: {}", e.what()));
}

Result<Simplified> simplify(const HeightField& field, const Goals& goals) {
  SimplifyOptions options;
  options.goals = goals;
  return simplify(field, options);
}

}  // namespace scarp
