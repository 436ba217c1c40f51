// Checks of a live field's inputs.
#pragma once

#include <cstddef>
#include <span>

#include "live/field_samples.h"
#include "scarp/height_field.h"
#include "scarp/live.h"
#include "scarp/result.h"

namespace scarp::live {

Result<void> check_field(const HeightField& field, const LiveOptions& options, std::span<const float> tolerances);
/// `heights`: the number of heights.
Result<void> check_window(const LiveWindow& window, const FieldSamples& samples, std::size_t heights,
                          std::span<const float> tolerances, std::span<const std::span<const float>> channels);
Result<void> check_scroll(const Area& area, int cols, int rows);

}  // namespace scarp::live
