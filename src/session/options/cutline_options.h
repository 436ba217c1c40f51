// --cutline: polygons that the surface ends at.
#pragma once

#include <string>
#include <vector>

#include "session/options/values.h"

namespace CLI {
class App;
}

namespace scarp::cli {

struct CutlineArguments {
  std::vector<std::string> files;  ///< FILE or FILE:LAYER
  Given inset;
  bool mask_outside = false;

  void add_to(CLI::App& command);
  /// Refuses options that need others, and words that are unknown.
  Result<void> check() const;
  /// The option that asks for a cut along the polygons; null if there is none.
  const char* find_cut() const { return files.empty() || mask_outside ? nullptr : "--cutline"; }
  std::string canonical() const;
};

}  // namespace scarp::cli
