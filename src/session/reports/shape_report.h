// The shapes of triangles that were asked for, and those that were made.
#pragma once

#include <string>
#include <vector>

#include "scarp/options.h"
#include "scarp/simplify.h"
#include "session/text/json.h"

namespace scarp::cli {

/// The "shape" object of a report; null where nothing was asked.
Json describe_shape(const ShapeGoals& goals, const Simplified& simplified);
/// Line of the summary; empty where nothing was asked.
std::string shape_line(const ShapeGoals& goals, const Simplified& simplified);
/// Warns of the goals that yielded to others, in numbers.
void warn_of_shapes(const ShapeGoals& goals, const Simplified& simplified, std::vector<std::string>& warnings);

}  // namespace scarp::cli
