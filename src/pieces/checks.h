// Checks options before a run: conflicts, missing prerequisites, ranges.
#pragma once

#include <optional>

#include "scarp/options.h"
#include "scarp/result.h"

namespace scarp::pieces {

/// Fails with kUsage for goals that are missing or out of range, and with kPromise for a max error below the samples'
/// rounding.
Result<void> check_values(const HeightField& field, const SimplifyOptions& options);

/// Fails if check_values() or check_size() fails, and with kUsage for conflicting settings (src/pieces/conflicts.h) and
/// missing prerequisites.
Result<void> check_options(const HeightField& field, const SimplifyOptions& options);

/// Fails with kUsage for goals out of range. `spacing`: between samples.
Result<void> check_shape_goals(const ShapeGoals& shape, double spacing);

/// Fails unless the value is absent or in 0 … 0.5.
Result<void> check_min_shape(const std::optional<double>& min_shape);
/// Fails unless the value is absent or a number of at least 0.
Result<void> check_max_error(const std::optional<double>& max_error);

}  // namespace scarp::pieces
