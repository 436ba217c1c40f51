// Checks of options before a run begins: settings without conflicts, needs that are met, values within their range.
#pragma once

#include <optional>

#include "scarp/options.h"
#include "scarp/result.h"

namespace scarp {

/// Fails with kUsage for goals out of range or none, with kPromise for a max error below the rounding of the samples.
Result<void> check_values(const HeightField& field, const SimplifyOptions& options);

/// The same; with kUsage where settings do not go together, by the table of src/pieces/conflicts.h, for a setting
/// without another that it needs, and for values out of range; and as check_size().
Result<void> check_options(const HeightField& field, const SimplifyOptions& options);

/// Fails unless it is a number of at least 0, or none.
Result<void> check_max_error(const std::optional<double>& max_error);

}  // namespace scarp
