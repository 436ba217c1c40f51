// A budget is met by a search over one number: the max error, or, where samples have tolerances, a factor of all
// bounds.
//
//   a mesh within the budget        ── greedy insertion that stops at it; where insertion cannot stop, the least mesh
//   with effort: refinement alone   ── how triangles grow as the bounds fall: about a power, and cheap to see
//   runs for other numbers          ── secants through them in log–log, by the Illinois rule
//
// Insertion cannot stop at a budget if it does not know what else the mesh will need: how closely lines are to follow
// the raster depends on the error of the mesh to come, and no strip knows the others. There the mesh of fast effort is
// searched for, too: it is where the search of a larger effort begins.
#pragma once

#include <functional>
#include <string>

#include "pieces/recipe.h"
#include "scarp/result.h"
#include "scarp/simplify.h"

namespace scarp {

/// simplify() without a search: towards the bounds of `options`, by the scale, whose line error is known; or, if
/// BudgetTask::insertion_stops, towards budgets where the scale refines only.
using RunOnce = std::function<Result<Simplified>(const SimplifyOptions& options, const Scale& scale)>;

/// The number that is searched for.
class BudgetNumber {
 public:
  /// The options stay alive.
  explicit BudgetNumber(const SimplifyOptions& options);

  /// The options of a run towards it, without budgets.
  SimplifyOptions towards(double number) const;
  double factor_of(double number) const { return is_factor_ ? number : 1; }
  bool is_factor() const { return is_factor_; }  ///< True for a factor of all bounds; else it is the max error.

 private:
  const SimplifyOptions& options_;
  bool is_factor_;
};

struct BudgetTask {
  RunOnce run;
  EffortTraits traits = {};                    ///< the work of a run that does not only refine
  bool insertion_stops = true;                 ///< at budgets
  std::function<double()> most = {};           ///< a number that gives the least mesh
  std::string least = "the least mesh needs";  ///< the subject of the refusal of a budget that the least mesh exceeds
};

/// The mesh with the least Simplified::judged_max_error, or judged_rmse (options.objective), among those that the
/// search has seen within the budgets; at options.max_error, or at factor 1, if that fits: for the max error the one
/// with the fewest triangles; the exact one if the budgets have room for it and nothing else is asked for.
///
/// Guarantees: no budget is exceeded; what is minimised is not larger than in the mesh of fast effort for the same
/// budgets; the result is a function of what `run` returns. The search ends with at least 99 % of a budget used (97 %
/// after some runs), or when two numbers 0.2 % apart (0.5 % where there are but a few hundred triangles) lie on both
/// sides of the budget: then triangles jump there, as with errors that many samples share, and where a tenth of a few
/// hundred triangles is unused, the half of the budget is tried too: chance may have found a better mesh there; or,
/// with effort, when options.is_time_up asks for it, with the best mesh so far. At most kMostRuns runs with the whole
/// effort, mostly two or three, or kMostRunsFromLeast from the least mesh on. Memory: the best mesh so far in addition
/// to a run. Progress is that of one pass, "search". Fails as `run` does, and with kUsage, and the least number that
/// would do, where the least mesh exceeds a budget; a bound that cannot be kept (kPromise) only ends what lies below
/// it. `refines_only`: with fast effort, whatever the task's is. REQUIRES: a budget.
Result<Simplified> search_budget(const SimplifyOptions& options, const BudgetTask& task, bool refines_only = false);

inline constexpr int kMostRuns = 12, kMostRunsFromLeast = 20;

}  // namespace scarp
