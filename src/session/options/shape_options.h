// Shapes of triangles that are asked for, and what became of them.
#pragma once

#include <string>
#include <vector>

#include "scarp/shape.h"
#include "scarp/simplify.h"
#include "session/options/values.h"
#include "session/text/json.h"

namespace CLI {
class App;
}

namespace scarp::cli {

struct ShapeArguments {
  Given min_angle, max_edge, grade, min_edge;

  void add_to(CLI::App& command);
  Result<ShapeGoals> parse() const;
  /// The option that asks for shapes; null if there is none.
  const char* find_goal() const;
  /// The options for the canonical command.
  std::string canonical() const;
};

/// The "shape" object of a report; null where nothing was asked.
Json describe_shape(const ShapeGoals& goals, const Simplified& simplified);
/// Of the summary; empty where nothing was asked.
std::string shape_line(const ShapeGoals& goals, const Simplified& simplified);
/// Of the goals that yielded to others, in numbers.
void warn_of_shapes(const ShapeGoals& goals, const Simplified& simplified, std::vector<std::string>& warnings);

}  // namespace scarp::cli
