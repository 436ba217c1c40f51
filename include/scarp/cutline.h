// Cutlines: polygons at which the surface ends.
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

/// Rings as they are, and closed lines as polygons of their own. Fails with kInput for an open line, and names it.
Result<std::vector<Line>> close_rings(std::vector<Line> lines);

/// Result of mask_outside().
struct MaskedOutside {
  std::uint64_t lost = 0;    ///< heights outside
  std::uint64_t kept = 0;    ///< heights within
  bool has_surface = false;  ///< some cell of the grid has three or four heights within
  std::uint64_t bytes = 0;   ///< additional memory of the field's source from now on
};

/// Makes all samples outside the polygons nodata: a cut along the cells of the grid, where a cut along the polygons
/// themselves is not possible. For a field that is not in memory the samples are nodata from now on whenever they are
/// read; the field is read once, to count. Then `info` has the range of the heights before the cut, if it had none.
/// Fails as the field's source and with kCancelled. REQUIRES: the affine map can be inverted. Cost: O(samples +
/// segments · rows that they cross).
Result<MaskedOutside> mask_outside(OwnedHeightField& field, const Cutline& cutline,
                                   const ProgressCallback& progress = {});

}  // namespace scarp

#pragma GCC visibility pop
