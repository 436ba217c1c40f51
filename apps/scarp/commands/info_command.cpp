#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "commands/commands.h"
#include "session/inputs/heightmap.h"
#include "session/inputs/nodata_warnings.h"
#include "session/options/points_options.h"
#include "session/options/raster_options.h"
#include "session/reports/info_report.h"
#include "session/table/option_table.h"
#include "session/text/json_text.h"
#include "session/text/paths.h"
#include "session/text/text.h"
#include "terminal/progress_display.h"

namespace scarp::cli {
namespace {

using enum OptionId;

constexpr std::array<double, 3> kShares{0.01, 0.05, 0.20};

Error name_raster(Error error, const std::string& path) {
  if (error.kind == ErrorKind::kInput && !error.message.starts_with(path))
    error.message = fmt::format("{}: {}", path, error.message);
  return error;
}

/// Fails if an option is given that does not apply to the file's contents. `also`: options that apply.
Result<void> refuse(const GivenOptions& given, const char* kind, std::initializer_list<OptionId> also) {
  for (const OptionRow* row : given.given()) {
    const bool is_of_raster = row->group == OptionGroup::kInput || row->group == OptionGroup::kNodata;
    if (is_of_raster && std::find(also.begin(), also.end(), row->id) == also.end())
      return fail(ErrorKind::kUsage, fmt::format("{} is for rasters, and {} holds {}: omit it", row->title(),
                                                 shell_word(base_name(given.input())), kind));
  }
  return {};
}

Result<void> run_points(const GivenOptions& given, const std::string& command_line) {
  SCARP_RETURN_IF_ERROR(refuse(given, "points", {kCrs, kNodata, kZScale, kZOffset, kZUnit}));
  ProgressDisplay display(ProgressDisplay::choose(given.has(kJsonProgress), given.has(kQuiet)));
  SCARP_TRY(ReadOptions as, parse_reading(given));
  as.run.progress = display.callback();
  as.heights_in = HeightsIn::kFile;
  as.default_frame = DefaultFrame::kMetric;
  SCARP_TRY(const auto& options, parse_points(given, as));
  SCARP_TRY(const PointSet& points, read_inputs(given, options));
  display.finish();
  if (!given.has(kQuiet)) print_warnings(points.warnings);
  return print_to_stdout(given.has(kJson) ? to_text(points_facts_report(points, command_line))
                                          : points_facts(points, given.inputs()));
}

Result<void> run_mesh(const GivenOptions& given, const std::string& format, const std::string& command_line) {
  SCARP_RETURN_IF_ERROR(refuse(given, "a mesh", {}));
  MeshFileAxes axes;
  SCARP_TRY(Mesh mesh, read_mesh(given.input(), &axes));
  std::error_code ignored;
  MeshFile file{given.input(), format, std::filesystem::file_size(given.input(), ignored), std::move(mesh), axes};
  return print_to_stdout(given.has(kJson) ? to_text(mesh_facts_report(file, command_line)) : mesh_facts(file));
}

}  // namespace

Result<void> run_info(const GivenOptions& given, const std::string& command_line) {
  const bool is_one = given.inputs().size() == 1;
  if (!given.input().empty() && are_points_meant(given)) return run_points(given, command_line);
  if (const auto option = given.first_of({kLayer, kZField, kClass, kReturns}))
    return fail(ErrorKind::kUsage, fmt::format("{} is for points: omit it, or give {}", *option, kPoints));
  if (is_one && find_mesh_file(given.input()))
    return run_mesh(given, lower_extension(given.input()).substr(1), command_line);
  SCARP_TRY(ReadOptions read, parse_reading(given));
  ProgressDisplay display(ProgressDisplay::choose(given.has(kJsonProgress), given.has(kQuiet)));
  read.run.progress = display.callback();
  read.heights_in = HeightsIn::kFile;
  Result<OwnedHeightField> field = read_height_field(given.input(), read);
  if (!field) return tl::unexpected(explain_reading(given, std::move(field.error())));
  if (const auto needle = find_needle(*field, field->info)) field->info.warnings.push_back(*needle);
  for (std::string& warning : warn_of_undeclared_nodata(field->info, *field))
    field->info.warnings.push_back(std::move(warning));
  if (!given.has(kJson)) {
    display.finish();
    if (!given.has(kQuiet)) print_warnings(field->info.warnings);
    if (auto printed = print_to_stdout(raster_facts(*field)); !printed || given.has(kNoSuggest)) return printed;
  }
  Suggestions suggestions;
  if (!given.has(kNoSuggest)) {
    Result<Suggestions> found = suggest_errors(*field, kShares, display.callback());
    if (!found) return tl::unexpected(name_raster(std::move(found.error()), given.input()));
    suggestions = std::move(*found);
  }
  display.finish();
  if (!given.has(kJson)) return print_to_stdout(suggestion_table(*field, suggestions));
  if (!given.has(kQuiet)) print_warnings(field->info.warnings);
  return print_to_stdout(to_text(raster_report(*field, suggestions, read.band, command_line)));
}

}  // namespace scarp::cli
