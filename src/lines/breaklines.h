// Lines of a map, with heights. They are snapped to the lattice of a raster and arranged with the outline of its
// surface.
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

namespace scarp::lines {

struct Breaklines {
  /// The vertices of the outline, and of the lines within the raster's rectangle. They are in raster order, with
  /// kLatticeSteps steps per sample.
  std::vector<Point> points;
  /// The height of each point: the height of the hard lines through it, otherwise the raster's. The raster is bilinear
  /// in a cell with four heights, and a plane in a cell with three. In other cells, its height is the mean of the valid
  /// corners with bilinear weights, or NaN if their weights are 0. On a sample, it is the sample's value.
  std::vector<float> heights;
  std::vector<bool> is_hard;  ///< for each point: lines determine its height
  std::vector<geom::Arrangement::Edge> edges;
  std::vector<bool> is_held;  ///< for each edge: true if a permanent line or the outline runs there; EMPTY: all

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
/// one without. The lattice moves lines by up to two steps, so a small difference of height between two hard lines is
/// no conflict. It may be as large as the change of either line, or of the raster in that cell, within two steps, plus
/// the rounding of float32. In this case the height of the first given line is used, as with kFirst.
///
/// Fails with kInput for coordinates too large for the raster's precision, and, with kError, where hard lines conflict;
/// the error names both lines and the place in map coordinates. Fails with kUsage for a raster of more than 2^30 /
/// kLatticeSteps samples a side. REQUIRES: lines as read_lines() returns them; the affine map is invertible. Cost: as
/// arrange(), plus a visit to each point of each hard line (with chains: of each line); n overlapping lines need n²/2
/// visits.
Result<Breaklines> place_breaklines(std::span<const Line> lines, const std::array<double, 6>& affine,
                                    const grid::Raster& raster, const grid::Outline& outline,
                                    LineConflict conflict = LineConflict::kError, bool with_chains = false);

/// The same, but reads only samples near lines. `rigid`: the rigid edges, in kLatticeSteps, except the rectangle's
/// sides. They must include the outline wherever lines pass near it, and all other edges at which lines are to be
/// split.
Result<Breaklines> place_breaklines(std::span<const Line> lines, const std::array<double, 6>& affine,
                                    const LineSamples& samples, std::span<const geom::Segment> rigid,
                                    LineConflict conflict, bool with_chains);

/// The lines clipped to the raster and one sample around it, in kLatticeSteps. Fails with kInput if coordinates are too
/// large.
Result<std::vector<geom::Segment>> find_courses(std::span<const Line> lines, const std::array<double, 6>& affine,
                                                std::int32_t cols, std::int32_t rows);

/// The height of the surface (see Breaklines::heights) at a point within the raster, in kLatticeSteps.
double height_between_samples(const grid::SampleView& heights, Point point);

/// The same at the nearest lattice point; NaN beyond the raster.
double surface_at(const grid::Raster& raster, grid::SamplePosition position);
double surface_at(const LineSamples& samples, grid::SamplePosition position);

}  // namespace scarp::lines
