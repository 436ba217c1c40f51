// One run of the engine towards the goals, from the first triangles to the mesh that was proven: the passes that
// simplify() chooses options and an order for.
#pragma once

#include <optional>

#include "grid/raster.h"
#include "metric/criterion.h"
#include "pieces/tiled.h"
#include "scarp/height_field.h"
#include "scarp/simplify.h"

namespace scarp {

struct ConstraintGraph;

/// Simplifies `field`, whose samples are `raster`: from the mesh of the dominant order where `tiled` is given, else
/// greedily. `lines`: to be laid into the mesh; null: none. Fails as simplify() does. REQUIRES: options that were
/// checked, with an effort that was chosen; `criterion` was made for all of them; all outlive the call.
Result<Simplified> run_engine(const HeightField& field, const Raster& raster, const SimplifyOptions& options,
                              const Criterion& criterion, const ConstraintGraph* lines, std::optional<Tiled> tiled);

}  // namespace scarp
