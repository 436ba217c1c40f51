// --ridges: lines along crests and valley beds that the mesh prefers, or holds.
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

/// The "ridges" object of a report; null without --ridges.
Json describe_ridges(const RidgeArguments& given, const std::optional<Ridges>& ridges);
/// Of the summary; empty without --ridges.
std::string ridges_line(const std::optional<Ridges>& ridges);
/// Warns where ridges were asked for and none was found.
void warn_of_missing_ridges(const RidgeArguments& given, const std::optional<Ridges>& ridges,
                            std::vector<std::string>& warnings);

}  // namespace scarp::cli
