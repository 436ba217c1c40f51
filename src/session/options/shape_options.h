// The options for the shape of triangles.
#pragma once

#include "scarp/options.h"
#include "session/options/given_options.h"

namespace scarp::cli {

Result<ShapeGoals> parse_shape(const GivenOptions& given);
/// The first that was given; nothing if none was.
std::optional<OptionId> find_shape(const GivenOptions& given);

}  // namespace scarp::cli
