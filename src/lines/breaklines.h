// Lines of a map snapped to the lattice of a raster and arranged with the outline of its surface, with heights.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "geom/arrangement.h"
#include "geom/segments.h"
#include "grid/affine_map.h"
#include "grid/bands.h"
#include "grid/outline.h"
#include "grid/raster.h"
#include "grid/vertex_lattice.h"
#include "lines/line_samples.h"
#include "scarp/height_field.h"
#include "scarp/lines.h"
#include "scarp/result.h"

namespace scarp {

struct Breaklines {
  /// Vertices of the lines within the raster's rectangle and of its outline, in raster order, in kLatticeSteps of a
  /// sample.
  std::vector<Point> points;
  /// The height of each point: the height of the hard lines through it, otherwise the raster's. The raster is bilinear
  /// in a cell of four heights and a plane in one of three. In other cells its height is the mean of the valid corners
  /// with bilinear weights, or NaN if they have no weight. On a sample it is the sample.
  std::vector<float> heights;
  std::vector<bool> is_hard;  ///< for each point: lines determine its height
  std::vector<Arrangement::Edge> edges;
  std::vector<bool> is_held;  ///< for each edge: true unless only starts run there; EMPTY: no starts

  std::uint64_t outside = 0;  ///< lines with no part inside

  /// A line, or a part of it within the rectangle: points[passed[begin]], …, points[passed[end − 1]].
  struct Chain {
    std::uint32_t line;  ///< index into the given lines
    std::uint32_t begin, end;
  };
  std::vector<Chain> chains;  ///< by line, then along each; only if requested
  std::vector<std::uint32_t> passed;

  std::span<const std::uint32_t> points_of(const Chain& chain) const {
    return std::span(passed).subspan(chain.begin, chain.end - chain.begin);
  }
};

/// True for a line detected in the raster, which is inserted before refinement.
bool is_inserted_first(const Line& line);

/// Snaps lines to the lattice of a raster. A vertex of a line moves by at most half a step, 1/512 sample. Its segments
/// move by at most one and a half steps. `affine` maps samples to the coordinates of the lines, as Frame::affine does;
/// `outline` is the result of trace_outline(), not simplified. Outline and rectangle are the rigid edges.
///
/// Along a hard line, heights are interpolated between vertices. The line is soft between a vertex with a height and
/// one without. The lattice moves lines by up to two steps. Some difference of height between two hard lines is thus no
/// conflict: the change of either line, or of the raster in that cell, within two steps, plus the rounding of float32.
/// Then the height of the first given line is used, as in kFirst.
///
/// Fails with kInput where hard lines conflict (kError: names both and the place in map coordinates), and for
/// coordinates too large for the raster's precision. Fails with kUsage for a raster of more than 2^30 / kLatticeSteps
/// samples a side. REQUIRES: lines as read_lines() returns them; the affine map is invertible. Cost: as arrange(), plus
/// a visit to each point of each hard line (with chains: of each line), n²/2 for n overlapping lines.
Result<Breaklines> place_breaklines(std::span<const Line> lines, const std::array<double, 6>& affine,
                                    const Raster& raster, const Outline& outline,
                                    LineConflict conflict = LineConflict::kError, bool with_chains = false);

/// The same, but reads only samples near lines. `rigid`: edges in kLatticeSteps, without the rectangle: the outline
/// wherever lines pass, and all other edges at which lines are cut.
Result<Breaklines> place_breaklines(std::span<const Line> lines, const std::array<double, 6>& affine,
                                    const LineSamples& samples, std::span<const Segment> rigid, LineConflict conflict,
                                    bool with_chains);

/// The lines clipped to the raster and one sample around it, in kLatticeSteps. Fails with kInput if coordinates are too
/// large.
Result<std::vector<Segment>> find_courses(std::span<const Line> lines, const std::array<double, 6>& affine,
                                          std::int32_t cols, std::int32_t rows);

/// The surface of `heights` above, at a point in kLatticeSteps of a sample within the raster.
double height_between_samples(const SampleView& heights, Point point);

/// The same at the nearest lattice point; NaN beyond the raster.
double surface_at(const Raster& raster, SamplePosition position);
double surface_at(const LineSamples& samples, SamplePosition position);

}  // namespace scarp
