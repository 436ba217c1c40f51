// Levels of detail: meshes of one raster that replace each other.
#pragma once

#include <vector>

#include "scarp/height_field.h"
#include "scarp/result.h"
#include "scarp/simplify.h"

#pragma GCC visibility push(default)

namespace scarp {

struct Levels {
  int count = 1;     ///< 1 to 32
  double ratio = 2;  ///< ratio of the max error of a level to that of the next finer one, above 1
};

/// The meshes for max errors E, ratio · E, ratio² · E …, the finest first; E is the max error of `options`. Each is
/// simplified from the full raster, and proven for its own max error. All have one outline, a locked border (Border)
/// for the max error E, or as `options` have it: where one level replaces another, no gap opens to whatever meets the
/// raster's edge. Each level has the affine map and the origin of the others.
///
/// Cost: that of as many runs; coarse ones are faster. Fails as simplify() does; with kUsage for a count or a ratio out
/// of range, without a max error, and for what does not go with levels (docs/conflicts.md).
Result<std::vector<Simplified>> simplify_levels(const HeightField& field, const SimplifyOptions& options,
                                                const Levels& levels);

}  // namespace scarp

#pragma GCC visibility pop
