// The samples under a patch in a separate buffer. Rows of the raster are so far apart in memory that a small triangle's
// samples compete for the same cache lines.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "fit/fit_norm.h"
#include "fit/norm_error.h"
#include "fit/patch.h"
#include "fit/scattered_samples.h"
#include "fit/triangle_error.h"
#include "grid/raster.h"

namespace scarp::fit {

/// Copies samples that are not in memory, `stride` floats per row.
using ReadWindow = std::function<void(const Patch::Window& window, float* to, std::ptrdiff_t stride)>;

/// Reuses its memory for the next patch.
class SampleWindow {
 public:
  /// The errors of triangles of the patch. If the window is large for few triangles, its samples are read in place. The
  /// window and the raster must stay alive and unchanged while the errors are used. `bounds`: bounds of the raster's
  /// samples, or empty; if all in the window are equal, they replace the threshold. `norm`: combines several fields;
  /// null: errors of heights only.
  TriangleError errors(const grid::Raster& raster, std::span<const float> bounds, const FitNorm* norm,
                       const Patch& patch, double threshold);
  /// The errors of heights only. `read` supplies the samples, and `read_bounds`, if not empty, their bounds.
  TriangleError errors(const ReadWindow& read, const ReadWindow& read_bounds, const Patch& patch, double threshold);
  /// The errors at scattered samples.
  TriangleError errors(const ScatteredSamples& points, const Patch& patch, double threshold);

 private:
  std::vector<float> samples_, bounds_;
  std::vector<std::vector<float>> fields_;
  std::optional<NormError> norm_;
  std::unique_ptr<ScatteredErrors> scattered_;
};

}  // namespace scarp::fit
