// The main job: checks, then one mesh (once.h), or, for a budget, a search among several (budget_search.h). Each is
// made by the passes of run.h, the last of which proves it.
#include "scarp/simplify.h"

#include <fmt/format.h>

#include <cstdint>
#include <exception>
#include <new>
#include <utility>

#include "base/function_ref.h"
#include "base/memory_budget.h"
#include "grid/samples.h"
#include "grid/source_failure.h"
#include "pieces/effort.h"
#include "scarp/conflicts.h"
#include "scarp/paper.h"
#include "simplify/budget_search.h"
#include "simplify/budget_task.h"
#include "simplify/checks.h"
#include "simplify/once.h"
#include "simplify/pass_work.h"
#include "simplify/squares_search.h"

namespace scarp {

namespace {

Result<Simplified> simplify_within_budget(const HeightField& field, SimplifyOptions options) {
  SCARP_RETURN_IF_ERROR(check_size(field));
  if (options.quality.effort == Effort::kFast && insertion_stops(field, options)) return simplify_once(field, options);
  if (has_norm(field)) options.quality.vertices = Vertices::kSamples;
  const BudgetTask task = make_budget_task(field, options);
  return lowers_squares(field, options) ? search_squares(options, task) : search_budget(options, task);
}

/// If a budget decides how large the mesh is, the advice is a smaller budget.
Error name_budget(const SimplifyOptions& options, Error error) {
  if (error.kind != ErrorKind::kMemory || !error.message.ends_with(kLargerError)) return error;
  error.message.replace(error.message.size() - kLargerError.size(), kLargerError.size(),
                        options.goals.max_triangles ? "a smaller budget of triangles" : "a smaller budget of vertices");
  return error;
}

/// A mesh with few vertices may need more than another for the angles and lengths that are asked for. So with goals of
/// shape the next lower effort has its try, too.
Result<Simplified> simplify_towards(const HeightField& field, const SimplifyOptions& options) {
  auto made = simplify_once(field, options);
  const Effort effort = options.quality.effort;
  const bool has_lower = effort == Effort::kHigh || effort == Effort::kMax;
  if (!made || made->is_cut_short || !has_lower || !options.quality.shape.any()) return made;
  SimplifyOptions lower = options;
  lower.quality.effort = effort == Effort::kMax ? Effort::kHigh : Effort::kNormal;
  lower.run.memory.taken += kMeshBytesPerVertex * made->mesh.vertex_count();
  auto other = simplify_towards(field, lower);
  if (!other) return other.error().kind == ErrorKind::kCancelled ? std::move(other) : std::move(made);
  if (other->mesh.triangle_count() < made->mesh.triangle_count()) std::swap(*made, *other);
  Pass search{"search", other->seconds_refine + other->seconds_measure};
  add_work(*other, search);
  made->passes.insert(made->passes.begin(), search);
  made->seconds_refine += search.seconds;
  made->effort = effort;
  return made;
}

/// REQUIRES: a chosen effort.
Result<Simplified> make_mesh(const HeightField& field, const SimplifyOptions& options) {
  if (!has_budget(options)) return simplify_towards(field, options);
  auto made = simplify_within_budget(field, options);
  if (!made) return tl::unexpected(name_budget(options, std::move(made.error())));
  return made;
}

/// Simplifies with an effort that was not asked for. Where memory is too little for it, the mesh is refined only. One
/// thread needs least, so that one decides: the mesh must not depend on their number.
Result<Simplified> simplify_by_default(const HeightField& field, SimplifyOptions options) {
  const bool is_fast = options.quality.effort == Effort::kFast;
  WhyFast why = is_fast ? WhyFast::kOrder : WhyFast::kBudget;
  auto made = make_mesh(field, options);
  const auto lacks_memory = [&] { return !made && made.error().kind == ErrorKind::kMemory && !is_fast; };
  if (lacks_memory() && options.run.threads != 1) {
    SimplifyOptions alone = options;
    alone.run.threads = 1;
    made = make_mesh(field, alone);
  }
  if (lacks_memory()) {
    options.quality.effort = Effort::kFast;
    why = WhyFast::kMemory;
    made = make_mesh(field, options);
  }
  if (made && made->effort == Effort::kFast) made->why_fast = why;
  return made;
}

/// Used if no number is asked for: few samples are done before another thread has started.
int choose_threads(const HeightField& field, const SimplifyOptions& options) {
  constexpr std::int64_t kFewSamples = 1 << 14;
  const bool is_short = options.quality.effort == Effort::kFast || options.quality.effort == Effort::kNormal;
  const bool is_small = std::int64_t{field.cols} * field.rows <= kFewSamples;
  return options.run.threads == 0 && is_short && is_small ? 1 : options.run.threads;
}

Result<void> check(const HeightField& field, const SimplifyOptions& options) {
  for (const auto check : {check_values, check_conflicts, check_needs}) {
    SCARP_RETURN_IF_ERROR(check(field, options));
  }
  return {};
}

/// Turns an exception in `work` into an error.
Result<Simplified> without_exceptions(FunctionRef<Result<Simplified>()> work) try {
  return work();
} catch (const SourceFailure& failure) {
  return tl::unexpected(failure.error);
} catch (const std::bad_alloc&) {
  return fail(ErrorKind::kInput, "not enough memory for this raster and goal: allow a larger error or fewer triangles");
} catch (const std::exception& e) {
  return fail(ErrorKind::kInternal, fmt::format("an exception while simplifying: {}", e.what()));
}

}  // namespace

Result<Simplified> simplify(const HeightField& field, const SimplifyOptions& asked) {
  return without_exceptions([&]() -> Result<Simplified> {
    SCARP_RETURN_IF_ERROR(check(field, asked));
    SimplifyOptions options = asked;
    options.quality.effort = choose_effort(field, asked);
    options.run.threads = choose_threads(field, options);
    Border& border = options.domain.border;
    if (!border.max_error) border.max_error = asked.goals.max_error;
    return asked.quality.effort == Effort::kAuto ? simplify_by_default(field, options) : make_mesh(field, options);
  });
}

Result<Simplified> simplify(const HeightField& field, const Goals& goals) {
  SimplifyOptions options;
  options.goals = goals;
  return simplify(field, options);
}

Result<Simplified> simplify_by_paper(const HeightField& field, const PaperOptions& options) {
  return without_exceptions([&]() -> Result<Simplified> {
    Request request(SimplifyOptions{.goals = options.goals,
                                    .tolerances = options.tolerances,
                                    .features = {.points = options.points},
                                    .quality = {.effort = Effort::kFast, .order = Order::kGreedy},
                                    .domain = options.domain,
                                    .output = options.output,
                                    .run = options.run});
    request.strategy = options.strategy;
    if (options.domain.border.is_locked)
      return fail(ErrorKind::kUsage, describe(find_conflicts(Fields(Field::kStrategy, Field::kBorder)).front()));
    SCARP_RETURN_IF_ERROR(check(field, request));
    auto made = simplify_once(field, request);
    if (made) made->why_fast = WhyFast::kStrategy;
    return made;
  });
}

}  // namespace scarp
