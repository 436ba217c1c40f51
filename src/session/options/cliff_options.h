// --cliff: walls that the mesh holds by two lines.
#pragma once

#include <optional>
#include <string>

#include "scarp/features.h"
#include "session/options/values.h"
#include "session/text/json.h"

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

/// The "cliffs" object of a report; null without --cliff.
Json describe_cliffs(const CliffArguments& given, const std::optional<Cliffs>& cliffs);
/// Of the summary; empty without --cliff.
std::string cliffs_line(const std::optional<Cliffs>& cliffs);
/// Warns where walls were asked for and none was found.
void warn_of_missing_walls(const CliffArguments& given, const std::optional<Cliffs>& cliffs,
                           std::vector<std::string>& warnings);

}  // namespace scarp::cli
