// A strip's part of the raster's lines.
//
//     strip above, done ──────┬───────    a line is cut at the shared row of samples: the vertex there depends only
//     strip at hand       line│           on the line, so both strips know it. If it cuts a chord of the shared row,
//     ────────────────────────┴───────    samples split the chord, by the row's own rule (shared_rows.h).
//     strips below, not read yet
//
// Walls and ridges must be inserted before the surface is refined, so before tiles. Strips that such a graph touches
// are made whole: lines are inserted first, then the strip is refined as one piece. The walls of a cut are also split
// where strips meet. Walls along a shared row belong to both strips; each strip determines its side of them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/function_ref.h"
#include "lines/constraints.h"
#include "pieces/piece.h"

namespace scarp::pieces {

class StripLines {
 public:
  /// `graph`: of the whole raster, with edges split at the rows that strips share. Borrowed.
  explicit StripLines(const lines::ConstraintGraph& graph);

  /// True for rows of samples where lines are inserted before the surface is refined.
  bool makes_whole(std::int32_t first, std::int32_t rows) const;
  /// The strip's part of the graph, in the strip's coordinates, with all points on shared rows.
  lines::ConstraintGraph part_of(const Piece& strip) const;

 private:
  bool has_points(std::int32_t top, std::int32_t bottom) const;
  std::optional<lines::SurfaceCut> part_of_cut(std::int32_t first, std::int32_t rows,
                                               FunctionRef<std::uint32_t(std::uint32_t)> number_of) const;

  const lines::ConstraintGraph& graph_;
  std::vector<std::uint32_t> points_;                // points of the graph, from the top down
  std::vector<std::uint32_t> edges_;                 // sorted by their upper ends, as walls_ is
  std::vector<std::array<std::uint32_t, 2>> walls_;  // walls of its cut
  std::vector<std::array<Point, 2>> outline_;
};

}  // namespace scarp::pieces
