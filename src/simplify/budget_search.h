// Finds the mesh of a budget by a search over one number: the max error or, if samples have tolerances, a factor of all
// bounds.
//
//   a mesh within the budget        ── greedy insertion that stops at the budget or, if it cannot, the least mesh
//   above fast effort: refinement   ── shows at low cost how triangles grow as the bounds fall: about as a power
//   runs for other numbers          ── secants through the results in log–log, by the Illinois rule
//
// If fitting can raise the bound, rising_search.h needs only one such run; the search above is for other cases.
//
// Insertion cannot stop at a budget if it does not know the other needs of the mesh: the error of the final mesh
// determines how closely lines follow the raster, and no strip knows the needs of other strips. In these cases, a
// search also finds the mesh of fast effort, from which the search of a larger effort starts.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "pieces/recipe.h"
#include "scarp/result.h"
#include "scarp/simplify.h"

namespace scarp::run {

/// simplify() without a search: towards the bounds of `options`, changed by `scale`, whose line error is known. If
/// BudgetTask::insertion_stops and the scale only refines, the run is towards budgets.
using RunOnce = std::function<Result<Simplified>(const SimplifyOptions& options, const pieces::Scale& scale)>;

class BudgetNumber {
 public:
  /// The options stay alive.
  explicit BudgetNumber(const SimplifyOptions& options);

  /// The options of a run towards `number`, without budgets.
  SimplifyOptions towards(double number) const;
  double factor_of(double number) const { return is_factor_ ? number : 1; }
  bool is_factor() const { return is_factor_; }  ///< True for a factor of all bounds; else the number is the max error.

 private:
  const SimplifyOptions& options_;
  bool is_factor_;
};

struct BudgetTask {
  RunOnce run;
  pieces::EffortTraits traits = {};            ///< the work of a run with the whole effort
  bool insertion_stops = true;                 ///< insertion can stop at budgets
  bool raises_bound = false;                   ///< fitting can raise the bound (rising_search.h)
  std::uint64_t samples = 0;                   ///< including nodata
  std::function<double()> most = {};           ///< a number for which a run makes the least mesh
  std::string least = "the least mesh needs";  ///< subject of the error for a budget that the least mesh exceeds
};

/// The mesh with the least Simplified::judged_max_error, or judged_rmse (options.objective), among the meshes of the
/// search within the budgets. If the mesh for options.max_error, or for factor 1, fits: that mesh; for the objective
/// max error, the one with the fewest triangles. (A mesh for a larger number may have more triangles; if such a mesh
/// already fills the budget, the search ends.) The exact mesh if the budgets have room for it and there is no other
/// goal.
///
/// Guarantees: no budget is exceeded; the objective is not larger than in the mesh of fast effort for the same budgets
/// (fast effort is not run if refinement needs 1.5 times the budget for an error at most 15 % smaller, or 1.3 times for
/// the same error); the result depends only on the results of `run`. The search ends when the mesh uses at least 99 %
/// of a budget (97 % after some runs), or when two numbers 0.2 % apart (0.5 % for a few hundred triangles) are on both
/// sides of the budget: the number of triangles jumps there, for example because many samples have the same error. If
/// then a tenth of a few hundred triangles is unused, half of the budget is also tried, which may find a better mesh by
/// chance. Above fast effort, the search also ends when options.is_time_up requests it, with the best mesh so far.
/// There are at most kMostRuns runs with the whole effort, mostly two or three, or kMostRunsFromLeast if the search
/// starts at the least mesh. Memory: the best mesh so far in addition to a run. Progress is that of one pass, "search".
/// Fails like `run`, and with kUsage, which names the least sufficient budget, if the least mesh exceeds a budget. A
/// bound that cannot be satisfied (kPromise) only ends the search below it. `refines_only`: uses fast effort for any
/// task. REQUIRES: a budget.
Result<Simplified> search_budget(const SimplifyOptions& options, const BudgetTask& task, bool refines_only = false);

inline constexpr int kMostRuns = 12, kMostRunsFromLeast = 20;

}  // namespace scarp::run
