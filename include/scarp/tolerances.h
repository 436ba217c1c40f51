// Give samples bounds of their own: from a raster of tolerances, regions of interest, or both, where the smallest one
// counts; or weights from a raster of weights.
//
// Example:
//     SCARP_TRY(const auto& dem, scarp::read_height_field("dem.tif"));
//     SCARP_TRY(auto&& site, scarp::read_lines("site.geojson", {.crs = dem.info.crs}));
//     const std::vector<scarp::Region> regions{{.lines = std::move(site.lines), .tolerance = 2}};
//     scarp::RegionGrid grid{.cols = dem.cols, .rows = dem.rows};
//     grid.affine = scarp::map_affine(dem.info, dem.rows);
//     grid.beyond = 20;  // elsewhere
//     SCARP_TRY(const auto& bounds, scarp::make_tolerances(std::nullopt, regions, grid));
//     scarp::Tolerances tolerances;  // SimplifyOptions::tolerances
//     tolerances.values = bounds.values;
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/lines.h"
#include "scarp/result.h"
#include "scarp/run.h"

#pragma GCC visibility push(default)

namespace scarp {

// Regions of interest: per-sample tolerances, small in a region, that grow with the distance from it.

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

/// Bounds of their own for samples.
struct Tolerances {
  /// Bounds, one a sample, at least 0, in z units; +infinity: none. |error| <= tolerance at every valid sample, and
  /// within max_error if that is given; |error| / tolerance is ranked. A goal of its own: where a budget has no room
  /// for it, one factor enlarges all tolerances (see "Budgets" at simplify()). Borrowed. DEFAULT: empty.
  std::span<const float> values = {};
  /// The same where the field has a source, read in windows as its samples are (no NaN): there the above fails with
  /// kUsage, as this does with samples in memory. Borrowed. DEFAULT: none.
  const SampleSource* source = nullptr;
  /// Weights, one a sample, at least 0 and finite (Terra's importance mask): weight · |error| is what is ranked and
  /// what max_error bounds. Where the weight is 0 there is no bound. Borrowed. DEFAULT: empty, all 1.
  std::span<const float> weights = {};
  /// The same where the field has a source, read in windows as its samples are, as `source`. Borrowed. DEFAULT: none.
  const SampleSource* weights_source = nullptr;
  /// Samples without a bound, which never become vertices by their errors. Borrowed. DEFAULT: none.
  std::span<const SampleAt> ignored = {};
};

struct ToleranceOptions {
  /// True: a source computes tolerances or weights on reading, for heights with a source. False: they are values, for
  /// heights in memory. DEFAULT: false.
  bool in_windows = false;
  Run run =
      {};  ///< threads: those that will read windows; progress: of the pass "read", where a raster is read through
};

/// A tolerance for each sample, in z units, at least 0; +infinity: none.
struct OwnedTolerances {
  std::vector<float> values;                   ///< for Tolerances::values; empty where they have a source
  std::shared_ptr<const SampleSource> source;  ///< for Tolerances::source; null where they are values
  std::vector<bool> found;                     ///< by region, whether any part of it lies in the raster
  std::uint64_t bytes = 0;                     ///< bytes of memory of the regions, with a source
  bool has_values = false;                     ///< a sample of the raster has a value
};

/// Makes the tolerances of `raster` and of `regions`. A value of the raster that was rounded to float32
/// (sample_rounding) is rounded towards 0, so that no tolerance is above the one in its file; a sample without a value
/// has no tolerance. `grid`: the grid of the heights, with the tolerance beyond the regions, as for
/// region_tolerances(). At least one of raster and regions is given.
///
/// `raster` lies on the grid of the heights; find_grid_difference() checks that. The call becomes the owner of it. The
/// regions are not needed after the call. With in_windows the call reads the raster through once. Fails with kUsage
/// without raster and regions, for a raster of another size than the grid, and for one with a source where values are
/// asked for; with kInput, naming the raster's file, for a negative value, and where no sample has one and neither
/// regions nor a tolerance beyond them bound any; as the raster's source does; with kCancelled. REQUIRES: of the grid
/// as region_tolerances(), where there are regions. Cost: O(samples) for the raster; for regions that of
/// region_tolerances() or make_region_bounds().
Result<OwnedTolerances> make_tolerances(std::optional<OwnedHeightField> raster, std::span<const Region> regions,
                                        const RegionGrid& grid, const ToleranceOptions& options = {});

/// A weight for each sample, in 0 … 1.
struct OwnedWeights {
  std::vector<float> values;                   ///< for Tolerances::weights; empty where they have a source
  std::shared_ptr<const SampleSource> source;  ///< for Tolerances::weights_source; null where they are values

  bool empty() const { return values.empty() && !source; }
};

/// Makes the weights of a raster of weights: 0 where it has no value; all divided by the largest if that is above 1.
/// The call becomes the owner of the raster; with in_windows it reads it through once. Fails with kInput, naming the
/// raster's file, for a negative weight and where no weight is above 0; with kUsage for a raster with a source where
/// values are asked for; as the raster's source does; with kCancelled. Cost: O(samples).
Result<OwnedWeights> make_weights(OwnedHeightField raster, const ToleranceOptions& options = {});

}  // namespace scarp

#pragma GCC visibility pop
