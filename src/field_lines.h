// What breaklines and cutlines ask of a height field, made ready for the engine.
#pragma once

#include <cstdint>
#include <vector>

#include "refine/constraints.h"
#include "scarp/cutline.h"
#include "scarp/height_field.h"
#include "scarp/result.h"
#include "scarp/simplify.h"

namespace scarp {

struct FieldLines {
  ConstraintGraph graph;
  /// The raster's, NaN where void and well beyond a cutline, with those on hard lines at the height of the line.
  /// EMPTY: as the field has them.
  std::vector<float> samples;
  std::vector<SampleEdit> edits;  ///< of these samples
  std::uint64_t laid = 0;         ///< breaklines of which some part lies in the raster, but for those laid first
  std::uint64_t valid = 0;        ///< samples, before the cut

  /// `field` with these samples, which stay here.
  HeightField apply(const HeightField& field) const;
};

/// Soft lines, and the rings of the cutline, are given vertices of their own where they are straight for so long that
/// the raster beside them leaves them by more than `tolerance`. Of breaklines the graph has what lies in the cutline.
/// Fails as place_breaklines(), and with kInput where no surface lies in the cutline. REQUIRES: the field has its
/// samples in memory and is no larger than the lattice; tolerance >= 0; lines and cutline in the same coordinates.
Result<FieldLines> prepare_lines(const HeightField& field, const LineConstraints& lines, const Cutline& cutline,
                                 double tolerance, int threads);

}  // namespace scarp
