// Samples that lines changed.
#pragma once

#include <memory>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/simplify.h"

#pragma GCC visibility push(default)

namespace scarp {

/// `source` with the samples that Simplified::edits tells of: what the promise of a mesh with hard lines is about.
/// `edits`: in raster order, of samples that are no voids. Cost: a window's own, and a search for its first edit in
/// each row.
std::shared_ptr<const SampleSource> edit_source(std::shared_ptr<const SampleSource> source,
                                                std::vector<SampleEdit> edits);

/// Gives the samples of `field` the heights after the edits, in memory or by edit_source(). Without edits nothing
/// changes. `edits`: as above. Cost: O(edits).
void apply_edits(const std::vector<SampleEdit>& edits, OwnedHeightField& field);

}  // namespace scarp

#pragma GCC visibility pop
