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
#include "scarp/run.h"

#pragma GCC visibility push(default)

namespace scarp {

struct Lake {
  std::string name;
  double level = 0;           ///< the elevation of all of it
  std::uint64_t samples = 0;  ///< samples put onto the level
  std::uint64_t raised = 0;   ///< samples around it put above the level
  double largest_change = 0;  ///< largest change of a sample
  std::uint64_t bytes = 0;    ///< bytes that the field keeps for it, where its samples are not in memory as one array
  std::vector<Line> shore;    ///< its rings, at the level: breaklines for Features::breaklines
};

/// How lakes are made flat.
struct WaterOptions {
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};  ///< from samples to the coordinates of the lines: map_affine()
  /// The level is this percentile of the heights along the shore, 0 … 100. Most of a shore is too high, because a cell
  /// of it holds more land than water.
  double percentile = 5;
  /// Samples around a lake are raised to at least this height above its level, in z units, above 0.
  double freeboard = 0.01;
  /// Like SimplifyOptions::run: the memory limit of the process in bytes, 0 for none, and the bytes of it that others
  /// use. Lakes that do not fit are refused with kUsage. DEFAULT: no limit.
  Run run = {};  ///< memory; progress: of the pass "water"
};

/// Makes each polygon of `lines` flat: all valid samples in it, even-odd by its rings, get the level given by the
/// percentile of its shore. The shore is the raster's surface along all its rings, at two points a sample. Then the
/// eight neighbours of its samples that belong to no lake and are lower than level + freeboard are raised to that
/// height, so that the water has a rim. Lakes are processed in the order of `lines`; a sample in two of them belongs to
/// the later one. Levels are those of the field as given. Polygons without a valid sample on their shore are omitted,
/// as lines are.
///
/// A field with a source receives another source, with the same samples as the field would have in memory; lakes are
/// the same either way. It then keeps Lake::bytes, in proportion to shores, however large the lakes are.
///
/// A mesh with the shores as breaklines and vertices on samples is level within each lake: all corners of its triangles
/// are at the level. REQUIRES: the affine map can be inverted. Fails with kUsage for options out of range, with
/// kCancelled; as the field's source does, and with a source with kInput for shores whose coordinates are too large.
/// Memory: as breaklines. Cost: O(samples in and around the lakes, and n log n for shores along n samples); of a source
/// the rows of shores are read first, then the rows of lakes, once.
Result<std::vector<Lake>> flatten_lakes(OwnedHeightField& field, std::span<const Line> lines,
                                        const WaterOptions& options);

/// The lakes of flatten_lakes(), with their levels and shores; the field does not change. Options and failures as
/// there, but that no memory for samples is used. Cost: of a source the rows of shores are read.
Result<std::vector<Lake>> find_lakes(const HeightField& field, std::span<const Line> lines,
                                     const WaterOptions& options);

struct FlatOptions {
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};  ///< from samples to the coordinates of shores: map_affine()
  std::uint64_t min_samples = 100;                 ///< at least 3
  /// Like WaterOptions::run; the memory of the shores as breaklines counts. DEFAULT: no limit.
  Run run = {};  ///< memory; progress: of the pass "flats"
};

/// The flat areas of the raster: at least min_samples samples of one height, connected side by side. The field does not
/// change. Shores run from sample to sample, around the cells and half cells whose corners belong to the area. A mesh
/// with the shores as breaklines and vertices on samples is level within each area. Areas are in the order of their
/// first samples. An area that is nowhere two samples wide is omitted. Fails with kUsage for fewer than 3 samples, with
/// kCancelled, and as the field's source does. Memory: 24 bytes for each run of samples of one height in a row, in
/// areas whose end has not been reached. Cost: O(samples); a source's rows are read once, from the top down.
Result<std::vector<Lake>> find_flats(const OwnedHeightField& field, const FlatOptions& options);

}  // namespace scarp

#pragma GCC visibility pop
