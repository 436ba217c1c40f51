// --cliff: walls that the mesh holds by two lines.
#pragma once

#include <optional>
#include <string>

#include "scarp/features.h"
#include "session/options/values.h"

namespace CLI {
class App;
}

namespace scarp::cli {

struct CliffArguments {
  Given height;

  void add_to(CLI::App& command);
  /// `has_error`: there is one for all samples, given or to be searched for.
  Result<void> check(bool has_error) const;
  std::string canonical() const { return canonical_option("--cliff", height); }
  /// Nothing without --cliff.
  std::optional<WallGoals> goals() const;
};

}  // namespace scarp::cli
