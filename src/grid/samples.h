// A caller's samples, prepared for the engine.
#pragma once

#include <vector>

#include "grid/raster.h"
#include "scarp/height_field.h"
#include "scarp/result.h"

namespace scarp {

/// Fails with kInput if the field is smaller than 2×2 or larger than the lattice, or has neither samples nor source.
Result<void> check_size(const HeightField& field);

/// Borrows the field's samples if nodata is NaN already (as readers deliver them); else owns a cleaned copy, 4 bytes a
/// sample.
class Samples {
 public:
  /// Fails as check_size(). REQUIRES: the field has its samples in memory.
  static Result<Samples> of(const HeightField& field);
  /// Those that the engine refines: in a frame in space the heights above the tangent plane at the raster's centre,
  /// where what is straight in space is straight, to second order; else as of().
  static Result<Samples> to_refine(const HeightField& field, int threads);
  Raster raster() const { return raster_; }

 private:
  std::vector<float> cleaned_;
  Raster raster_;
};

}  // namespace scarp
