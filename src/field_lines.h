// What breaklines ask of a height field, made ready for the engine.
#pragma once

#include <cstdint>
#include <vector>

#include "refine/constraints.h"
#include "scarp/height_field.h"
#include "scarp/result.h"
#include "scarp/simplify.h"

namespace scarp {

struct FieldLines {
  ConstraintGraph graph;
  /// The raster's, NaN where void, with those on hard lines at the height of the line. EMPTY: as the field has them.
  std::vector<float> samples;
  std::vector<SampleEdit> edits;
  std::uint64_t laid = 0;  ///< lines of which some part lies in the raster

  /// `field` with these samples, which stay here.
  HeightField apply(const HeightField& field) const;
};

/// Soft lines are given vertices of their own where they are straight for so long that the raster beside them leaves
/// them by more than `tolerance`. Fails as place_breaklines(). REQUIRES: the field has its samples in memory and is no
/// larger than the lattice; tolerance >= 0.
Result<FieldLines> prepare_lines(const HeightField& field, const LineConstraints& lines, double tolerance, int threads);

}  // namespace scarp
