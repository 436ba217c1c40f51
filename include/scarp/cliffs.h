// Cliffs: walls of buildings and quarries, where a raster steps from one sample to the next.
//
// The raster does not know where between two samples a step is. A wall at an angle to the grid becomes a staircase, and
// a mesh on samples follows each stair. But a straight line fits between the samples of all the stairs. Two such lines
// close together, one along the wall's top, one along its foot, keep the surface on either side smooth. So a straight
// piece of wall costs two triangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/lines.h"
#include "scarp/result.h"
#include "scarp/run.h"

#pragma GCC visibility push(default)

namespace scarp {

struct CliffOptions {
  /// Neighbouring samples in a row or a column that differ by more are a cliff. In z units, above 0 and finite. It is
  /// of little use below twice the max error.
  double height = 0;
  /// Max error of the mesh to come, at least 0 and finite. Heights of samples along a line differ from the line by at
  /// most 0.9 of it. The bound does not depend on that, since refinement ensures it; but a line from which samples lie
  /// farther is of little use.
  double max_error = 0;
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};  ///< from samples to the coordinates of lines: map_affine()
  std::span<const Line> avoid = {};                ///< lines that no wall may cross or touch
  /// For a field with a source: bytes that the process may use, and bytes in use, as in SimplifyOptions. Walls
  /// that do not fit are refused with kMemory, before memory runs out. DEFAULT: no limit.
  Run run = {};
};

struct Cliffs {
  /// Two for each wall, the line along its top before the line along its foot. All have heights, and vertices on the
  /// lattice of 1/256 sample. Their kind is kWall.
  std::vector<Line> lines;
  std::uint64_t wall_count = 0;
  std::uint64_t vertices = 0;  ///< number of vertices of the lines, each counted once
};

/// Finds the walls of a raster, and two lines for each part that is worth its vertices. All samples of its upper side
/// lie on the left of both lines (seen from above with rows downwards), all samples of its lower side on the right of
/// both, and none on them or between them. So walls change no sample and no promise. Nodata samples make no cliffs. Two
/// walls never share a point.
///
/// Among all lines through a wall, those with the fewest vertices are chosen. Their vertices lie on cracks between two
/// samples, or in cells where the wall turns. A part is worth its vertices if it needs fewer than three pairs of them
/// for ten cracks. Fails with kUsage for options out of range, and as the field's source does. A source is read once
/// from the top down, and gives the same lines as the same samples in memory. REQUIRES: the affine map can be inverted.
/// Memory: 40 bytes a crack, 1000 a crack of the longest wall, and the lines. Cost: O(samples), and some 20 µs a crack;
/// one thread.
Result<Cliffs> detect_cliffs(const HeightField& field, const CliffOptions& options);

}  // namespace scarp

#pragma GCC visibility pop
