// The samples under a patch in a buffer of their own: rows of the raster lie so far apart that a small triangle's
// samples compete for the same lines of a cache.
#pragma once

#include <span>
#include <vector>

#include "fit/patch.h"
#include "fit/triangle_error.h"
#include "grid/raster.h"

namespace scarp {

/// Keeps its memory between patches.
class SampleWindow {
 public:
  /// The errors of triangles of the patch. A few long triangles may reach over samples that no other looks at: then
  /// they are read where they are. The window and the raster stay alive, and unchanged, as long as the errors.
  /// `bounds`: of the raster's samples, or empty; where all that the patch looks at are equal they are its threshold,
  /// else it has bounds.
  TriangleError errors(const Raster& raster, std::span<const float> bounds, const Patch& patch, double threshold);

 private:
  std::vector<float> samples_, bounds_;
};

}  // namespace scarp
