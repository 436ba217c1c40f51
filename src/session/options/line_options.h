// Lines, lakes and rivers, as options name them.
#pragma once

#include "scarp/features.h"
#include "scarp/lines.h"
#include "session/options/given_options.h"

namespace scarp::cli {

/// The option that puts lines of a file into the mesh; nothing if there is none.
std::optional<OptionId> find_lines(const GivenOptions& given);
/// The option that asks for lakes; nothing if there is none.
std::optional<OptionId> find_lakes(const GivenOptions& given);
/// The option that asks for a cut along polygons; nothing if there is none.
std::optional<OptionId> find_cut(const GivenOptions& given);
/// Fails with kUsage for a value of these options that is none.
Result<void> check_lines(const GivenOptions& given);

/// The rule where lines of different heights meet; nothing if it was not given. REQUIRES: check_lines() has passed,
/// here and below.
std::optional<LineConflict> conflict_rule(const GivenOptions& given);
std::optional<WallGoals> wall_goals(const GivenOptions& given);
std::optional<RidgeGoals> ridge_goals(const GivenOptions& given);

}  // namespace scarp::cli
