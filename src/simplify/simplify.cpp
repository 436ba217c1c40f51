// The main job: checks, then the recipe, then one mesh (run.h), or, for a budget, a search among several
// (budget_search.h).
#include "scarp/simplify.h"

#include <fmt/format.h>

#include <exception>
#include <new>
#include <utility>

#include "base/function_ref.h"
#include "base/memory_budget.h"
#include "grid/source_failure.h"
#include "pieces/checks.h"
#include "pieces/conflicts.h"
#include "pieces/recipe.h"
#include "scarp/paper.h"
#include "simplify/budget_search.h"
#include "simplify/budget_task.h"
#include "simplify/pass_work.h"
#include "simplify/run.h"
#include "simplify/squares_search.h"

namespace scarp {

namespace {

/// If a budget determines the size of the mesh, the error advises a smaller budget.
Error name_budget(const SimplifyOptions& options, Error error) {
  if (error.kind != ErrorKind::kMemory || !error.message.ends_with(kLargerError)) return error;
  error.message.replace(error.message.size() - kLargerError.size(), kLargerError.size(),
                        options.goals.max_triangles ? "a smaller budget of triangles" : "a smaller budget of vertices");
  return error;
}

/// A mesh with few vertices may need more of them for the requested angles and lengths than another mesh. So with shape
/// goals, the next lower effort is also tried.
Result<Simplified> simplify_towards(const pieces::Recipe& recipe) {
  auto made = run::run(recipe);
  if (!made || made->is_cut_short || !recipe.traits.lower || !recipe.options.quality.shape.any()) return made;
  metric::Request lower = recipe.options;
  lower.quality.effort = *recipe.traits.lower;
  lower.run.memory.taken += run::kMeshBytesPerVertex * made->mesh.vertex_count();
  auto other = simplify_towards(pieces::Recipe(recipe.field, lower));
  if (!other) return other.error().kind == ErrorKind::kCancelled ? std::move(other) : std::move(made);
  if (other->mesh.triangle_count() < made->mesh.triangle_count()) std::swap(*made, *other);
  Pass search{"search", other->seconds_refine + other->seconds_measure};
  run::add_work(*other, search);
  made->passes.insert(made->passes.begin(), search);
  made->seconds_refine += search.seconds;
  made->effort = recipe.effort;
  return made;
}

Result<Simplified> meet_budget(const pieces::Recipe& recipe) {
  if (recipe.search == pieces::Search::kNone) return run::run(recipe);
  const run::BudgetTask task = run::make_budget_task(recipe);
  return recipe.search == pieces::Search::kSquares ? run::search_squares(recipe.options, task)
                                                   : run::search_budget(recipe.options, task);
}

Result<Simplified> make_mesh(const pieces::Recipe& recipe) {
  if (!recipe.has_budget) return simplify_towards(recipe);
  auto made = meet_budget(recipe);
  if (!made) return tl::unexpected(name_budget(recipe.options, std::move(made.error())));
  return made;
}

/// Simplifies with the default effort. If memory does not suffice for it, the mesh is only refined, unless free
/// vertices were requested. The memory for one thread, which is the least, decides, because the mesh must not depend on
/// the number of threads.
Result<Simplified> simplify_by_default(const pieces::Recipe& recipe) {
  WhyFast why = recipe.fits ? WhyFast::kBudget : WhyFast::kOrder;
  auto made = make_mesh(recipe);
  const auto lacks_memory = [&] { return !made && made.error().kind == ErrorKind::kMemory && recipe.fits; };
  if (lacks_memory() && recipe.options.run.threads != 1) {
    metric::Request alone = recipe.options;
    alone.run.threads = 1;
    made = make_mesh(pieces::Recipe(recipe.field, alone));
  }
  if (lacks_memory() && recipe.options.quality.vertices != Vertices::kFree) {
    metric::Request fast = recipe.options;
    fast.quality.effort = Effort::kFast;
    why = WhyFast::kMemory;
    made = make_mesh(pieces::Recipe(recipe.field, fast));
  }
  if (made && made->effort == Effort::kFast) made->why_fast = why;
  return made;
}

/// Turns an exception in `work` into an error.
Result<Simplified> without_exceptions(FunctionRef<Result<Simplified>()> work) try {
  return work();
} catch (const grid::SourceFailure& failure) {
  return tl::unexpected(failure.error);
} catch (const std::bad_alloc&) {
  return fail(ErrorKind::kInput, "not enough memory for this raster and goal: allow a larger error or fewer triangles");
} catch (const std::exception& e) {
  return fail(ErrorKind::kInternal, fmt::format("an exception while simplifying: {}", e.what()));
}

}  // namespace

Result<Simplified> simplify(const HeightField& field, const SimplifyOptions& asked) {
  return without_exceptions([&]() -> Result<Simplified> {
    SCARP_RETURN_IF_ERROR(pieces::check_options(field, asked));
    const metric::Request request = pieces::settle_request(field, asked);
    const pieces::Recipe recipe(field, request);
    return request.chose_effort ? simplify_by_default(recipe) : make_mesh(recipe);
  });
}

Result<Simplified> simplify(const HeightField& field, const Goals& goals) {
  SimplifyOptions options;
  options.goals = goals;
  return simplify(field, options);
}

Result<Simplified> simplify_by_paper(const HeightField& field, const PaperOptions& options) {
  return without_exceptions([&]() -> Result<Simplified> {
    metric::Request request(SimplifyOptions{.goals = options.goals,
                                            .tolerances = options.tolerances,
                                            .features = {.points = options.points},
                                            .quality = {.effort = Effort::kFast, .order = Order::kGreedy},
                                            .domain = options.domain,
                                            .output = options.output,
                                            .run = options.run});
    request.strategy = options.strategy;
    if (options.domain.border.is_locked)
      return fail(
          ErrorKind::kUsage,
          pieces::describe(
              pieces::find_conflicts(pieces::Fields(pieces::Field::kStrategy, pieces::Field::kBorder)).front()));
    SCARP_RETURN_IF_ERROR(pieces::check_options(field, request));
    auto made = run::run(pieces::Recipe(field, request));
    if (made) made->why_fast = WhyFast::kStrategy;
    return made;
  });
}

}  // namespace scarp
