// The options for the shape of triangles.
#pragma once

#include "scarp/options.h"
#include "session/options/given_options.h"

namespace scarp::cli {

Result<ShapeGoals> parse_shape(const GivenOptions& given);
/// The first shape option that was given, if any.
std::optional<OptionId> find_shape(const GivenOptions& given);

}  // namespace scarp::cli
