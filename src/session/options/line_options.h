// Vector files whose lines the mesh must hold.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scarp/lines.h"
#include "session/options/values.h"

namespace CLI {
class App;
}

namespace scarp::cli {

struct LineArguments {
  std::vector<std::string> breaklines, water, rivers;  ///< FILE or FILE:LAYER
  Given z_field, conflict, percentile, flats;
  bool are_soft = false;

  void add_to(CLI::App& command);
  /// Refuses options that need others, and words that are unknown.
  Result<void> check() const;
  /// The option that asks for lines in the mesh; null if there is none.
  const char* find_lines() const;
  /// The option that asks for lakes; null if there is none.
  const char* find_lakes() const;
  /// The options as they can change the mesh, for the canonical command.
  std::string canonical() const;
  /// The rule of --line-conflict; nothing without. REQUIRES: check() has passed.
  std::optional<LineConflict> conflict_rule() const;
};

}  // namespace scarp::cli
