#include "session/options/shape_options.h"

#include <fmt/format.h>

#include <optional>
#include <tuple>

#include "session/table/option_table.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

Result<std::optional<double>> parse_above_zero(const char* option, const Given& text) {
  if (!text) return std::nullopt;
  SCARP_TRY(const double value, parse_number(option, *text));
  if (!(value > 0)) return fail(ErrorKind::kUsage, fmt::format("{} {} is not above 0", option, shell_word(*text)));
  return value;
}

}  // namespace

void ShapeArguments::add_to(CLI::App& command) {
  add_option(command, OptionId::kMinAngle, min_angle);
  add_option(command, OptionId::kMaxEdge, max_edge);
  add_option(command, OptionId::kGrade, grade);
  add_option(command, OptionId::kMinEdge, min_edge);
}

Result<ShapeGoals> ShapeArguments::parse() const {
  ShapeGoals goals;
  if (min_angle) {
    constexpr double kLargest = 33;
    SCARP_TRY(const double angle, parse_non_negative("--min-angle", *min_angle));
    if (angle > kLargest)
      return fail(
          ErrorKind::kUsage,
          fmt::format("--min-angle {} is above {}: beyond that refinement hardly ever comes to an end; up to 20 "
                      "degrees are proven to be possible, 30 mostly are",
                      shell_word(*min_angle), kLargest));
    goals.min_angle = angle;
  }
  for (const auto& [option, given, goal] :
       {std::tuple{"--max-edge", &max_edge, &goals.max_edge}, std::tuple{"--grade", &grade, &goals.grade},
        std::tuple{"--min-edge", &min_edge, &goals.min_edge}}) {
    SCARP_TRY(*goal, parse_above_zero(option, *given));
  }
  if (goals.min_edge && goals.max_edge && *goals.min_edge > *goals.max_edge / 2)
    return fail(
        ErrorKind::kUsage,
        fmt::format("--min-edge {} is more than half of --max-edge {}: longer edges are halved, so give at most {}",
                    shell_word(*min_edge), shell_word(*max_edge), format_number(*goals.max_edge / 2)));
  return goals;
}

const char* ShapeArguments::find_goal() const {
  if (min_angle) return "--min-angle";
  if (max_edge) return "--max-edge";
  if (grade) return "--grade";
  return min_edge ? "--min-edge" : nullptr;
}

std::string ShapeArguments::canonical() const {
  return canonical_option("--min-angle", min_angle) + canonical_option("--max-edge", max_edge) +
         canonical_option("--grade", grade) + canonical_option("--min-edge", min_edge);
}

}  // namespace scarp::cli
