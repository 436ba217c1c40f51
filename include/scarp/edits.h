// Samples changed by lines.
#pragma once

#include <memory>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/simplify.h"

#pragma GCC visibility push(default)

namespace scarp {

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
