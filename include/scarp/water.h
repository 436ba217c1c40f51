// Standing water: lakes that are flat.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/lines.h"
#include "scarp/progress.h"
#include "scarp/result.h"

#pragma GCC visibility push(default)

namespace scarp {

struct Lake {
  std::string name;
  double level = 0;           ///< the elevation of all of it
  std::uint64_t samples = 0;  ///< that were put onto the level
  std::uint64_t raised = 0;   ///< around it that were put above the level
  double largest_change = 0;  ///< of a sample
  std::uint64_t bytes = 0;    ///< that the field keeps for it, where its samples are not in memory as one array
  std::vector<Line> shore;    ///< its rings, at the level: breaklines for SimplifyOptions::breaklines
};

/// How lakes are made flat.
struct WaterOptions {
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};  ///< from samples to the coordinates of the lines: map_affine()
  /// The level is the height of the shore below which this share of it lies, in percent, 0 … 100: most of a shore is
  /// too high, for a cell of it holds more land than water.
  double percentile = 5;
  /// Samples around a lake that lie lower than this above its level are put there, in z units, above 0.
  double freeboard = 0.01;
  /// As in SimplifyOptions: bytes that the process is to stay under, 0 for no limit, and what others take of them. What
  /// cannot fit is refused with kUsage. DEFAULT: no limit.
  std::uint64_t memory_limit = 0, memory_taken = 0;
  ProgressCallback progress = {};  ///< of the pass "water"
};

/// Makes each polygon of `lines` flat: all valid samples in it, even-odd by its rings, take the level that the
/// percentile of its shore says. The shore is the raster's surface along all its rings, looked at twice a sample. Then
/// those of the eight neighbours of its samples that belong to no lake and are lower than level + freeboard are put
/// there, so that water has a rim. Lakes are taken in the order of `lines`; what two of them hold belongs to the later
/// one. Levels are those of the field as it is given. Polygons without a valid sample on their shore are left out, as
/// lines are.
///
/// A field with a source is given another, in which the samples are those that they would be in memory; lakes are the
/// same either way. It then keeps Lake::bytes, in proportion to shores, however large the lakes are.
///
/// A mesh with the shores as breaklines and vertices on samples is level within each lake: all corners of its triangles
/// are. REQUIRES: the affine map can be inverted. Fails with kUsage for options out of range, with kCancelled; as the
/// field's source does, and beside one with kInput for shores whose coordinates are too large. Memory: as breaklines.
/// Cost: O(samples in and around the lakes, and n log n for shores along n samples); of a source the rows of lakes are
/// read once, and those of shores before.
Result<std::vector<Lake>> flatten_lakes(OwnedHeightField& field, std::span<const Line> lines,
                                        const WaterOptions& options);

struct FlatOptions {
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};  ///< from samples to the coordinates of shores: map_affine()
  std::uint64_t min_samples = 100;                 ///< at least 3
  /// As in WaterOptions; what shores will take as breaklines counts. DEFAULT: no limit.
  std::uint64_t memory_limit = 0, memory_taken = 0;
  ProgressCallback progress = {};  ///< of the pass "flats"
};

/// The flat areas of the raster: at least so many samples of one height, connected side by side. Nothing is changed;
/// their shores run from sample to sample, around the cells, and the halves of cells, whose corners belong to them. A
/// mesh with these as breaklines and vertices on samples is level within each. In the order of their first samples.
/// What is nowhere two samples wide has no area, and is left out. Fails with kUsage for fewer than 3 samples, with
/// kCancelled, and as the field's source does. Memory: 24 bytes for each run of samples of one height in a row that
/// belongs to an area whose end has not been seen. Cost: O(samples); a source's rows are read once, from the top down.
Result<std::vector<Lake>> find_flats(const OwnedHeightField& field, const FlatOptions& options);

}  // namespace scarp

#pragma GCC visibility pop
