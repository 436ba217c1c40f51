// The part that a strip has of the lines of the whole raster.
//
//     strip above, done ──────┬───────    a line is cut at the shared row of samples: the vertex there is the line's
//     strip at hand       line│           alone, so both strips know it. Where it cuts a chord of the shared row,
//     ────────────────────────┴───────    samples split that, by the row's own rule (shared_rows.h).
//     strips below, not read yet
//
// Walls and ridges, which are inserted before the surface is refined, would come too late behind tiles. Strips that
// such a graph touches are made whole: lines first, then refinement of the strip as one. The rims of a cut are cut
// where strips meet, too, so each strip has whole ones; those along a shared row are both strips', and each asks on
// which side of them it lies.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/function_ref.h"
#include "lines/constraints.h"
#include "pieces/piece.h"

namespace scarp {

class StripLines {
 public:
  /// `graph`: of the whole raster, its edges cut at the rows that strips share. Stays alive.
  explicit StripLines(const ConstraintGraph& graph);

  /// True for rows of samples where lines are inserted before the surface is refined.
  bool makes_whole(std::int32_t first, std::int32_t rows) const;
  /// In the strip's own coordinates; points on shared rows are all there.
  ConstraintGraph part_of(const Piece& strip) const;

 private:
  bool has_points(std::int32_t top, std::int32_t bottom) const;
  std::optional<SurfaceCut> part_of_cut(std::int32_t first, std::int32_t rows,
                                        FunctionRef<std::uint32_t(std::uint32_t)> number_of) const;

  const ConstraintGraph& graph_;
  std::vector<std::uint32_t> points_;                // points of the graph, from the top down
  std::vector<std::uint32_t> edges_;                 // by their upper ends, as the next
  std::vector<std::array<std::uint32_t, 2>> walls_;  // walls of its cut
  std::vector<std::array<Point, 2>> outline_;
};

}  // namespace scarp
