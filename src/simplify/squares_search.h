// The mesh of a budget with a small squared error.
//
// No search over errors finds this mesh (fit/square_rounds.h). Instead, the max error that fast effort reaches with the
// budget becomes the bound, and fitting begins at a mesh with several times as many triangles. If there is no such
// mesh, because slightly more triangles already follow every sample, as on level roofs, a search over errors may be
// better and is also made. The same holds for budgets of a few hundred triangles.
#pragma once

#include "scarp/result.h"
#include "scarp/simplify.h"
#include "simplify/budget_search.h"

namespace scarp::run {

/// The mesh within the budgets with the least Simplified::judged_rmse of all meshes made. Its judged_max_error is at
/// most options.max_error if that is possible, else not larger than in the mesh of fast effort. If rounding, the bound
/// or the memory prevents such a mesh: the mesh of search_budget(). Progress, failures and REQUIRES are those of
/// search_budget(). Memory: that of a run on a mesh with some four times the triangles of the fast-effort mesh, plus
/// this mesh.
Result<Simplified> search_squares(const SimplifyOptions& options, const BudgetTask& task);

}  // namespace scarp::run
