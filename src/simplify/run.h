// One run of the engine: it makes the lines of the features ready and inserts samples along the recipe's route; the
// passes over the whole mesh (mesh_passes.h) follow. A search makes several.
#pragma once

#include "pieces/recipe.h"
#include "scarp/result.h"
#include "scarp/simplify.h"

namespace scarp {

/// One mesh: towards the bounds, or, where insertion stops at budgets, within these. Fails as simplify() does.
/// REQUIRES: checked options; a budget only if Search::kNone.
Result<Simplified> run(const Recipe& recipe);

}  // namespace scarp
