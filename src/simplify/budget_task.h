// The budget search on a field: its runs, and where it begins.
#pragma once

#include "pieces/recipe.h"
#include "simplify/budget_search.h"

namespace scarp {

/// The recipe stays alive. Reads a source of samples, and one of tolerances, at most once, now or when the search
/// begins; throws SourceFailure.
BudgetTask make_budget_task(const Recipe& recipe);

}  // namespace scarp
