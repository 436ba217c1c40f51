// Running water: lines that never rise downstream.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/lines.h"
#include "scarp/result.h"
#include "scarp/water.h"

#pragma GCC visibility push(default)

namespace scarp {

struct River {
  std::string name;
  double source = 0, mouth = 0;  ///< heights of its ends, or of its first and last point in the raster
  double deepest_cut = 0;        ///< its largest depth below the raster
  bool is_turned = false;        ///< it flows against the order of its points as given
  Line course;                   ///< with heights: a breakline for Features::breaklines that yields to shores
};

struct RiverOptions {
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};  ///< from samples to the coordinates of the lines: map_affine()
  /// The most by which a course may differ from the exact one between its vertices, in z units, at least 0. DEFAULT: 0,
  /// two vertices a sample.
  double tolerance = 0;
};

/// Gives each line of `lines` heights that never rise downstream. Each line flows from the end where the raster is
/// higher to the other end. The height of a point is the lowest of the raster's surface there and upstream. Rivers that
/// share a vertex share its height, the lowest of all, so that a confluence is no step. Within `lakes`, which
/// flatten_lakes() or find_flats() made of this field, and less than a sample away from them, rivers have the lake's
/// level, even where that is a rise.
///
/// Parts outside the raster and in nodata have no heights. Rings, and lines without any height, are omitted. The raster
/// does not change: as hard breaklines, rivers run in gorges a sample wide where they lie below it. Heights are
/// float32. Fails with kUsage for a negative tolerance, and as the field's source does. REQUIRES: the affine map can be
/// inverted. Cost: O(n log n) for lines and shores along n samples.
Result<std::vector<River>> carve_rivers(const HeightField& field, std::span<const Line> lines,
                                        std::span<const Lake> lakes, const RiverOptions& options);

}  // namespace scarp

#pragma GCC visibility pop
