// The vertices of two strips along the row of samples that they share.
//
//     strip above, done ───·──·──·────    the vertices there are a function of that row: of its samples, its tolerances
//     strip at hand        ╲ ╱ ╲ ╱        and the lines that meet it. Both strips insert the same, and neither adds
//     ─────────────────────────────────   more: nothing is asked of its samples afterwards.
//     strips below, not read yet
#pragma once

#include <cstdint>
#include <span>

#include "lines/constraints.h"
#include "pieces/piece.h"
#include "scarp/result.h"

namespace scarp {

/// Adds to the strip's part of the lines the samples of a shared row that chords next to lines need. If the strip has
/// aims of its own it does so for all chords; else tiles have split the other chords, to the threshold.
void split_shared_row(const Piece& strip, bool is_top, double threshold, ConstraintGraph& part);

/// The same for a strip that is made whole: all vertices of the shared row. One that lines meet has no vertices of
/// tiles, only those of lines and those of the chords between them; both its strips are made whole, and know that.
/// `side`: of the tiles beyond. Fails as simplify_border().
Result<void> start_shared_row(const Piece& strip, bool is_top, double threshold, std::int32_t side,
                              ConstraintGraph& part);

/// Inserts the samples that a shared row without lines needs. `is_whole`: the strip has no vertices of tiles.
/// Fails as simplify_border(). REQUIRES: aims.
Result<void> insert_shared_row(Piece& strip, bool is_top, bool is_whole);

/// Removes the aims of samples on shared rows, whose edges are final. `aims`: the strip's.
void settle_shared_rows(const Piece& strip, std::span<float> aims);

}  // namespace scarp
