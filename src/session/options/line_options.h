// Options for lines, lakes, rivers and cuts.
#pragma once

#include "scarp/features.h"
#include "scarp/lines.h"
#include "session/options/given_options.h"

namespace scarp::cli {

/// The first option given that adds lines of a file to the mesh, if any.
std::optional<OptionId> find_lines(const GivenOptions& given);
/// The first option given that adds lakes, if any.
std::optional<OptionId> find_lakes(const GivenOptions& given);
/// The first option given that cuts along polygons, if any.
std::optional<OptionId> find_cut(const GivenOptions& given);
/// Fails with kUsage for an invalid value of these options.
Result<void> check_lines(const GivenOptions& given);

/// The rule for lines of different heights that meet; nothing if not given. REQUIRES, here and below: check_lines() has
/// passed.
std::optional<LineConflict> conflict_rule(const GivenOptions& given);
std::optional<WallGoals> wall_goals(const GivenOptions& given);
std::optional<RidgeGoals> ridge_goals(const GivenOptions& given);

}  // namespace scarp::cli
