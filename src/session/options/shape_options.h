// Shapes of triangles that are asked for, and what became of them.
#pragma once

#include <string>

#include "scarp/shape.h"
#include "scarp/simplify.h"
#include "session/options/values.h"

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

}  // namespace scarp::cli
