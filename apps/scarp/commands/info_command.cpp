#include "commands/info_command.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <utility>

#include "session/inputs/heightmap.h"
#include "session/inputs/nodata_warnings.h"
#include "session/reports/info_report.h"
#include "session/table/option_table.h"
#include "session/text/json_text.h"
#include "session/text/paths.h"
#include "session/text/text.h"
#include "terminal/progress_display.h"

namespace scarp::cli {
namespace {

constexpr std::array<double, 3> kShares{0.01, 0.05, 0.20};

Error name_raster(Error error, const std::string& path) {
  if (error.kind == ErrorKind::kInput && !error.message.starts_with(path))
    error.message = fmt::format("{}: {}", path, error.message);
  return error;
}

}  // namespace

InfoCommand::InfoCommand(CLI::App& program) : command_(add_command(program, kInfo)) {
  add_arguments(*command_, OptionId::kRaster, raster_.paths);
  raster_.add_to(*command_);
  add_flag(*command_, OptionId::kPoints, points_);
  add_option(*command_, OptionId::kLayer, layer_);
  add_option(*command_, OptionId::kZField, z_field_);
  add_option(*command_, OptionId::kColumns, columns_);
  add_flag(*command_, OptionId::kNoSuggest, no_suggest_);
  add_flag(*command_, OptionId::kJson, json_);
  add_flag(*command_, OptionId::kQuiet, quiet_);
  add_flag(*command_, OptionId::kJsonProgress, json_progress_);
}

Result<void> InfoCommand::run(const std::string& command_line) const {
  const bool is_one = raster_.paths.size() == 1;
  if (points_ || columns_ || (is_one && !raster_.path().empty() && is_point_file(raster_.path())))
    return run_points(command_line);
  for (const auto& [name, value] : {std::pair{"--layer", &layer_}, std::pair{"--z-field", &z_field_}}) {
    if (*value) return fail(ErrorKind::kUsage, fmt::format("{} is for points: leave it out, or say --points", name));
  }
  if (is_one && find_mesh_file(raster_.path()))
    return run_mesh(lower_extension(raster_.path()).substr(1), command_line);
  SCARP_TRY(ReadOptions read, raster_.parse());
  ProgressDisplay display(ProgressDisplay::choose(json_progress_, quiet_));
  read.run.progress = display.callback();
  read.heights_in = HeightsIn::kFile;
  Result<OwnedHeightField> field = read_height_field(raster_.path(), read);
  if (!field) return tl::unexpected(raster_.explain(std::move(field.error())));
  if (const auto needle = find_needle(*field, field->info)) field->info.warnings.push_back(*needle);
  for (std::string& warning : warn_of_undeclared_nodata(field->info, *field))
    field->info.warnings.push_back(std::move(warning));
  if (!json_) {
    display.finish();
    if (!quiet_) print_warnings(field->info.warnings);
    if (auto printed = print_to_stdout(raster_facts(*field)); !printed || no_suggest_) return printed;
  }
  Suggestions suggestions;
  if (!no_suggest_) {
    Result<Suggestions> found = suggest_errors(*field, kShares, display.callback());
    if (!found) return tl::unexpected(name_raster(std::move(found.error()), raster_.path()));
    suggestions = std::move(*found);
  }
  display.finish();
  if (!json_) return print_to_stdout(suggestion_table(*field, suggestions));
  if (!quiet_) print_warnings(field->info.warnings);
  return print_to_stdout(to_text(raster_report(*field, suggestions, read.band, command_line)));
}

Result<void> InfoCommand::refuse(const char* kind, bool takes_crs) const {
  const std::pair<const char*, bool> given[] = {{"--band", raster_.band.has_value()},
                                                {"--nodata", raster_.nodata.has_value() && !takes_crs},
                                                {"--decode", raster_.decode.has_value()},
                                                {"--z-scale", raster_.z_scale.has_value() && !takes_crs},
                                                {"--z-offset", raster_.z_offset.has_value() && !takes_crs},
                                                {"--z-unit", raster_.z_unit.has_value() && !takes_crs},
                                                {"--cell-size", raster_.cell_size.has_value()},
                                                {"--te", !raster_.extent.empty()},
                                                {"--resolution", raster_.resolution.has_value()},
                                                {"--crs", raster_.crs.has_value() && !takes_crs}};
  for (const auto& [name, is_given] : given) {
    if (is_given)
      return fail(ErrorKind::kUsage, fmt::format("{} is for rasters, and {} holds {}: leave it out", name,
                                                 shell_word(base_name(raster_.path())), kind));
  }
  return {};
}

Result<void> InfoCommand::run_points(const std::string& command_line) const {
  SCARP_RETURN_IF_ERROR(refuse("points", true));
  ProgressDisplay display(ProgressDisplay::choose(json_progress_, quiet_));
  SCARP_TRY(const auto& as, raster_.parse());
  SCARP_TRY(const PointSet& points, read_points(raster_.path(), {.layer = layer_.value_or(""),
                                                                 .z_field = z_field_.value_or(""),
                                                                 .crs = as.crs,
                                                                 .progress = display.callback(),
                                                                 .columns = columns_.value_or(""),
                                                                 .nodata = as.nodata,
                                                                 .z_scale = as.z_scale,
                                                                 .z_offset = as.z_offset,
                                                                 .z_unit = as.z_unit,
                                                                 .heights_in = HeightsIn::kFile}));
  display.finish();
  if (!quiet_) print_warnings(points.warnings);
  return print_to_stdout(json_ ? to_text(points_facts_report(points, command_line)) : points_facts(points));
}

Result<void> InfoCommand::run_mesh(const std::string& format, const std::string& command_line) const {
  SCARP_RETURN_IF_ERROR(refuse("a mesh", false));
  MeshFileAxes axes;
  SCARP_TRY(Mesh mesh, read_mesh(raster_.path(), &axes));
  std::error_code ignored;
  MeshFile file{raster_.path(), format, std::filesystem::file_size(raster_.path(), ignored), std::move(mesh), axes};
  return print_to_stdout(json_ ? to_text(mesh_facts_report(file, command_line)) : mesh_facts(file));
}

}  // namespace scarp::cli
