// The value of -e/--max-error and of --fail-above: how large an error may be.
#pragma once

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
  /// In z units, for a raster of the given relief.
  double absolute(double relief) const { return percent_of_relief ? value / 100 * relief : value; }
};
/// A number, perhaps with % or a unit behind it: m, cm, ft, or mm of a print.
Result<ErrorGoal> parse_error_goal(OptionId option, const std::string& text);
/// Fails for a goal in millimetres of a print, where there is none.
Result<void> refuse_print(OptionId option, const ErrorGoal& goal);
/// Puts a goal that names its unit into that of the heights. A warning reports if theirs is assumed; kUsage if it is no
/// length.
Result<void> settle_goal(OptionId option, const RasterInfo& heights, ErrorGoal& goal,
                         std::vector<std::string>& warnings);
/// Adds the share of the relief that was asked for to the library's error about a max error.
Error name_goal(const ErrorGoal& goal, double relief, Error error);

}  // namespace scarp::cli
