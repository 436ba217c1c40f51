#include "session/options/line_options.h"

namespace scarp::cli {
namespace {

using enum OptionId;

constexpr Choice<LineConflict> kConflicts[] = {{"error", LineConflict::kError},
                                               {"first", LineConflict::kFirst},
                                               {"mean", LineConflict::kMean},
                                               {"highest", LineConflict::kHighest}};

}  // namespace

std::optional<OptionId> find_lines(const GivenOptions& given) {
  return given.first_of({kBreaklines, kWater, kDetectFlats, kRivers, kMaterials, kNodeStrings});
}

std::optional<OptionId> find_lakes(const GivenOptions& given) { return given.first_of({kWater, kDetectFlats}); }

std::optional<OptionId> find_cut(const GivenOptions& given) {
  return given.has(kMaskOutside) ? std::nullopt : given.first_of({kCutline});
}

Result<void> check_lines(const GivenOptions& given) {
  for (const OptionId id : {kWaterPercentile, kInset, kCliff, kRidges}) {
    SCARP_RETURN_IF_ERROR(given.number(id));
  }
  SCARP_RETURN_IF_ERROR(given.count(kDetectFlats));
  SCARP_RETURN_IF_ERROR(given.choice(kLineConflict, kConflicts));
  return {};
}

std::optional<LineConflict> conflict_rule(const GivenOptions& given) {
  return *given.choice(kLineConflict, kConflicts);
}

std::optional<WallGoals> wall_goals(const GivenOptions& given) {
  const auto height = *given.number(kCliff);
  return height ? std::optional(WallGoals{*height}) : std::nullopt;
}

std::optional<RidgeGoals> ridge_goals(const GivenOptions& given) {
  const auto height = *given.number(kRidges);
  return height ? std::optional(RidgeGoals{*height, given.has(kKeepRidges)}) : std::nullopt;
}

}  // namespace scarp::cli
