// The vertices of two strips along the row of samples that they share.
//
//     strip above, done ───·──·──·────    the vertices depend only on that row's samples and tolerances and on the
//     strip at hand        ╲ ╱ ╲ ╱        lines that meet it. Both strips insert the same ones, then no others: the
//     ─────────────────────────────────   row's samples have no aims afterwards.
//     strips below, not read yet
#pragma once

#include <cstdint>
#include <span>

#include "lines/constraints.h"
#include "pieces/piece.h"
#include "scarp/result.h"

namespace scarp::pieces {

/// Adds to the strip's part of the lines the samples that chords of a shared row need. Unless the strip has its own
/// aims, splits only chords next to lines, because tiles have split the other chords to the threshold.
void split_shared_row(const Piece& strip, bool is_top, double threshold, lines::ConstraintGraph& part);

/// Adds all vertices of the shared row of a strip that is made whole. A row that lines meet has no tile vertices, only
/// vertices of lines and of the chords between them; both its strips are made whole. `side`: side of the adjacent
/// tiles. Fails if simplify_border() fails.
Result<void> start_shared_row(const Piece& strip, bool is_top, double threshold, std::int32_t side,
                              lines::ConstraintGraph& part);

/// Inserts the samples that a shared row without lines needs. `is_whole`: the strip has no tile vertices. Fails if
/// simplify_border() fails. REQUIRES: aims.
Result<void> insert_shared_row(Piece& strip, bool is_top, bool is_whole);

/// Removes the aims of samples on shared rows, whose edges are final.
void settle_shared_rows(const Piece& strip, std::span<float> aims);

}  // namespace scarp::pieces
