// The table of rules between options: some options need others, and some exclude each other. Conflicts of the library's
// settings are in src/pieces/conflicts.h.
#pragma once

#include <array>
#include <span>

#include "scarp/result.h"
#include "session/table/option_table.h"

namespace scarp::cli {

class GivenOptions;

struct OptionRule {
  OptionTerm one;
  enum class Kind { kNeeds, kExcludes, kAllows } kind;
  /// kNeeds: one of these is required. kExcludes: each of these is excluded. kAllows: all others are excluded, except
  /// the group "Run".
  std::array<OptionTerm, 4> others;
  const char* why = "";  ///< end of the message
  Commands commands = kEveryCommand;
  bool is_for_points = false;  ///< true: only where the input holds points
};

std::span<const OptionRule> option_rules();

/// Fails with kUsage if the options break the rule; the message is one sentence.
Result<void> check_rule(const OptionRule& rule, const GivenOptions& given);
/// Checks all rules of the command, and fails at the first that is broken. `are_for_points`: those for points, or all
/// others.
Result<void> check_rules(Commands command, const GivenOptions& given, bool are_for_points);

}  // namespace scarp::cli
