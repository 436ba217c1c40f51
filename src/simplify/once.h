// One mesh: towards its bounds, or, where insertion stops at budgets, within these. A search makes several.
#pragma once

#include "metric/request.h"
#include "pieces/plan.h"
#include "scarp/result.h"
#include "scarp/simplify.h"

namespace scarp {

/// True if fast effort stops insertion at a budget. Where it does not, lines are what they are for one error, or rows
/// of tiles are refined one after the other.
bool insertion_stops(const HeightField& field, const SimplifyOptions& options);

/// simplify() without a search. Fails as that does. REQUIRES: checked options with a chosen effort; a budget only if
/// insertion stops there, by fast effort.
Result<Simplified> simplify_once(const HeightField& field, const Request& options, const Scale& scale = {});

}  // namespace scarp
