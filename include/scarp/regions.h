// Regions of interest: per-sample tolerances, small in a region, that grow with the distance from it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/lines.h"

#pragma GCC visibility push(default)

namespace scarp {

struct Region {
  /// Lines from read_lines(). A polygon contains its rings and all points in its outer ring but not in its holes
  /// (even-odd, which also decides bow-ties and overlapping rings). A line contains only its own points.
  std::vector<Line> lines;
  double tolerance = 0;  ///< in it, in z units, at least 0
};

/// The grid of the samples, and the tolerance beyond the regions.
struct RegionGrid {
  int cols = 0, rows = 0;
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};  ///< from samples to the coordinates of the lines: map_affine()
  double cell_x = 1, cell_y = 1;                   ///< distances between samples, in the unit of `falloff`
  double falloff = 0;                              ///< distance at which the tolerance reaches `beyond`; 0: at once
  std::optional<double> beyond = {};               ///< nothing: no bound there. REQUIRED where falloff > 0.
};

/// A tolerance for each sample, row-major, as Tolerances::values: t in a region of tolerance t, t + (beyond −
/// t) · min(1, d / falloff) at a distance d from it; the smallest of several regions; +infinity where there is none.
/// The samples nearest to rings and lines belong to their region, so a region smaller than a cell has samples too.
/// Distances are those between samples (exact, Euclidean). Tolerances are rounded to float32 downwards. `found`: by
/// region, whether any part of it lies in the raster; may be null. REQUIRES: cols, rows, cell_x, cell_y > 0; falloff >=
/// 0; the affine map can be inverted. Cost: O(samples + segments · rows that they cross) a region; in addition to the
/// bounds, the memory of RegionBounds.
std::vector<float> region_tolerances(std::span<const Region> regions, const RegionGrid& grid,
                                     std::vector<bool>* found = nullptr);

/// The same tolerances, to the last bit, computed on reading.
struct RegionBounds {
  /// For Tolerances::source and MeasureOptions::tolerance_source; never fails. Cost of a window: O(samples), and, where
  /// falloff > 0, no less than rows of a thousand samples, or six times as wide as the falloff, a region near it.
  std::shared_ptr<const SampleSource> source;
  std::vector<bool> found;  ///< by region, whether any part of it lies in the raster
  /// Bytes of memory: 8 a region and column, and for each sample on its outline; and what each of `threads` needs to
  /// read.
  std::uint64_t bytes = 0;
};
/// `threads`: as Run::threads. The regions are not needed after the call. REQUIRES: as region_tolerances().
RegionBounds make_region_bounds(std::span<const Region> regions, const RegionGrid& grid, int threads = 1);

}  // namespace scarp

#pragma GCC visibility pop
