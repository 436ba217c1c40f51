// The samples under a patch in a buffer of their own: rows of the raster lie so far apart that a small triangle's
// samples compete for the same lines of a cache.
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

namespace scarp {

/// Copies samples of a raster that are not in memory, `stride` floats a row.
using ReadWindow = std::function<void(const Patch::Window& window, float* to, std::ptrdiff_t stride)>;

/// Keeps its memory between patches.
class SampleWindow {
 public:
  /// The errors of triangles of the patch. A few long triangles may reach over samples that no other reads: then they
  /// are read in place. The window and the raster stay alive, and unchanged, as long as the errors. `bounds`: of the
  /// raster's samples, or empty; where all that the patch reads are equal they are its threshold, else it has bounds.
  /// `norm`: of whose fields errors are; null: of heights alone.
  TriangleError errors(const Raster& raster, std::span<const float> bounds, const FitNorm* norm, const Patch& patch,
                       double threshold);
  /// The errors of heights alone, whose samples are read, and their bounds if they have some of their own.
  TriangleError errors(const ReadWindow& read, const ReadWindow& read_bounds, const Patch& patch, double threshold);
  /// The errors at scattered samples.
  TriangleError errors(const ScatteredSamples& points, const Patch& patch, double threshold);

 private:
  std::vector<float> samples_, bounds_;
  std::vector<std::vector<float>> fields_;
  std::optional<NormError> norm_;
  std::unique_ptr<ScatteredErrors> scattered_;
};

}  // namespace scarp
