// The values of -e/--max-error and --fail-above.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/result.h"
#include "session/table/option_table.h"

namespace scarp::cli {

/// The value of -e/--max-error.
struct ErrorGoal {
  double value = 0;
  bool percent_of_relief = false;
  bool is_on_print = false;  ///< in millimetres of a print
  std::string unit;          ///< unit of the value, "m" or "ft"; empty: that of the heights
  /// The goal in z units for a raster with the given relief.
  double absolute(double relief) const { return percent_of_relief ? value / 100 * relief : value; }
};
/// Parses a number with or without % or a unit: m, cm, ft, or mm of a print.
Result<ErrorGoal> parse_error_goal(OptionId option, const std::string& text);
/// Parses a number of at least 0, with or without a unit: m, cm, ft. `title`: for errors.
Result<ErrorGoal> parse_length(const std::string& title, const std::string& text);
/// Fails for a goal in millimetres of a print if there is no print.
Result<void> refuse_print(OptionId option, const ErrorGoal& goal);
/// Converts a goal with a unit to the unit of the heights. Warns if the heights' unit is assumed; fails with kUsage if
/// it is not a length.
Result<void> settle_goal(OptionId option, const RasterInfo& heights, ErrorGoal& goal,
                         std::vector<std::string>& warnings);
/// A length in metres; nothing without a unit.
std::optional<double> metres_of(const ErrorGoal& length);
/// Adds the requested percentage of the relief to the library's error about a max error.
Error name_goal(const ErrorGoal& goal, double relief, Error error);

}  // namespace scarp::cli
