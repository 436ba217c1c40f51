// The range of samples, and the values at its ends.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "scarp/height_field.h"

namespace scarp::grid {

/// The range of the samples that are finite and not `nodata`.
HeightRange range_of(std::span<const float> samples, std::optional<float> nodata = std::nullopt);

/// Adds samples: `valid` of them are heights from `least` to `most`, all others NaN.
void add_samples(HeightRange& range, std::span<const float> samples, float least, float most, std::uint64_t valid);

/// Sets all range fields of `info`.
void set_range(const HeightRange& range, RasterInfo& info);

}  // namespace scarp::grid
