// The strategy of a run.
#pragma once

#include "scarp/paper.h"
#include "scarp/simplify.h"
#include "session/text/json.h"

namespace scarp::cli {

/// The "strategy" object of a report, without masks, channels and scripts.
Json describe_strategy(const SimplifyOptions& options, const Strategy& strategy, const Simplified& simplified);

}  // namespace scarp::cli
