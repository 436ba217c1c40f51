#include "session/plan/conflicts.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "session/options/line_options.h"
#include "session/options/region_options.h"
#include "session/options/shape_options.h"
#include "session/options/strategy_options.h"
#include "session/table/field_options.h"

namespace scarp::cli {
namespace {

using enum OptionId;

pieces::Fields to_fields(std::initializer_list<std::pair<pieces::Field, bool>> settings) {
  pieces::Fields fields;
  for (const auto& [field, is_given] : settings) {
    if (is_given) fields.add(field);
  }
  return fields;
}

/// The settings in the options, without settings in files, such as whether a script inserts or ignores samples.
pieces::Fields fields_given(const GivenOptions& given, const SimplifyPlan& plan) {
  const bool is_split = plan.solid && plan.solid->is_split();
  return pieces::fields_of(HeightField(), plan.simplify) |
         to_fields({{pieces::Field::kMaxError, given.has(kMaxError)},
                    {pieces::Field::kMask, given.has(kMask)},
                    {pieces::Field::kTolerance, find_tolerance(given).has_value()},
                    {pieces::Field::kBreaklines, find_lines(given) || given.first_of({kCliff, kRidges}) || is_split},
                    {pieces::Field::kWalls, given.has(kCliff)},
                    {pieces::Field::kRidges, given.has(kRidges)},
                    {pieces::Field::kCutline, find_cut(given).has_value()},
                    {pieces::Field::kStrategy, plan.by_paper},
                    {pieces::Field::kLevels, given.has(kLods)},
                    {pieces::Field::kSpaceFrame, is_in_space(plan.read.crs)},
                    {pieces::Field::kChannels, plan.channels.has_channels()}});
}

pieces::Fields fields_given(const GivenOptions& given, std::optional<GridKind> grid, std::optional<TileFormat> format) {
  return to_fields({{pieces::Field::kTileMercator, grid == GridKind::kMercator},
                    {pieces::Field::kTileLocal, grid == GridKind::kLocal},
                    {pieces::Field::kTileQuantizedMesh, format == TileFormat::kQuantizedMesh},
                    {pieces::Field::kTileGlb, format == TileFormat::kGlb},
                    {pieces::Field::kTileLakes, given.has(kWater)},
                    {pieces::Field::kTileRivers, given.has(kRivers)},
                    {pieces::Field::kTileWaterMask, given.has(kWaterMask)},
                    {pieces::Field::kTileLines, given.has(kBreaklines)},
                    {pieces::Field::kTileDrape, given.has(kDrape)},
                    {pieces::Field::kTileOnly, given.has(kOnly)},
                    {pieces::Field::kTileGeoid, given.has(kGeoid)},
                    {pieces::Field::kTileVertical, given.has(kVertical)}});
}

/// The option that may have set the field, if it differs from the table's.
std::optional<OptionId> find_option_of(pieces::Field field, const GivenOptions& given) {
  if (field == pieces::Field::kTolerance || field == pieces::Field::kToleranceSource) return find_tolerance(given);
  if (field == pieces::Field::kBreaklines) {
    const auto lines = find_lines(given);
    return lines ? lines : given.first_of({kCliff, kRidges, kSplit});
  }
  if (field == pieces::Field::kBorder) return given.first_of({kLods});
  if (field == pieces::Field::kChannels) return given.first_of({kImage});
  return field == pieces::Field::kShape ? find_shape(given) : std::nullopt;
}

/// The option that set the field, or words for the effect of the raster and defaults.
std::string option_of(pieces::Field field, const GivenOptions& given) {
  if (field == pieces::Field::kTileLocal && !given.has(kGrid)) return "a local grid";
  if (field == pieces::Field::kTileQuantizedMesh && !given.has(kOf)) return fmt::format("{} qm, the default", kOf);
  if (const auto option = find_option_of(field, given)) return name_of(*option);
  if (field == pieces::Field::kStrategy && !find_strategy(given).empty()) return find_strategy(given);
  if ((field == pieces::Field::kCurvedFrame || field == pieces::Field::kSpaceFrame) && given.has(kCrs))
    return fmt::format("{} {}", kCrs, shell_word(*given[kCrs]));
  const OptionTerm option = cli::option_of(field);
  return option.id != kNone ? name_of(option) : std::string(pieces::name_of(field));
}

Result<void> refuse_first(const GivenOptions& given, const std::vector<pieces::Conflict>& conflicts) {
  if (conflicts.empty()) return {};
  const pieces::Conflict& first = conflicts.front();
  std::string sentence = pieces::describe(first, [&](pieces::Field field) { return option_of(field, given); });
  if (first.one == pieces::Field::kCutline)
    sentence += fmt::format("; {} cuts at cells of the grid instead", kMaskOutside);
  return fail(ErrorKind::kUsage, std::move(sentence));
}

}  // namespace

Result<void> check_conflicts(const GivenOptions& given, const SimplifyPlan& plan) {
  return refuse_first(given, pieces::find_conflicts(fields_given(given, plan)));
}

Result<void> check_conflicts(const GivenOptions& given, const HeightField& field, const SimplifyOptions& options) {
  return refuse_first(given, pieces::find_conflicts(field, options));
}

Result<void> check_conflicts(const GivenOptions& given, std::optional<GridKind> grid,
                             std::optional<TileFormat> format) {
  return refuse_first(given, pieces::find_conflicts(fields_given(given, grid, format)));
}

std::optional<std::string> find_unstreamed(const GivenOptions& given, const SimplifyPlan& plan) {
  pieces::Fields fields = fields_given(given, plan) | pieces::Fields(pieces::Field::kSource);
  if (given.has(kScript)) fields.add(pieces::Field::kIgnored);
  // Tolerances and weights of such a field are read in windows.
  if (fields.has(pieces::Field::kTolerance))
    fields = fields.without(pieces::Field::kTolerance) | pieces::Fields(pieces::Field::kToleranceSource);
  if (fields.has(pieces::Field::kMask))
    fields = fields.without(pieces::Field::kMask) | pieces::Fields(pieces::Field::kMaskSource);
  for (const pieces::Conflict& conflict : pieces::find_conflicts(fields)) {
    if (conflict.one == pieces::Field::kSource) return option_of(conflict.other, given);
  }
  return std::nullopt;
}

}  // namespace scarp::cli
