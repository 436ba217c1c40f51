// The mesh of a budget with a small squared error.
//
// No search for an error leads there (fit/square_rounds.h), so there is none: the mesh of fast effort shows what max
// error the budget reaches, which becomes the bound; a mesh of several times the triangles is where fitting begins.
// Where there is no such mesh, since few triangles more follow every sample, a search for an error may do better, as on
// level roofs: it is made too. So it is for a few hundred triangles.
#pragma once

#include "scarp/result.h"
#include "scarp/simplify.h"
#include "simplify/budget_search.h"

namespace scarp {

/// The mesh with the least Simplified::judged_rmse of those seen, within the budgets; its judged_max_error is at most
/// options.max_error if that can be kept, else not larger than in the mesh of fast effort. Where rounding, the bound or
/// the memory forbid such a mesh, that of search_budget(). Progress, failures and REQUIRES as there. Memory: the mesh
/// of fast effort in addition to a run of some four times its triangles.
Result<Simplified> search_squares(const SimplifyOptions& options, const BudgetTask& task);

}  // namespace scarp
