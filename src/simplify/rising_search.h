// Finds the mesh of a budget by a run whose bound rises.
//
//   refinement for some errors      ── until the whole effort is expected to exceed the budget by some 12 %
//   removal alone, before repair    ── corrects the expectation
//   one run with the whole effort   ── fitting raises the bound (fit::Room) until the mesh is within the budget
//
// Each rise costs a round of removal or repair instead of a run. In bench/quality/budgets.cpp, high effort needs 0.51
// of the time of a search over runs, and normal effort 0.81. The max error is the same, the RMSE 5 % smaller.
#pragma once

#include <cstdint>

#include "scarp/result.h"
#include "scarp/simplify.h"
#include "simplify/budget_search.h"

namespace scarp::run {

/// True if search_by_rising() applies: the goal is a max error without tolerances, and no run continues until its time
/// is up.
bool may_rise(const SimplifyOptions& options, const BudgetTask& task);

/// A mesh that uses at least kNearlyFull of a budget. Depends only on the results of task.run. Fails like task.run, and
/// with kPromise if the budget is so small that the error is near the relief, so large that its mesh may satisfy
/// options.max_error or that the effort removes little, if kMostRises runs do not find such a mesh, or if the time is
/// up before. REQUIRES: may_rise(); an effort above fast.
Result<Simplified> search_by_rising(const SimplifyOptions& options, const BudgetTask& task);

/// The expected share of `refined` triangles over `samples` that remains after the whole effort: the denser the mesh,
/// the more. The formulas fit measurements.
double expected_share(const SimplifyOptions& options, const pieces::EffortTraits& traits, std::uint64_t refined,
                      std::uint64_t samples);

inline constexpr double kNearlyFull = 0.97;  ///< used share of a budget
inline constexpr int kMostRises = 3;

}  // namespace scarp::run
