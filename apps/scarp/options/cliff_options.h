// --cliff: walls that the mesh holds by two lines.
#pragma once

#include <optional>
#include <string>

#include "options/memory.h"
#include "options/options.h"
#include "reports/json.h"
#include "scarp/cliffs.h"

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
  /// Adds the lines of walls to `lines`, around those that are there. Nothing without --cliff.
  Result<std::optional<Cliffs>> add_cliffs(const HeightField& field, double max_error, const MemoryShare& memory,
                                           LineConstraints& lines) const;
};

/// The "cliffs" object of a report; null without --cliff.
Json describe_cliffs(const CliffArguments& given, const std::optional<Cliffs>& cliffs);
/// Of the summary; empty without --cliff.
std::string cliffs_line(const std::optional<Cliffs>& cliffs);

}  // namespace scarp::cli
