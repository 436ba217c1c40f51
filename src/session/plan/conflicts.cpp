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

Fields to_fields(std::initializer_list<std::pair<Field, bool>> settings) {
  Fields fields;
  for (const auto& [field, is_given] : settings) {
    if (is_given) fields.add(field);
  }
  return fields;
}

/// The settings in the options, without settings in files, such as whether a script inserts or ignores samples.
Fields fields_given(const GivenOptions& given, const SimplifyPlan& plan) {
  const bool is_split = plan.solid && plan.solid->is_split();
  return fields_of(HeightField(), plan.simplify) |
         to_fields({{Field::kMaxError, given.has(kMaxError)},
                    {Field::kMask, given.has(kMask)},
                    {Field::kTolerance, find_tolerance(given).has_value()},
                    {Field::kBreaklines, find_lines(given) || given.first_of({kCliff, kRidges}) || is_split},
                    {Field::kWalls, given.has(kCliff)},
                    {Field::kRidges, given.has(kRidges)},
                    {Field::kCutline, find_cut(given).has_value()},
                    {Field::kStrategy, plan.by_paper},
                    {Field::kLevels, given.has(kLods)},
                    {Field::kSpaceFrame, is_in_space(plan.read.crs)},
                    {Field::kChannels, plan.channels.has_channels()}});
}

Fields fields_given(const GivenOptions& given, std::optional<GridKind> grid, std::optional<TileFormat> format) {
  return to_fields({{Field::kTileMercator, grid == GridKind::kMercator},
                    {Field::kTileLocal, grid == GridKind::kLocal},
                    {Field::kTileQuantizedMesh, format == TileFormat::kQuantizedMesh},
                    {Field::kTileGlb, format == TileFormat::kGlb},
                    {Field::kTileLakes, given.has(kWater)},
                    {Field::kTileRivers, given.has(kRivers)},
                    {Field::kTileWaterMask, given.has(kWaterMask)},
                    {Field::kTileLines, given.has(kBreaklines)},
                    {Field::kTileDrape, given.has(kDrape)},
                    {Field::kTileOnly, given.has(kOnly)},
                    {Field::kTileGeoid, given.has(kGeoid)},
                    {Field::kTileVertical, given.has(kVertical)}});
}

/// The option that may have set the field, if it differs from the table's.
std::optional<OptionId> find_option_of(Field field, const GivenOptions& given) {
  if (field == Field::kTolerance || field == Field::kToleranceSource) return find_tolerance(given);
  if (field == Field::kBreaklines) {
    const auto lines = find_lines(given);
    return lines ? lines : given.first_of({kCliff, kRidges, kSplit});
  }
  if (field == Field::kBorder) return given.first_of({kLods});
  if (field == Field::kChannels) return given.first_of({kImage});
  return field == Field::kShape ? find_shape(given) : std::nullopt;
}

/// The option that set the field, or words for the effect of the raster and defaults.
std::string option_of(Field field, const GivenOptions& given) {
  if (field == Field::kTileLocal && !given.has(kGrid)) return "a local grid";
  if (field == Field::kTileQuantizedMesh && !given.has(kOf)) return fmt::format("{} qm, the default", kOf);
  if (const auto option = find_option_of(field, given)) return name_of(*option);
  if (field == Field::kStrategy && !find_strategy(given).empty()) return find_strategy(given);
  if ((field == Field::kCurvedFrame || field == Field::kSpaceFrame) && given.has(kCrs))
    return fmt::format("{} {}", kCrs, shell_word(*given[kCrs]));
  const OptionTerm option = cli::option_of(field);
  return option.id != kNone ? name_of(option) : std::string(scarp::name_of(field));
}

Result<void> refuse_first(const GivenOptions& given, const std::vector<Conflict>& conflicts) {
  if (conflicts.empty()) return {};
  const Conflict& first = conflicts.front();
  std::string sentence = describe(first, [&](Field field) { return option_of(field, given); });
  if (first.one == Field::kCutline) sentence += fmt::format("; {} cuts at cells of the grid instead", kMaskOutside);
  return fail(ErrorKind::kUsage, std::move(sentence));
}

}  // namespace

Result<void> check_conflicts(const GivenOptions& given, const SimplifyPlan& plan) {
  return refuse_first(given, find_conflicts(fields_given(given, plan)));
}

Result<void> check_conflicts(const GivenOptions& given, const HeightField& field, const SimplifyOptions& options) {
  return refuse_first(given, find_conflicts(field, options));
}

Result<void> check_conflicts(const GivenOptions& given, std::optional<GridKind> grid,
                             std::optional<TileFormat> format) {
  return refuse_first(given, find_conflicts(fields_given(given, grid, format)));
}

std::optional<std::string> find_unstreamed(const GivenOptions& given, const SimplifyPlan& plan) {
  Fields fields = fields_given(given, plan) | Fields(Field::kSource);
  if (given.has(kScript)) fields.add(Field::kIgnored);
  // Tolerances and weights of such a field are read in windows.
  if (fields.has(Field::kTolerance)) fields = fields.without(Field::kTolerance) | Fields(Field::kToleranceSource);
  if (fields.has(Field::kMask)) fields = fields.without(Field::kMask) | Fields(Field::kMaskSource);
  for (const Conflict& conflict : find_conflicts(fields)) {
    if (conflict.one == Field::kSource) return option_of(conflict.other, given);
  }
  return std::nullopt;
}

}  // namespace scarp::cli
