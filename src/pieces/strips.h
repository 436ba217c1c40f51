// Works on a streamed raster strip by strip: lines, refinement and fitting while the strip's samples are in memory.
//
//     strip above, done ──────────────    its lower row of samples is the next strip's upper row: vertices on it are
//     strip at hand     │     │     │     fixed. The rest, including borders of tiles, is one piece.
//     ────────────────────────────────
//     strips below, not read yet
#pragma once

#include <cstdint>

#include "lines/constraints.h"
#include "metric/source_bounds.h"
#include "pieces/recipe.h"
#include "pieces/tiled.h"

namespace scarp::pieces {

/// Totals of the passes over strips so far.
struct StripTotals {
  double seconds_of_fit = 0, seconds_of_lines = 0, seconds_of_refinement = 0;
  Work lines;                 ///< work of inserting constraints
  Work refinement;            ///< refinement to individual bounds, without lines
  std::uint64_t removed = 0;  ///< number of vertices
  bool is_cut_short = false;  ///< true if the time limit was reached: later strips are not fitted
};

/// Makes refine_tiled() run the recipe's passes on each strip, and adds to `totals`. `lines`: constraints (null: none).
/// `bounds`: of samples (null: the threshold applies to all). Effort kMax ignores the time limit, because the first
/// strip would use it up. Progress is reported through the current `tiles.progress`. Borrows all arguments.
void work_by_strips(const Recipe& recipe, const lines::ConstraintGraph* lines, const metric::SourceBounds* bounds,
                    double threshold, StripTotals& totals, TiledOptions& tiles);

/// The side of tiles in such a run, which decides where strips meet and lines are split.
std::int32_t strip_side(const Recipe& recipe);

}  // namespace scarp::pieces
