// Cutlines: polygons that the surface ends at.
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

/// What lies in one of the polygons, or on its rings, stays. Within a polygon rings count even-odd: holes, rings that
/// cross themselves and bow-ties need nothing special, and parts that are passed twice are outside.
struct Cutline {
  /// Of polygons, as read_lines() and close_rings() give them; their heights are not looked at. EMPTY: no cut. Who
  /// takes a cutline fails with kInput for a vertex more than 2^41 samples away, named.
  std::vector<Line> rings;
  /// From samples to the coordinates of the rings, as Frame::affine; map_affine() tells it. DEFAULT: columns and rows.
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};
};

/// Rings as they are, and lines that end where they begin as polygons of their own. Fails with kInput for a line that
/// is open, named.
Result<std::vector<Line>> close_rings(std::vector<Line> lines);

/// The union of polygons, its outline moved inwards by `distance`, outwards where that is negative: round at corners
/// that move away, arcs as chords of 90 / 8 degrees. `unit`: lengths of the coordinates' units along x and y in that of
/// the distance, above 0. May be empty: polygons narrower than twice the distance go. By GDAL and GEOS, in double
/// arithmetic; fails with kUsage in a build without one of them, with kInput where GEOS fails.
Result<std::vector<Line>> inset_polygons(std::span<const Line> rings, double distance,
                                         const std::array<double, 2>& unit = {1, 1});

/// What void_outside() has left.
struct VoidedOutside {
  std::uint64_t lost = 0;    ///< heights outside
  std::uint64_t kept = 0;    ///< heights within
  bool has_surface = false;  ///< some cell of the grid has three of these, or four
  std::uint64_t bytes = 0;   ///< that the field's source takes from now on, beside what it took before
};

/// Makes all samples void that lie in no polygon: a cut along the cells of the grid, for whatever cannot be cut along
/// the polygons themselves. Of a field that is not in memory they are void from now on wherever they are read, and it
/// is read once, to count; then `info` has the range of the heights before, if it had none. Fails as the field's source
/// and with kCancelled. REQUIRES: the affine map can be inverted. Cost: O(samples + segments · rows that they cross).
Result<VoidedOutside> void_outside(OwnedHeightField& field, const Cutline& cutline,
                                   const ProgressCallback& progress = {});

}  // namespace scarp

#pragma GCC visibility pop
