#include "session/plan/conflicts.h"

#include <utility>
#include <vector>

#include "session/table/field_options.h"

namespace scarp::cli {
namespace {

/// The settings that the options show; whether a script inserts or ignores samples stands in its file.
Fields fields_given(const SimplifyArguments& given, const SimplifyPlan& plan) {
  Fields fields = fields_of(HeightField(), plan.simplify);
  const bool is_split = plan.solid && plan.solid->is_split();
  const std::pair<Field, bool> others[] = {
      {Field::kMaxError, given.max_error.has_value()},
      {Field::kMask, given.companions.mask.has_value()},
      {Field::kTolerance, given.companions.find_tolerance() != nullptr},
      {Field::kBreaklines, plan.find_lines() != nullptr || given.cliff.height || given.ridges.height || is_split},
      {Field::kWalls, given.cliff.height.has_value()},
      {Field::kRidges, given.ridges.height.has_value()},
      {Field::kCutline, given.cut.find_cut() != nullptr},
      {Field::kStrategy, plan.by_paper},
      {Field::kLevels, given.levels.lods.has_value()},
      {Field::kSpaceFrame, is_in_space(plan.read.crs)},
      {Field::kChannels, plan.channels.has_channels()}};
  for (const auto& [field, is_given] : others) {
    if (is_given) fields.add(field);
  }
  return fields;
}

/// The option that gave the setting.
std::string option_of(Field field, const SimplifyArguments& given) {
  const char* option = nullptr;
  if (field == Field::kTolerance || field == Field::kToleranceSource) option = given.companions.find_tolerance();
  if (field == Field::kBreaklines) {
    option = given.lines.find_lines();
    if (option == nullptr) option = given.zones.find_lines();
    if (option == nullptr) option = given.cliff.height ? "--cliff" : given.ridges.height ? "--ridges" : "--split";
  }
  if (field == Field::kBorder && given.levels.lods) option = "--lods";
  if (field == Field::kStrategy) option = given.strategy.find_strategy();
  if (field == Field::kChannels && given.channels.image) option = "--image";
  if (field == Field::kShape) option = given.shape.find_goal();
  if ((field == Field::kCurvedFrame || field == Field::kSpaceFrame) && given.raster.crs)
    return "--crs " + shell_word(*given.raster.crs);
  if (option == nullptr) option = cli::option_of(field);
  return option != nullptr ? option : std::string(name_of(field));
}

Result<void> refuse_first(const SimplifyArguments& given, const std::vector<Conflict>& conflicts) {
  if (conflicts.empty()) return {};
  const Conflict& first = conflicts.front();
  const bool is_cut = first.one == Field::kCutline;
  return fail(ErrorKind::kUsage, describe(first, [&](Field field) { return option_of(field, given); }) +
                                     (is_cut ? "; --mask-outside cuts at cells of the grid instead" : ""));
}

Fields fields_given(const TileArguments& given, std::optional<GridKind> grid, std::optional<TileFormat> format) {
  Fields fields;
  const std::pair<Field, bool> all[] = {{Field::kTileMercator, grid == GridKind::kMercator},
                                        {Field::kTileLocal, grid == GridKind::kLocal},
                                        {Field::kTileQuantizedMesh, format == TileFormat::kQuantizedMesh},
                                        {Field::kTileGlb, format == TileFormat::kGlb},
                                        {Field::kTileLakes, !given.water.empty()},
                                        {Field::kTileRivers, !given.rivers.empty()},
                                        {Field::kTileWaterMask, given.has_water_mask},
                                        {Field::kTileLines, !given.breaklines.empty()},
                                        {Field::kTileDrape, given.drape.has_value()},
                                        {Field::kTileOnly, given.only.has_value()},
                                        {Field::kTileGeoid, given.geoid.has_value()},
                                        {Field::kTileVertical, given.vertical.has_value()}};
  for (const auto& [field, is_given] : all) {
    if (is_given) fields.add(field);
  }
  return fields;
}

/// The option that gave the setting, or what the raster and the defaults made of it.
std::string option_of(Field field, const TileArguments& given) {
  if (field == Field::kTileLocal && !given.grid) return "a local grid";
  if (field == Field::kTileQuantizedMesh && !given.format) return "--of qm, the default";
  return cli::option_of(field);
}

}  // namespace

Result<void> check_conflicts(const SimplifyArguments& given, const SimplifyPlan& plan) {
  return refuse_first(given, find_conflicts(fields_given(given, plan)));
}

Result<void> check_conflicts(const SimplifyArguments& given, const HeightField& field, const SimplifyOptions& options) {
  return refuse_first(given, find_conflicts(field, options));
}

Result<void> check_conflicts(const TileArguments& given, std::optional<GridKind> grid,
                             std::optional<TileFormat> format) {
  const std::vector<Conflict> conflicts = find_conflicts(fields_given(given, grid, format));
  if (conflicts.empty()) return {};
  return fail(ErrorKind::kUsage, describe(conflicts.front(), [&](Field field) { return option_of(field, given); }));
}

std::optional<std::string> find_unstreamed(const SimplifyArguments& given, const SimplifyPlan& plan) {
  Fields fields = fields_given(given, plan) | Fields(Field::kSource);
  if (given.companions.script) fields.add(Field::kIgnored);
  // Tolerances and weights are read in windows then.
  if (fields.has(Field::kTolerance)) fields = fields.without(Field::kTolerance) | Fields(Field::kToleranceSource);
  if (fields.has(Field::kMask)) fields = fields.without(Field::kMask) | Fields(Field::kMaskSource);
  for (const Conflict& conflict : find_conflicts(fields)) {
    if (conflict.one == Field::kSource) return option_of(conflict.other, given);
  }
  return std::nullopt;
}

}  // namespace scarp::cli
