// Cliffs: walls of buildings and quarries, where a raster steps from one sample to the next.
//
// A step between two samples has no place that the raster knows: a wall that runs askew over the grid is a staircase,
// and a mesh on samples follows it stair by stair. But between the samples of each stair a straight line has room, and
// two lines close together, one at the height of the wall's top, one at that of its foot, leave the surface on either
// side as smooth as it is. So walls cost two triangles for a straight piece.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/lines.h"
#include "scarp/result.h"

#pragma GCC visibility push(default)

namespace scarp {

struct CliffOptions {
  /// Samples side by side, or one below the other, that differ by more are a cliff. In z units, above 0 and finite. Of
  /// little use below twice the max error.
  double height = 0;
  /// Of the mesh to come, at least 0 and finite: heights of samples along a line leave the line by 0.9 of it at most.
  /// They need not keep to that, for the bound is refinement's; but a line that they leave by more is of little use.
  double max_error = 0;
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};  ///< from samples to the coordinates of lines: map_affine()
  std::span<const Line> avoid = {};                ///< lines that no fault may cross or touch
  /// For a field with a source: bytes that the process may take, and those that are taken, as in SimplifyOptions. Walls
  /// that do not fit are refused with kUsage, before memory runs out. DEFAULT: no limit.
  std::uint64_t memory_limit = 0, memory_taken = 0;
};

struct Cliffs {
  /// Two a fault, the line along its top before that along its foot, all with heights, vertices on the lattice of 1/256
  /// sample. Their kind is kWall.
  std::vector<Line> lines;
  std::uint64_t faults = 0;
  std::uint64_t vertices = 0;  ///< of the lines, each once
};

/// Finds the walls of a raster, and for each part that is worth its vertices two lines: all samples of its upper side
/// lie on the left of both (seen from above with rows downwards), all of its lower side on the right of both, and none
/// on them or between them. So they change no sample and no promise. Void samples make no cliffs. Lines of faults have
/// no point in common.
///
/// Of the lines through a wall those with the fewest vertices are taken, vertices on cracks between two samples or in
/// cells where the wall turns. A part is worth it if it takes fewer than three pairs of vertices for ten cracks.
/// Fails with kUsage for options out of range, and as the field's source does, which is read once from the top down:
/// the lines are those of the same samples in memory. REQUIRES: the affine map can be inverted. Memory: 40 bytes a
/// crack, 1000 a crack of the longest wall, and the lines. Cost: O(samples), and some 20 µs a crack; one thread.
Result<Cliffs> detect_cliffs(const HeightField& field, const CliffOptions& options);

}  // namespace scarp

#pragma GCC visibility pop
