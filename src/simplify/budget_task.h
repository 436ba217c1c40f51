// The budget search on a field: its runs and its start.
#pragma once

#include "pieces/recipe.h"
#include "simplify/budget_search.h"

namespace scarp::run {

/// The recipe must stay alive. Reads a source of samples, and a source of tolerances, at most once, now or when the
/// search begins. Throws SourceFailure.
BudgetTask make_budget_task(const pieces::Recipe& recipe);

}  // namespace scarp::run
