// --ridges: lines along crests and valley beds that the mesh prefers, or holds.
#pragma once

#include <optional>
#include <string>

#include "scarp/features.h"
#include "session/options/values.h"

namespace CLI {
class App;
}

namespace scarp::cli {

struct RidgeArguments {
  Given height;
  bool are_kept = false;

  void add_to(CLI::App& command);
  /// `has_error`: there is one for all samples, given or to be searched for.
  Result<void> check(bool has_error) const;
  std::string canonical() const;
  /// Nothing without --ridges.
  std::optional<RidgeGoals> goals() const;
};

}  // namespace scarp::cli
