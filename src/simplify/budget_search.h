// A search over one number finds the mesh of a budget: over the max error or, if samples have tolerances, a factor of
// all bounds.
//
//   a mesh within the budget        ── greedy insertion that stops at it; where insertion cannot stop, the least mesh
//   with effort: refinement alone   ── how triangles grow as the bounds fall: about a power, and cheap to see
//   runs for other numbers          ── secants through them in log–log, by the Illinois rule
//
// Insertion cannot stop at a budget if it does not know the other needs of the mesh: the error of the final mesh
// determines how closely lines follow the raster, and no strip knows the others. In these cases, a search also finds
// the mesh of fast effort, at which the search of a larger effort begins.
#pragma once

#include <functional>
#include <string>

#include "pieces/recipe.h"
#include "scarp/result.h"
#include "scarp/simplify.h"

namespace scarp {

/// simplify() without a search: towards the bounds of `options`, by `scale`, whose line error is known. If
/// BudgetTask::insertion_stops and the scale only refines, towards budgets.
using RunOnce = std::function<Result<Simplified>(const SimplifyOptions& options, const Scale& scale)>;

/// The number that is searched for.
class BudgetNumber {
 public:
  /// The options stay alive.
  explicit BudgetNumber(const SimplifyOptions& options);

  /// The options of a run towards `number`, without budgets.
  SimplifyOptions towards(double number) const;
  double factor_of(double number) const { return is_factor_ ? number : 1; }
  bool is_factor() const { return is_factor_; }  ///< True for a factor of all bounds; else it is the max error.

 private:
  const SimplifyOptions& options_;
  bool is_factor_;
};

struct BudgetTask {
  RunOnce run;
  EffortTraits traits = {};                    ///< the work of a run with the whole effort
  bool insertion_stops = true;                 ///< insertion can stop at budgets
  std::function<double()> most = {};           ///< a number that gives the least mesh
  std::string least = "the least mesh needs";  ///< subject of the error for a budget that the least mesh exceeds
};

/// The mesh with the least Simplified::judged_max_error, or judged_rmse (options.objective), among the meshes of the
/// search within the budgets. If options.max_error, or factor 1, fits: the mesh for it; for the objective max error,
/// the one with the fewest triangles. The exact mesh if the budgets have room for it and there is no other goal.
///
/// Guarantees: no budget is exceeded; the objective is not larger than in the mesh of fast effort for the same budgets;
/// the result depends only on the results of `run`. The search ends when the mesh uses at least 99 % of a budget (97 %
/// after some runs), or when two numbers 0.2 % apart (0.5 % for a few hundred triangles) are on both sides of the
/// budget: the number of triangles jumps there, as with errors that many samples share. If then a tenth of a few
/// hundred triangles is unused, half of the budget is also tried, which may find a better mesh by chance. With effort,
/// the search also ends when options.is_time_up requests it, with the best mesh so far. At most kMostRuns runs with the
/// whole effort, mostly two or three, or kMostRunsFromLeast from the least mesh on. Memory: the best mesh so far in
/// addition to a run. Progress is that of one pass, "search". Fails like `run`, and with kUsage, which names the least
/// sufficient budget, if the least mesh exceeds a budget. A bound that cannot be satisfied (kPromise) only ends the
/// search below it. `refines_only`: uses fast effort for any task. REQUIRES: a budget.
Result<Simplified> search_budget(const SimplifyOptions& options, const BudgetTask& task, bool refines_only = false);

inline constexpr int kMostRuns = 12, kMostRunsFromLeast = 20;

}  // namespace scarp
