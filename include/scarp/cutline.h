// Cutlines: polygons at which the surface ends.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/lines.h"
#include "scarp/progress.h"
#include "scarp/result.h"

#pragma GCC visibility push(default)

namespace scarp {

/// The surface within the polygons and on their rings stays. Within a polygon rings count even-odd: holes,
/// self-intersecting rings and bow-ties need nothing special, and parts enclosed twice are outside.
struct Cutline {
  /// Rings of polygons, as read_lines() and close_rings() give them; their heights are ignored. EMPTY: no cut.
  /// Functions with a cutline fail with kInput for a vertex more than 2^41 samples away, and name it.
  std::vector<Line> rings;
  /// From samples to the coordinates of the rings, as Frame::affine; see map_affine(). DEFAULT: columns and rows.
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};
};

/// Rings as they are, and closed lines as polygons of their own. Fails with kInput for an open line, and names it.
Result<std::vector<Line>> close_rings(std::vector<Line> lines);

/// The union of polygons, with its outline moved inwards by `distance`, outwards if negative. Corners that move away
/// become round, with arcs as chords of 90 / 8 degrees. Given the side of a `sample`, vertices that the outline does
/// not need are removed, within a 256th of it and an eighth of the distance, and distances below it keep corners
/// pointed, at most twice as far away: edges far below a sample would ask for many tiny triangles. `unit`: lengths of
/// the coordinates' units along x and y in the unit of the distance, above 0. The result may be empty: polygons
/// narrower than twice the distance vanish. By GDAL and GEOS, in double arithmetic; fails with kUsage in a build
/// without one of them, with kInput where GEOS fails.
Result<std::vector<Line>> inset_polygons(std::span<const Line> rings, double distance,
                                         const std::array<double, 2>& unit = {1, 1}, double sample = 0);

/// Result of mask_outside().
struct MaskedOutside {
  std::uint64_t lost = 0;    ///< heights outside
  std::uint64_t kept = 0;    ///< heights within
  bool has_surface = false;  ///< some cell of the grid has three or four heights within
  std::uint64_t bytes = 0;   ///< additional memory of the field's source from now on
};

/// Makes all samples outside the polygons nodata: a cut along the cells of the grid, where a cut along the polygons
/// themselves is not possible. For a field that is not in memory the samples are nodata from now on whenever they are
/// read; the field is read once, to count. Then `info` has the range of the heights before the cut, if it had none.
/// Fails as the field's source and with kCancelled. REQUIRES: the affine map can be inverted. Cost: O(samples +
/// segments · rows that they cross).
Result<MaskedOutside> mask_outside(OwnedHeightField& field, const Cutline& cutline,
                                   const ProgressCallback& progress = {});

}  // namespace scarp

#pragma GCC visibility pop
