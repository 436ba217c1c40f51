// The requested and the reached shapes of triangles.
#pragma once

#include <string>
#include <vector>

#include "scarp/options.h"
#include "scarp/simplify.h"
#include "session/text/json.h"

namespace scarp::cli {

/// The "shape" object of a report; null without shape goals.
Json describe_shape(const ShapeGoals& goals, const Simplified& simplified);
/// A line of the summary; empty without shape goals.
std::string shape_line(const ShapeGoals& goals, const Simplified& simplified);
/// Warns of shapes that miss a goal because other goals have priority, with numbers.
void warn_of_shapes(const ShapeGoals& goals, const Simplified& simplified, std::vector<std::string>& warnings);

}  // namespace scarp::cli
