// The passes over the whole mesh, from the first triangles, or those of tiles, to the proven mesh.
#pragma once

#include <optional>
#include <span>

#include "grid/raster.h"
#include "lines/constraints.h"
#include "metric/criterion.h"
#include "pieces/recipe.h"
#include "pieces/tiled.h"
#include "scarp/simplify.h"

namespace scarp::run {

/// Carries out a recipe on `raster`, the samples of its field. Starts from the mesh of the dominant order if `tiled` is
/// given, else inserts greedily. `lines`: lines to insert into the mesh; null: none. `border`: the vertices of a locked
/// border, whose raster is then `raster` (locked_border.h); empty: none. Fails like simplify(). REQUIRES: `criterion`
/// was made for the recipe; all outlive the call.
Result<Simplified> run_passes(const pieces::Recipe& recipe, const grid::Raster& raster,
                              const metric::Criterion& criterion, const lines::ConstraintGraph* lines,
                              std::optional<pieces::Tiled> tiled, std::span<const Point> border = {});

}  // namespace scarp::run
