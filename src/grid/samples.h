// A caller's samples, prepared for the engine.
#pragma once

#include <vector>

#include "grid/raster.h"
#include "scarp/height_field.h"
#include "scarp/result.h"

namespace scarp::grid {

/// Fails with kInput if the field is smaller than 2×2 or larger than the lattice, or has neither samples nor a source.
Result<void> check_size(const HeightField& field);

/// Borrows the field's samples if nodata is already NaN, as in fields from readers. Otherwise owns a cleaned copy, 4
/// bytes per sample.
class Samples {
 public:
  /// Fails as check_size(). REQUIRES: the field has its samples in memory.
  static Result<Samples> of(const HeightField& field);
  /// The samples that the engine refines. In a frame in space they are heights above the tangent plane at the raster's
  /// centre, for which straight lines in space stay straight to second order. In other frames, like of().
  static Result<Samples> to_refine(const HeightField& field, int threads);
  Raster raster() const { return raster_; }

 private:
  std::vector<float> cleaned_;
  Raster raster_;
};

}  // namespace scarp::grid
