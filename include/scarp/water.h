// Standing water: lakes that are flat.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/lines.h"
#include "scarp/result.h"

namespace scarp {

struct Lake {
  std::string name;
  double level = 0;           ///< the elevation of all of it
  std::uint64_t samples = 0;  ///< that were put onto the level
  std::uint64_t raised = 0;   ///< around it that were put above the level
  double largest_change = 0;  ///< of a sample
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
};

/// Makes each polygon of `lines` flat: all valid samples in it, even-odd by its rings, take the level that the
/// percentile of its shore says. The shore is the raster's surface along all its rings, looked at twice a sample. Then
/// those of the eight neighbours of its samples that belong to no lake and are lower than level + freeboard are put
/// there, so that water has a rim. Lakes are taken in the order of `lines`; what two of them hold belongs to the later
/// one. Levels are those of the field as it is given. Polygons without a valid sample on their shore are left out, as
/// lines are.
///
/// A mesh with the shores as breaklines and vertices on samples is level within each lake: all corners of its triangles
/// are. REQUIRES: the field has its samples in memory; the affine map can be inverted. Fails with kUsage for options
/// out of range. Cost: O(samples) a lake.
Result<std::vector<Lake>> flatten_lakes(OwnedHeightField& field, std::span<const Line> lines,
                                        const WaterOptions& options);

struct FlatOptions {
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};  ///< from samples to the coordinates of shores: map_affine()
  std::uint64_t min_samples = 100;                 ///< at least 3
};

/// The flat areas of the raster: at least so many samples of one height, connected side by side. Nothing is changed;
/// their shores run from sample to sample, around the cells, and the halves of cells, whose corners belong to them. A
/// mesh with these as breaklines and vertices on samples is level within each. In the order of their first samples.
/// What is nowhere two samples wide has no area, and is left out. REQUIRES: the field has its samples in memory, or
/// fails with kUsage, as it does for fewer than 3 samples. Cost: O(samples, and those of each area's box).
Result<std::vector<Lake>> find_flats(const OwnedHeightField& field, const FlatOptions& options);

}  // namespace scarp
