// Voids that are enclosed and small: missing samples that heights around them explain.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/result.h"

namespace scarp {

/// Fills enclosed voids of at most `side` samples a side. Returns what it found. REQUIRES: the samples are in memory as
/// floats. Cost: O(samples), and the boxes of the voids.
VoidCount fill_small_voids(OwnedHeightField& field, int side);

/// The samples of a field with such voids filled, the same heights, whichever windows are read: a window without
/// missing samples costs its own reading; one with a small void across its border is read again with `side` samples
/// more around it. The field is borrowed, but for its source where `owner` holds that.
std::shared_ptr<const SampleSource> without_small_voids(const HeightField& field, int side,
                                                        std::shared_ptr<const SampleSource> owner = nullptr);

/// The number of voids to fill, from all rows. Cost: reads the field once. Memory: a few rows, and 50 bytes a void.
Result<VoidCount> count_voids(const HeightField& field, int side);

}  // namespace scarp
