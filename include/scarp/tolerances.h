// Give samples individual bounds: from a raster of tolerances, regions of interest, or both (the smaller bound counts).
// Or give them weights from a raster.
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

// Regions of interest: tolerances are small in a region, and grow with the distance from it.

struct Region {
  /// Lines from read_lines(). A polygon contains its rings and all points in its outer ring but not in its holes
  /// (even-odd, also for bow-ties and overlapping rings). A line contains only its own points.
  std::vector<Line> lines;
  double tolerance = 0;  ///< tolerance in the region, in z units, at least 0
};

/// The grid of the samples, and the tolerance beyond the regions.
struct RegionGrid {
  int cols = 0, rows = 0;
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};  ///< map from samples to the coordinates of the lines: map_affine()
  double cell_x = 1, cell_y = 1;                   ///< distances between samples, in the unit of `falloff`
  double falloff = 0;                              ///< distance at which the tolerance reaches `beyond`; 0: at once
  std::optional<double> beyond = {};               ///< tolerance elsewhere; nothing: no bound. REQUIRED if falloff > 0.
};

/// Computes a tolerance for each sample, row-major, for Tolerances::values. It is t in a region of tolerance t, and t +
/// (beyond − t) · min(1, d / falloff) at a distance d from the region. With several regions, the smallest tolerance
/// counts. It is +infinity if no tolerance applies. The samples nearest to rings and lines belong to their region, so
/// even a region smaller than a cell has samples. Distances are those between samples (exact, Euclidean). Tolerances
/// are rounded down to float32. `found`: for each region, true if any part of it lies in the raster; may be null.
/// REQUIRES: cols, rows, cell_x, cell_y > 0; falloff >= 0; the affine map can be inverted. Cost: O(samples + segments ·
/// rows that they cross) for each region. Memory: the result, and that of RegionBounds.
std::vector<float> region_tolerances(std::span<const Region> regions, const RegionGrid& grid,
                                     std::vector<bool>* found = nullptr);

/// The tolerances of region_tolerances(), bit for bit, computed on reading.
struct RegionBounds {
  /// For Tolerances::source and MeasureOptions::tolerance_source; never fails. Cost of a window: O(samples). If falloff
  /// > 0, each region near the window costs at least as much as in a window with rows of a thousand samples, or of six
  /// times the falloff.
  std::shared_ptr<const SampleSource> source;
  std::vector<bool> found;  ///< for each region, true if any part of it lies in the raster
  /// Bytes of memory: 8 for each region and column, 8 for each sample on a region's outline, and the buffers of
  /// `threads` readers.
  std::uint64_t bytes = 0;
};
/// `threads`: as Run::threads. The regions are not needed after the call. REQUIRES: as region_tolerances().
RegionBounds make_region_bounds(std::span<const Region> regions, const RegionGrid& grid, int threads = 1);

/// Individual bounds of samples.
struct Tolerances {
  /// A bound for each sample, at least 0, in z units; +infinity: none. |error| <= tolerance at every valid sample, and
  /// |error| <= max_error if given; samples are ranked by |error| / tolerance. Tolerances are a goal: if they do not
  /// fit a budget, one factor enlarges all of them (see "Budgets" at simplify()). Borrowed. DEFAULT: empty.
  std::span<const float> values = {};
  /// The same tolerances for a field with a source, read in windows like its samples; never NaN. simplify() fails with
  /// kUsage for `values` with a field that has a source, and for `source` with samples in memory. Borrowed. DEFAULT:
  /// none.
  const SampleSource* source = nullptr;
  /// A weight for each sample, at least 0 and finite (Terra's importance mask): samples are ranked by weight · |error|,
  /// and max_error bounds this product. Weight 0 means no bound. Borrowed. DEFAULT: empty, all 1.
  std::span<const float> weights = {};
  /// The same weights for a field with a source. Borrowed. DEFAULT: none.
  const SampleSource* weights_source = nullptr;
  /// Samples without a bound, which never become vertices because of their errors. Borrowed. DEFAULT: none.
  std::span<const SampleAt> ignored = {};
};

struct ToleranceOptions {
  /// True: returns a source that computes tolerances or weights on reading, for heights with a source. False: returns
  /// values, for heights in memory. DEFAULT: false.
  bool in_windows = false;
  Run run = {};  ///< number of threads that will read windows; progress of the pass "read", if a whole raster is read
};

/// A tolerance for each sample, in z units, at least 0; +infinity: none.
struct OwnedTolerances {
  std::vector<float> values;                   ///< for Tolerances::values; empty with a source
  std::shared_ptr<const SampleSource> source;  ///< for Tolerances::source; null with values
  std::vector<bool> found;                     ///< for each region, true if any part of it lies in the raster
  std::uint64_t bytes = 0;                     ///< memory of the regions in bytes, with a source
  bool has_values = false;                     ///< true if some sample of the raster has a value
};

/// Makes the tolerances of `raster` and of `regions`. Values of the raster that do not fit float32 (sample_rounding)
/// are rounded towards 0, so that no tolerance exceeds the one in its file. A sample without a value has no tolerance.
/// `grid`: the grid of the heights, with the tolerance beyond the regions, as for region_tolerances(). At least one of
/// raster and regions is required.
///
/// `raster` lies on the grid of the heights; find_grid_difference() checks that. The call becomes the owner of
/// `raster`. The regions are not needed after the call. With in_windows, the call reads the whole raster once. Fails
/// with kUsage with neither raster nor regions, for a raster of another size than the grid, and for a raster with a
/// source if values are requested. Fails with kInput, naming the raster's file, for a negative value, and if no sample
/// has a bound from the raster, a region or the tolerance beyond them. Fails as the raster's source does, and with
/// kCancelled. REQUIRES: for regions, the grid as in region_tolerances(). Cost: O(samples) for the raster; for regions
/// that of region_tolerances() or make_region_bounds().
Result<OwnedTolerances> make_tolerances(std::optional<OwnedHeightField> raster, std::span<const Region> regions,
                                        const RegionGrid& grid, const ToleranceOptions& options = {});

/// A weight for each sample, in 0 … 1.
struct OwnedWeights {
  std::vector<float> values;                   ///< for Tolerances::weights; empty with a source
  std::shared_ptr<const SampleSource> source;  ///< for Tolerances::weights_source; null with values

  bool empty() const { return values.empty() && !source; }
};

/// Makes the weights from a raster of weights; 0 where the raster has no value. If the largest weight is above 1, all
/// weights are divided by it. The call becomes the owner of the raster, and with in_windows reads it once. Fails with
/// kInput, naming the raster's file, for a negative weight and if no weight is above 0; with kUsage for a raster with a
/// source if values are requested; as the raster's source does; with kCancelled. Cost: O(samples).
Result<OwnedWeights> make_weights(OwnedHeightField raster, const ToleranceOptions& options = {});

}  // namespace scarp

#pragma GCC visibility pop
