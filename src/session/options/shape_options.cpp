#include "session/options/shape_options.h"

#include <fmt/format.h>

#include "session/text/text.h"

namespace scarp::cli {
namespace {
using enum OptionId;
}

Result<ShapeGoals> parse_shape(const GivenOptions& given) {
  ShapeGoals goals;
  SCARP_TRY(const auto angle, given.number(kMinAngle));
  goals.min_angle = angle.value_or(goals.min_angle);
  SCARP_TRY(goals.max_edge, given.number(kMaxEdge));
  SCARP_TRY(goals.grade, given.number(kGrade));
  SCARP_TRY(goals.min_edge, given.number(kMinEdge));
  if (goals.min_edge && goals.max_edge && *goals.min_edge > *goals.max_edge / 2)
    return fail(ErrorKind::kUsage,
                fmt::format("{} {} is more than half of {} {}: longer edges are halved, so give at most {}", kMinEdge,
                            shell_word(*given[kMinEdge]), kMaxEdge, shell_word(*given[kMaxEdge]),
                            format_number(*goals.max_edge / 2)));
  return goals;
}

std::optional<OptionId> find_shape(const GivenOptions& given) {
  return given.first_of({kMinAngle, kMaxEdge, kGrade, kMinEdge});
}

}  // namespace scarp::cli
