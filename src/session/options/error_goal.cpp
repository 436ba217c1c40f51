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
  double of_one;  ///< number of them in one `unit`
};

constexpr GoalUnit kGoalUnits[] = {{"%", "", 1}, {"mm", "", 1}, {"cm", "m", 100}, {"m", "m", 1}, {"ft", "ft", 1}};
constexpr double kFoot = 0.3048;

/// A goal whose number may be infinite or negative; nothing for other text.
struct Parsed {
  ErrorGoal goal;
  std::optional<double> number;  ///< before division
};

Parsed parse(std::string_view number) {
  ErrorGoal goal;
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
  const std::optional<double> value = find_number(number);
  goal.value = value.value_or(0) / divisor;
  return {std::move(goal), value};
}

}  // namespace

Result<ErrorGoal> parse_error_goal(OptionId option, const std::string& text) {
  auto [goal, value] = parse(text);
  SCARP_RETURN_IF_ERROR(check_size(name_of(option), text, value));
  if (!value || !std::isfinite(*value)) {
    return fail(ErrorKind::kUsage, fmt::format("{} {} is neither a finite number, in the units of the heights, nor a "
                                               "percentage of the relief such as 0.5%, nor a length such as 1m",
                                               option, shell_word(text)));
  }
  if (*value < 0 || std::signbit(*value)) {
    return fail(ErrorKind::kUsage,
                fmt::format("{} {} is negative: it must be at least 0, and 0 reproduces every sample", option,
                            shell_word(text)));
  }
  return std::move(goal);
}

Result<ErrorGoal> parse_length(const std::string& title, const std::string& text) {
  auto [goal, value] = parse(text);
  SCARP_RETURN_IF_ERROR(check_size(title, text, value));
  if (!value || !std::isfinite(*value) || goal.percent_of_relief || goal.is_on_print)
    return fail(ErrorKind::kUsage, fmt::format("{} {} is neither a finite number nor a length such as 2m, 30cm or 1ft",
                                               title, shell_word(text)));
  if (*value < 0) return fail(ErrorKind::kUsage, fmt::format("{} {} is negative", title, shell_word(text)));
  return std::move(goal);
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
  const bool are_feet = std::abs(metres / kFoot - 1) < 1e-5;  // any kind of feet means the heights' own feet
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

std::optional<double> metres_of(const ErrorGoal& length) {
  if (length.unit.empty()) return std::nullopt;
  return length.value * (length.unit == "m" ? 1 : kFoot);
}

Error name_goal(const ErrorGoal& goal, double relief, Error error) {
  const std::string absolute = fmt::format("a max error of {}", goal.absolute(relief));
  if (goal.percent_of_relief && error.message.starts_with(absolute + " "))
    error.message.replace(0, absolute.size(),
                          fmt::format("-e {}% of a relief of {:.10g}, {},", goal.value, relief, absolute));
  return error;
}

}  // namespace scarp::cli
