// What more than fast effort makes of a budget: the error bound is searched for which the smaller mesh just fits.
//
//   greedy insertion with the budgets  ── its max error is where the search begins, its mesh what must be surpassed
//   refinement alone, once or twice    ── how triangles grow as the bound falls: about a power, and cheap to see
//   runs with the whole effort         ── secants through them in log–log, by the Illinois rule
#pragma once

#include <functional>

#include "scarp/result.h"
#include "scarp/simplify.h"

namespace scarp {

/// simplify() without a search: towards a max error with any effort, towards budgets with fast effort.
using RunOnce = std::function<Result<Simplified>(const SimplifyOptions& options)>;

/// Whose errors they are that a budget makes small.
enum class Judged {
  kHeights,  ///< Simplified::measurement
  kNorm,     ///< of heights and channels: combined_max_error, combined_rmse
  kWeighted  ///< by a mask: weighted_max_error, weighted_rmse
};

/// The mesh with the least max error, or RMSE (options.objective), of those that the search has seen within the
/// budgets, at options.max_error if that is given and reached; the exact one if the budgets leave room for it.
///
/// Guarantees: no budget is exceeded; what is minimised is not larger than in the greedy mesh for the same budgets; the
/// result is a function of what `run` returns. The search ends with at least 99 % of a budget used (97 % from the
/// fourth run with the whole effort on), or when two bounds 0.2 % apart lie on both sides of the budget: then triangles
/// jump there, as with errors that many samples share; or when options.is_time_up says so, with the best mesh so far.
/// At most kMostRuns runs with the whole effort, mostly two or three. Memory: the best mesh so far beside a run.
/// Progress is that of one pass, "search".
/// Fails as `run` does; a bound that cannot be kept (kPromise) only ends what lies below it.
/// REQUIRES: a budget; more than fast effort.
Result<Simplified> search_error(const SimplifyOptions& options, const RunOnce& run, Judged judged = Judged::kHeights);

inline constexpr int kMostRuns = 12;

}  // namespace scarp
