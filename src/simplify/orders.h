// The two orders of insertion of a run.
#pragma once

#include "pieces/plan.h"
#include "scarp/result.h"
#include "scarp/simplify.h"
#include "simplify/line_work.h"

namespace scarp {

/// The locally dominant order: tiles, on all threads, strip by strip where samples are streamed; greedily where heights
/// or a coarse goal make tiles of no use. `lines`: to be inserted, prepared or such as may wait; null: none. Fails as
/// simplify() does.
Result<Simplified> run_by_tiles(const Plan& plan, LineWork* lines);

/// Algorithm III over the whole raster. REQUIRES: samples in memory.
Result<Simplified> run_greedily(const Plan& plan, LineWork* lines);

/// With a locked border: in the dominant order as one tile, where that may be, else greedily, as with lines. REQUIRES:
/// samples in memory.
Result<Simplified> run_locked(const Plan& plan, LineWork* lines);

}  // namespace scarp
