// Small enclosed voids: missing samples that can be filled from the heights around them.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/result.h"

namespace scarp::grid {

/// Fills enclosed voids of at most `side` × `side` samples. Returns the counts. REQUIRES: the samples are in memory as
/// floats. Cost: O(samples + bounding boxes of the voids).
VoidCount fill_small_voids(OwnedHeightField& field, int side);

/// The samples of a field with these voids filled. A sample is the same in every window. A window without missing
/// samples is read once. A window with a small void across its border is read again with `side` more samples around it.
/// Borrows the field; `owner` may own the field's source.
std::shared_ptr<const SampleSource> without_small_voids(const HeightField& field, int side,
                                                        std::shared_ptr<const SampleSource> owner = nullptr);

/// The number of voids to fill in the whole field. Cost: reads the field once. Memory: a few rows, and 50 bytes per
/// void.
Result<VoidCount> count_voids(const HeightField& field, int side);

}  // namespace scarp::grid
