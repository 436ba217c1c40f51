#include "session/options/points_options.h"

#include <fmt/format.h>

#include <string_view>

#include "session/text/text.h"

namespace scarp::cli {
namespace {

using enum OptionId;

constexpr Choice<DuplicatePolicy> kPolicies[] = {{"first", DuplicatePolicy::kFirst},
                                                 {"last", DuplicatePolicy::kLast},
                                                 {"highest", DuplicatePolicy::kHighest},
                                                 {"lowest", DuplicatePolicy::kLowest},
                                                 {"mean", DuplicatePolicy::kMean}};

bool is_of_points(const GivenOptions& given, const std::string& path) {
  return given.has(kPoints) || given.has(kColumns) || is_point_file(path);
}

}  // namespace

bool are_points_meant(const GivenOptions& given) { return is_of_points(given, given.input()); }

Result<void> check_kind_of_input(const GivenOptions& given) {
  for (const std::string& path : given.inputs()) {
    if (given.inputs().size() > 1 && is_of_points(given, path))
      return fail(ErrorKind::kUsage,
                  fmt::format("{} holds points: only rasters are joined, so give it alone", shell_word(path)));
  }
  const std::string input = shell_word(base_name(given.input()));
  for (const OptionRow* row : given.given()) {
    if (are_points_meant(given) && !row->is_for_points)
      return fail(ErrorKind::kUsage,
                  fmt::format("{} is for rasters, and {} holds points: leave it out", row->title(), input));
    if (!are_points_meant(given) && row->group == OptionGroup::kPoints)
      return fail(ErrorKind::kUsage,
                  fmt::format("{} is for scattered points, and {} is read as a raster: {} reads it as points",
                              row->title(), input, kPoints));
  }
  return {};
}

const char* policy_name(DuplicatePolicy policy) { return name_of(policy, kPolicies); }

Result<DuplicatePolicy> parse_policy(const GivenOptions& given) {
  SCARP_TRY(const auto policy, given.choice(kDuplicates, kPolicies));
  return policy.value_or(DuplicatePolicy::kFirst);
}

Result<BoundaryChoice> parse_boundary(const GivenOptions& given) {
  constexpr std::string_view kConcave = "concave:";
  const Given& text = given[kBoundary];
  if (!text || *text == "hull") return BoundaryChoice{};
  if (text->starts_with(kConcave)) {
    const Result<double> length = parse_number(name_of(kBoundary), text->substr(kConcave.size()));
    if (length && *length > 0) return BoundaryChoice{*length, ""};
  } else if (text->find('.') != std::string::npos) {
    return BoundaryChoice{std::nullopt, *text};
  }
  return fail(
      ErrorKind::kUsage,
      fmt::format("{} {} is neither hull nor concave:LENGTH, such as concave:50, nor a file of polygons: LENGTH "
                  "is a number above 0 in the unit of x and y",
                  kBoundary, shell_word(*text)));
}

}  // namespace scarp::cli
