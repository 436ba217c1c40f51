// The budget search on a field: its runs, and where it begins.
#pragma once

#include "scarp/height_field.h"
#include "scarp/simplify.h"
#include "simplify/budget_search.h"

namespace scarp {

/// The field and the options stay alive. Reads a source of samples, and one of tolerances, at most once, now or when
/// the search begins; throws SourceFailure.
BudgetTask make_budget_task(const HeightField& field, const SimplifyOptions& options);

}  // namespace scarp
