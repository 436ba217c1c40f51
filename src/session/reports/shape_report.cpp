#include "session/reports/shape_report.h"

#include <fmt/format.h>

#include <cstdint>
#include <initializer_list>
#include <utility>

#include "session/options/given_options.h"
#include "session/text/json_text.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

/// Counts other than 0: "3 in sharp corners, 2 elsewhere".
std::string list_counts(std::initializer_list<std::pair<std::uint64_t, const char*>> counts) {
  std::string list;
  for (const auto& [count, where] : counts) {
    if (count > 0) list += fmt::format("{}{} {}", list.empty() ? "" : ", ", format_count(count), where);
  }
  return list;
}

/// The reason for angles that are too small.
std::string describe_below(const ShapeReport& shape) {
  return list_counts({{shape.forced, "in sharp corners of lines or outline"},
                      {shape.below_beside_lines, "where lines or outline leave no room"},
                      {shape.below - shape.forced - shape.below_beside_lines, "where vertices would be too close"}});
}

/// The reason for edges that are too short.
std::string describe_shorter(const ShapeGoals& goals, const ShapeReport& shape) {
  const char* elsewhere = goals.min_angle > 0 ? "for the max error or angles" : "for the max error";
  if (goals.grade)
    elsewhere = goals.min_angle > 0 ? "for the max error, grade or angles" : "for the max error or grade";
  return list_counts(
      {{shape.shorter_beside_lines, "at lines or outline"}, {shape.shorter - shape.shorter_beside_lines, elsewhere}});
}

}  // namespace

Json describe_shape(const ShapeGoals& goals, const Simplified& simplified) {
  if (!simplified.shape) return nullptr;
  const ShapeReport& shape = *simplified.shape;
  return Json{{"asked_angle", goals.min_angle},
              {"asked_edge", or_null(goals.max_edge)},
              {"asked_grade", or_null(goals.grade)},
              {"asked_min_edge", or_null(goals.min_edge)},
              {"min_angle", shape.min_angle},
              {"below", shape.below},
              {"forced", shape.forced},
              {"below_beside_lines", shape.below_beside_lines},
              {"shorter", shape.shorter},
              {"shorter_beside_lines", shape.shorter_beside_lines},
              {"shortest_edge", shape.shortest_edge},
              {"longest_edge", shape.longest_edge},
              {"histogram", shape.histogram}};
}

std::string shape_line(const ShapeGoals& goals, const Simplified& simplified) {
  if (!simplified.shape) return "";
  const ShapeReport& shape = *simplified.shape;
  std::string text = fmt::format("smallest angle {} degrees", format_number(shape.min_angle));
  if (goals.min_angle > 0) text += fmt::format(" (asked {})", format_number(goals.min_angle));
  if (shape.below > 0)
    text += fmt::format(", {} below ({})", format_plural(shape.below, "triangle"), describe_below(shape));
  text += fmt::format("; edges {} to {}", format_number(shape.shortest_edge), format_number(shape.longest_edge));
  if (shape.shorter > 0)
    text += fmt::format(", {} shorter than {} ({})", format_count(shape.shorter), format_number(*goals.min_edge),
                        describe_shorter(goals, shape));
  return summary_line("shape", text);
}

void warn_of_shapes(const ShapeGoals& goals, const Simplified& simplified, std::vector<std::string>& warnings) {
  if (!simplified.shape) return;
  const ShapeReport& shape = *simplified.shape;
  if (shape.below > 0)
    warnings.push_back(
        fmt::format("{} {}: smaller angles are left in {}, down to {} degrees ({}); lines, the outline and the "
                    "max error come first, so simpler lines or a larger max error leave fewer",
                    OptionId::kMinAngle, format_number(goals.min_angle), format_plural(shape.below, "triangle"),
                    format_number(shape.min_angle), describe_below(shape)));
  if (shape.shorter > 0)
    warnings.push_back(
        fmt::format("{} {}: {} left shorter, down to {} ({}); all other goals come first, so simpler lines or a "
                    "larger max error leave fewer",
                    OptionId::kMinEdge, format_number(*goals.min_edge), format_plural(shape.shorter, "edge"),
                    format_number(shape.shortest_edge), describe_shorter(goals, shape)));
}

}  // namespace scarp::cli
