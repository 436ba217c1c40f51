// A streamed raster, strip by strip. Each strip gets its lines, is refined to its bounds and fitted while its
// samples are in memory.
//
//     strip above, done ──────────────    its lower row of samples is the next one's upper row: the vertices on it
//     stay, strip at hand     │     │     │     and everything between, across the tiles' own borders too, is one piece
//     ────────────────────────────────
//     strips below, not read yet
#pragma once

#include <cstdint>

#include "lines/constraints.h"
#include "metric/source_bounds.h"
#include "pieces/recipe.h"
#include "pieces/tiled.h"

namespace scarp {

/// Totals of the passes over strips so far.
struct StripTotals {
  double seconds_of_fit = 0, seconds_of_lines = 0, seconds_of_refinement = 0;
  Work lines;                 ///< work of inserting constraints
  Work refinement;            ///< to bounds of their own, where there are no lines
  std::uint64_t removed = 0;  ///< vertices
  bool is_cut_short = false;  ///< by the time: strips that come later stay as they are
};

/// Makes refine_tiled() work on each strip with the passes of the recipe: constraints of `lines` (null: none), bounds
/// of samples (null: the threshold holds for all), the recipe's effort; and adds to `totals`. Effort kMax does not
/// continue until a time is up, as the first strip would use it all. Progress is reported through the present
/// `tiles.progress`. All stay alive.
void work_by_strips(const Recipe& recipe, const ConstraintGraph* lines, const SourceBounds* bounds, double threshold,
                    StripTotals& totals, TiledOptions& tiles);

/// The side of tiles of such a run, which cuts lines where strips meet.
std::int32_t strip_side(const Recipe& recipe);

}  // namespace scarp
