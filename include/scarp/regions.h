// Regions of interest: a tolerance for each sample, small where it matters, that grows with the distance.
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
  /// As read_lines() gives them. A polygon holds what is in its outer ring and in no hole of it (even-odd, so bow-ties
  /// and rings that overlap are decided too), and its rings; a line is its own course.
  std::vector<Line> lines;
  double tolerance = 0;  ///< in it, in z units, at least 0
};

/// Where samples lie, and what holds beyond the regions.
struct RegionGrid {
  int cols = 0, rows = 0;
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};  ///< from samples to the coordinates of the lines: map_affine()
  double cell_x = 1, cell_y = 1;                   ///< distances between samples, in the unit of `falloff`
  double falloff = 0;                              ///< how far from a region its tolerance reaches `beyond`; 0: at once
  std::optional<double> beyond = {};               ///< nothing: no bound there. REQUIRED where falloff > 0.
};

/// A bound for each sample, row-major, as SimplifyOptions::tolerance: t in a region of tolerance t, t + (beyond − t) ·
/// min(1, d / falloff) at a distance d from it; of several regions the smallest; +infinity where there is none. The
/// samples nearest to rings and lines belong to their region, so that one smaller than a cell has some; distances are
/// those between samples (exact, Euclidean). Bounds are rounded to float32 downwards. `found`: by region, whether any
/// part of it lies in the raster; may be null.
/// REQUIRES: cols, rows, cell_x, cell_y > 0; falloff >= 0; the affine map can be inverted.
/// Cost: O(samples + segments · rows that they cross) a region; beside the bounds, what RegionBounds takes.
std::vector<float> region_tolerances(std::span<const Region> regions, const RegionGrid& grid,
                                     std::vector<bool>* found = nullptr);

/// The same bounds, to the last bit, made where they are read.
struct RegionBounds {
  /// For SimplifyOptions and MeasureOptions::tolerance_source; never fails. Cost of a window: O(samples), and, where
  /// falloff > 0, no less than rows of a thousand samples, or six times as wide as the falloff, a region near it.
  std::shared_ptr<const SampleSource> source;
  std::vector<bool> found;  ///< by region, whether any part of it lies in the raster
  /// Of memory: 8 a region and column, and for each sample on its outline; and what each of `threads` needs to read.
  std::uint64_t bytes = 0;
};
/// `threads`: as SimplifyOptions::threads. The regions are not needed any more then. REQUIRES: as region_tolerances().
RegionBounds make_region_bounds(std::span<const Region> regions, const RegionGrid& grid, int threads = 1);

}  // namespace scarp

#pragma GCC visibility pop
