// Samples changed by lines.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "scarp/height_field.h"

#pragma GCC visibility push(default)

namespace scarp {

/// A sample that a breakline changed.
struct SampleEdit {
  std::int32_t col = 0, row = 0;
  float before = 0, after = 0;
};

/// `source` with the changed samples of Simplified::edits. The promise of a mesh with hard lines refers to these
/// samples. `edits`: in raster order, of valid samples. Cost: that of a window, and a search for its first edit in each
/// row.
std::shared_ptr<const SampleSource> edit_source(std::shared_ptr<const SampleSource> source,
                                                std::vector<SampleEdit> edits);

/// Applies the edits to `field`, in memory or by edit_source(). Without edits nothing changes. `edits`: as above. Cost:
/// O(edits).
void apply_edits(const std::vector<SampleEdit>& edits, OwnedHeightField& field);

}  // namespace scarp

#pragma GCC visibility pop
