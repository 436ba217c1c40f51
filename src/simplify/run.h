// One run of the engine: it prepares the lines of the features and inserts samples by the recipe; the passes over the
// whole mesh (mesh_passes.h) follow. A search makes several runs.
#pragma once

#include "pieces/recipe.h"
#include "scarp/result.h"
#include "scarp/simplify.h"

namespace scarp::run {

/// Makes one mesh: towards the bounds or, if insertion stops at budgets, within the budgets. Fails like simplify().
/// REQUIRES: checked options; a budget only if Search::kNone.
Result<Simplified> run(const pieces::Recipe& recipe);

}  // namespace scarp::run
