#include "simplify/squares_search.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "base/clock.h"
#include "fit/square_rounds.h"
#include "pieces/budget.h"
#include "simplify/search_progress.h"

namespace scarp::run {

namespace {

/// Triangles ~ number^-kUsualPower. kNearStart: accepted ratio of a start's triangles to the wanted number.
constexpr double kUsualPower = 1.3, kNearStart = 1.5;

/// With fewer triangles, chance decides which search ends with the smaller error.
constexpr std::size_t kFewInPatches = 500;

class SquaresSearch {
 public:
  SquaresSearch(const SimplifyOptions& options, const BudgetTask& task)
      : options_(options), task_(task), number_(options), budget_(options), progress_(options.run.progress) {}

  Result<Simplified> execute() {
    const auto start = Clock::now();
    auto fast = refine();
    SCARP_RETURN_IF_ERROR(fast);
    const double reached = fast->judged_max_error;
    const double asked = number_.is_factor() ? 1 : options_.goals.max_error.value_or(reached);
    if (!(reached > 0) || std::isinf(reached) || fast->stop == StopReason::kExact) {
      auto searched = search_budget(options_, task_);
      // Larger efforts may use a max error that refinement did not need.
      if (searched && rank(*fast) < rank(*searched)) return fast;
      return searched;
    }
    SCARP_TRY(const auto& first, find_start(reached, static_cast<double>(fast->mesh.triangle_count())));
    std::optional<Simplified> best;
    for (const double bound : {asked, std::max(asked, reached)}) {
      if (best) break;
      auto made = run(bound, std::min(1.0, first / bound));
      if (!made && made.error().kind == ErrorKind::kCancelled) return made;
      if (made && used_by(*made) <= 1) best = std::move(*made);
      const bool has_bound = number_.is_factor() || options_.goals.max_error;
      if (best || !has_bound || bound >= reached) continue;
      // A mesh of few triangles may be within the max error all the same.
      auto searched = search_budget(options_, task_);
      if (searched ? searched->stop == StopReason::kMaxError : searched.error().kind == ErrorKind::kCancelled)
        return searched;
    }
    if (!best) return search_budget(options_, task_);
    if (rank(*fast) < rank(*best)) std::swap(*best, *fast);
    if (is_saturated_ || fast->mesh.triangle_count() < kFewInPatches) {
      auto searched = search_budget(options_, task_);
      if (!searched && searched.error().kind == ErrorKind::kCancelled) return searched;
      if (searched && rank(*searched) < rank(*best)) return searched;
    }
    best->stop = stop_of(*best);
    Pass search{"search"};
    search.seconds = seconds_since(start) - best->seconds_refine - best->seconds_measure;
    best->seconds_refine += search.seconds;
    best->passes.insert(best->passes.begin(), search);
    return std::move(*best);
  }

 private:
  Result<Simplified> run_once(SimplifyOptions options, const pieces::Scale& scale, double share) {
    if (!progress_.begin(share)) return fail(ErrorKind::kCancelled, "cancelled while searching for a start");
    options.run.progress = progress_.of_run(!scale.refines_only);
    return task_.run(options, scale);
  }

  Result<Simplified> refine() {
    SimplifyOptions fast = options_;
    fast.goals.objective = Objective::kMax;
    return task_.insertion_stops ? run_once(fast, {.refines_only = true}, 0.1) : search_budget(fast, task_, true);
  }

  /// A number for which refinement makes about kSquareStart times the triangles.
  Result<double> find_start(double reached, double triangles) {
    const double number = reached * std::pow(fit::kSquareStart, -1 / kUsualPower);
    SimplifyOptions options = number_.towards(number);
    options.output.normals = options.output.uvs = false;
    const auto made = run_once(options, {.factor = number_.factor_of(number), .refines_only = true}, 0.1);
    if (!made && made.error().kind == ErrorKind::kCancelled) return tl::unexpected(made.error());
    if (!made) return number;
    const double grown = static_cast<double>(made->mesh.triangle_count()) / triangles;
    is_saturated_ = grown <= fit::kSquareStart / kNearStart;
    if (!is_saturated_ && grown < fit::kSquareStart * kNearStart) return number;
    const double power = std::clamp(std::log(grown) / std::log(reached / number), 0.3, 4.0);
    return reached * std::pow(fit::kSquareStart, -1 / power);
  }

  Result<Simplified> run(double bound, double start) {
    pieces::Scale scale{number_.factor_of(bound)};
    scale.start = start;
    scale.squares = fit::SquareGoal{options_.goals.max_triangles.value_or(fit::kNoBudget),
                                    options_.goals.max_vertices.value_or(fit::kNoBudget), task_.traits.exchanges};
    return run_once(number_.towards(bound), scale, 0.7);
  }

  double used_by(const Simplified& made) const {
    return budget_.used({made.mesh.vertex_count(), made.mesh.triangle_count()});
  }
  static std::tuple<double, double> rank(const Simplified& made) { return {made.judged_rmse, made.judged_max_error}; }

  StopReason stop_of(const Simplified& made) const {
    if (made.judged_max_error <= (number_.is_factor() ? 1 : options_.goals.max_error.value_or(-1)))
      return StopReason::kMaxError;
    return budget_.tighter({made.mesh.vertex_count(), made.mesh.triangle_count()});
  }

  const SimplifyOptions& options_;
  const BudgetTask& task_;
  BudgetNumber number_;
  pieces::Budget budget_;
  SearchProgress progress_;
  bool is_saturated_ = false;  // smaller errors need only slightly more triangles: the mesh nearly follows every sample
};

}  // namespace

Result<Simplified> search_squares(const SimplifyOptions& options, const BudgetTask& task) {
  return SquaresSearch(options, task).execute();
}

}  // namespace scarp::run
