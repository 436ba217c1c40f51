// Checks of options before a run begins: settings without conflicts, needs that are met, values within their range.
#pragma once

#include "scarp/result.h"
#include "scarp/simplify.h"

namespace scarp {

/// Fails with kUsage for goals out of range or none, with kPromise for a max error below the rounding of the samples.
Result<void> check_values(const HeightField& field, const SimplifyOptions& options);

/// Fails with kUsage where settings do not go together, by the table of scarp/conflicts.h.
Result<void> check_conflicts(const HeightField& field, const SimplifyOptions& options);

/// Fails with kUsage for a setting without another that it needs, and for values out of range.
Result<void> check_needs(const HeightField& field, const SimplifyOptions& options);

/// True if the dominant order can reach the goals.
bool may_be_dominant(const HeightField& field, const SimplifyOptions& options);

/// The effort that is made: that which was asked for, or what Effort::kAuto stands for. REQUIRES: no conflicts.
Effort choose_effort(const HeightField& field, const SimplifyOptions& options);

}  // namespace scarp
