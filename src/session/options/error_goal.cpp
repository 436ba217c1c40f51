#include "session/options/error_goal.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "session/options/given_options.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

struct GoalUnit {
  const char* suffix;
  const char* unit;
  double of_one;  ///< its number in one `unit`
};

constexpr GoalUnit kGoalUnits[] = {{"%", "", 1}, {"mm", "", 1}, {"cm", "m", 100}, {"m", "m", 1}, {"ft", "ft", 1}};

}  // namespace

Result<ErrorGoal> parse_error_goal(OptionId option, const std::string& text) {
  ErrorGoal goal;
  std::string_view number = text;
  double divisor = 1;
  for (const auto& [suffix, unit, of_one] : kGoalUnits) {
    if (!number.ends_with(suffix)) continue;
    number.remove_suffix(std::string_view(suffix).size());
    goal.percent_of_relief = suffix[0] == '%';
    goal.is_on_print = std::string_view(suffix) == "mm";
    goal.unit = unit;
    divisor = of_one;
    break;
  }
  std::optional<double> value = find_number(number);
  SCARP_RETURN_IF_ERROR(check_size(name_of(option), text, value));
  if (!value || !std::isfinite(*value)) {
    return fail(ErrorKind::kUsage, fmt::format("{} {} is neither a finite number, in the units of the heights, nor a "
                                               "percentage of the relief such as 0.5%, nor a length such as 1m",
                                               option, shell_word(text)));
  }
  *value /= divisor;
  if (*value < 0 || std::signbit(*value)) {
    return fail(ErrorKind::kUsage,
                fmt::format("{} {} is negative: it must be at least 0, and 0 reproduces every sample", option,
                            shell_word(text)));
  }
  goal.value = *value;
  return goal;
}

Result<void> refuse_print(OptionId option, const ErrorGoal& goal) {
  if (!goal.is_on_print) return {};
  return fail(ErrorKind::kUsage, fmt::format("{} {}mm is an error on a print, and there is none here: give it in the "
                                             "units of the heights",
                                             option, format_number(goal.value)));
}

Result<void> settle_goal(OptionId option, const RasterInfo& heights, ErrorGoal& goal,
                         std::vector<std::string>& warnings) {
  if (goal.unit.empty()) return {};
  const double metres = heights.unit_in_metres;
  if (metres == 0)
    return fail(ErrorKind::kUsage,
                fmt::format("{} is in {}, and the heights are in '{}', which is no unit of length that is "
                            "known here: give a number without a unit, or name their unit ({})",
                            option, goal.unit, heights.unit, OptionId::kZUnit));
  constexpr double kFoot = 0.3048;
  const bool are_feet = std::abs(metres / kFoot - 1) < 1e-5;  // feet of any kind mean the heights' own feet
  const double of_goal = goal.unit == "m" ? 1 : are_feet ? metres : kFoot;
  const double given = goal.value;
  if (of_goal != metres) goal.value *= of_goal / metres;
  if (heights.unit_is_assumed && heights.unit.empty())
    warnings.push_back(
        fmt::format("the file does not tell the unit of its heights, which are taken for {}: {} {}{} is {} of "
                    "them; {} names another",
                    metres == 1 ? "metres" : heights.crs_unit, option, format_number(given), goal.unit,
                    format_number(goal.value), OptionId::kZUnit));
  return {};
}

Error name_goal(const ErrorGoal& goal, double relief, Error error) {
  const std::string absolute = fmt::format("a max error of {}", goal.absolute(relief));
  if (goal.percent_of_relief && error.message.starts_with(absolute + " "))
    error.message.replace(0, absolute.size(),
                          fmt::format("-e {}% of a relief of {:.10g}, {},", goal.value, relief, absolute));
  return error;
}

}  // namespace scarp::cli
