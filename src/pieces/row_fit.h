// Lines, bounds of samples and effort where the samples are not in memory as a whole: each row of tiles is given its
// lines, refined and fitted while its samples are there.
//
//     row above, done ──────────────    its lower border is the next row's upper one: the vertices on it stay, and
//     row at hand     │     │     │     everything between, across the tiles' own borders too, is fitted as one mesh
//     ─────────────────────────────
//     rows below, not read yet
#pragma once

#include <cstdint>

#include "lines/constraints.h"
#include "metric/source_bounds.h"
#include "pieces/tiled.h"
#include "scarp/height_field.h"
#include "scarp/simplify.h"

namespace scarp {

/// What finishing row by row has done so far.
struct RowFits {
  double seconds = 0;  ///< of fitting
  double seconds_of_lines = 0, seconds_of_bounds = 0;
  Work lines;                 ///< of laying them
  Work bounds;                ///< of refining to bounds of samples, where no lines are laid
  std::uint64_t removed = 0;  ///< vertices
  bool is_cut_short = false;  ///< by the time: rows that come later stay as they are
};

/// Whether rows are fitted instead of the whole mesh; and finished, with lines, to bounds of samples or by fitting.
bool fits_rows(const HeightField& field, const SimplifyOptions& options);
bool finishes_rows(const HeightField& field, const SimplifyOptions& options);

/// Lets refine_tiled() lay lines into each row (null: none) and refine it to the samples' own bounds (null: the
/// threshold holds for all), then fit it with the effort of `options`, and adds to `fits`. Vertices are free as in
/// fit(); effort kMax does not go on until a time is up, as the first row would use it all. Progress is told through
/// `tiles.progress`, as it is now. All stay alive.
void finish_rows(const HeightField& field, const SimplifyOptions& options, const ConstraintGraph* lines,
                 double threshold, RowFits& fits, TiledOptions& tiles, const SourceBounds* bounds = nullptr);

/// The side of tiles of such a run, which cuts lines where rows meet.
std::int32_t side_of_rows(const HeightField& field, const SimplifyOptions& options);

}  // namespace scarp
