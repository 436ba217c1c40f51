#include <fmt/format.h>

#include <utility>
#include <vector>

#include "commands/measure_command.h"
#include "inputs/mesh_place.h"
#include "options/option_table.h"
#include "options/output_kind.h"
#include "reports/measure_report.h"
#include "reports/pictures.h"
#include "reports/report.h"
#include "scarp/picture.h"
#include "scarp/solid.h"
#include "terminal/clock.h"
#include "terminal/text.h"

namespace scarp::cli {
namespace {

/// Fills mesh.channels from its 8-bit colours where the file holds nothing else, and checks their number. `path` is the
/// mesh's, for the sentence.
Result<void> restore_channels(Mesh& mesh, const Channels& channels, const std::string& path) {
  const std::size_t bands = channels.count();
  if (mesh.channel_count > 0 && static_cast<std::size_t>(mesh.channel_count) == bands) return {};
  if (mesh.channel_count == 0 && channels.are_colors() && !mesh.colors.empty()) {
    mesh.channel_count = static_cast<int>(bands);
    mesh.channels.reserve(bands * mesh.vertex_count());
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
      for (std::size_t k = 0; k < bands; ++k) mesh.channels.push_back(mesh.colors[3 * v + k]);
    }
    return {};
  }
  if (mesh.channel_count == 0) {
    return fail(ErrorKind::kInput,
                fmt::format("{} holds {} to compare with {}: write it as .glb or .ply, of the same image", path,
                            mesh.colors.empty() ? "no colours" : "8-bit colours only", format_plural(bands, "band")));
  }
  return fail(ErrorKind::kInput,
              fmt::format("{} has {} but {} to compare with: give the files it was made from, in the same order", path,
                          format_plural(static_cast<std::uint64_t>(mesh.channel_count), "channel"),
                          format_plural(bands, "band")));
}

}  // namespace

MeasureCommand::MeasureCommand(CLI::App& program) : command_(add_command(program, kMeasure)) {
  add_arguments(*command_, OptionId::kRaster, raster_.paths, OptionId::kMesh, mesh_);
  raster_.add_to(*command_);
  add_option(*command_, OptionId::kUp, up_);
  points_.add_to(*command_);
  add_option(*command_, OptionId::kFailAbove, fail_above_);
  companions_.add_to(*command_);
  cut_.add_to(*command_);
  channels_.add_to(*command_);
  add_flag(*command_, OptionId::kJson, json_);
  add_option(*command_, OptionId::kMap, map_);
  add_option(*command_, OptionId::kErrorRaster, error_raster_);
  add_flag(*command_, OptionId::kOverwrite, overwrite_);
  add_option(*command_, OptionId::kThreads, threads_);
  memory_.add_to(*command_);
  add_flag(*command_, OptionId::kQuiet, quiet_);
  add_flag(*command_, OptionId::kJsonProgress, json_progress_);
}

/// The likeliest mistake of all: the mesh before the raster.
Result<void> MeasureCommand::check_order() const {
  const auto is_mesh = [](const std::string& path) {
    const auto format = find_mesh_format(lower_extension(path));
    return format && *format != MeshFormat::kGpkg && *format != MeshFormat::kLandXml;
  };
  if (raster_.paths.size() != 1 || !is_mesh(raster_.path()) || find_mesh_format(lower_extension(mesh_))) return {};
  return fail(ErrorKind::kUsage,
              fmt::format("{} is a mesh: the raster comes first, scarp measure {} {}", shell_word(raster_.path()),
                          shell_word(mesh_), shell_word(raster_.path())));
}

Result<void> MeasureCommand::check_outputs_of_run() const {
  std::vector<PlannedOutput> outputs;
  if (map_) {
    outputs.push_back({"--map", *map_});
    SCARP_RETURN_IF_ERROR(check_png_name(outputs.back()));
  }
  if (error_raster_) {
    outputs.push_back({"--error-raster", *error_raster_});
    SCARP_RETURN_IF_ERROR(check_tiff_name(outputs.back()));
  }
  SCARP_RETURN_IF_ERROR(check_outputs(outputs, files_read(*command_), overwrite_));
  for (const PlannedOutput& output : outputs) {
    if (json_ && is_stdout(output.path)) {
      return fail(ErrorKind::kUsage,
                  fmt::format("--json and {} /dev/stdout both write to standard output", output.option));
    }
  }
  return {};
}

ErrorMapOptions MeasureCommand::map_options(const Judged& judged, int max_side) const {
  const std::string unit = judged.plan.image ? "grey levels" : short_unit(judged.field.info.unit);
  return error_map_options(judged.field.info, unit, mesh_, max_side);
}

Result<void> MeasureCommand::write_files(const Judged& judged, StreamedErrors& streamed) const {
  if (!map_ && !error_raster_) return {};
  const OwnedHeightField& field = judged.field;
  std::vector<float> errors;
  if (!field.source)
    errors = take_error_raster(judged.judgement, judged.plan.image ? ErrorsOf::kNorms : ErrorsOf::kHeights);
  std::vector<std::uint8_t> map, raster;
  std::vector<FileBytes> files;
  if (map_) {
    const Picture picture =
        streamed.map ? streamed.map->draw() : draw_error_map(errors, field.cols, field.rows, map_options(judged, 1400));
    SCARP_TRY(map, encode_png(picture));
    files.push_back({*map_, map});
  }
  if (streamed.raster) {
    files.push_back({*error_raster_, {}, &*streamed.raster});
  } else if (error_raster_) {
    SCARP_TRY(raster, encode_raster({errors, field.cols, field.rows, &field.info}, RasterFormat::kGeoTiff));
    files.push_back({*error_raster_, raster});
  }
  return scarp::write_files(files, overwrite_);
}

Result<void> MeasureCommand::read_inputs(const ProgressCallback& progress, Judged& judged) const {
  SCARP_TRY(judged.mesh, read_mesh(mesh_));
  turn_up(judged.is_y_up, mesh_, judged.mesh);
  undo_placement(judged.mesh);
  const RasterArguments asked = remember_options(raster_, judged.mesh);
  const bool crs_from_mesh = asked.crs && !raster_.crs;
  Result<ReadOptions> read = asked.parse();
  if (!read) {
    read.error().message += fmt::format("; {} says so of itself, the option overrides it", mesh_);
    return tl::unexpected(std::move(read.error()));
  }
  judged.band = read->band;
  read->run.progress = progress;
  read->heights_in = judged.plan.image ? HeightsIn::kFile : heights_in(mesh_);
  read->with_range = judged.goal && judged.goal->percent_of_relief;
  Result<void> has_field = read_field(*read, judged);
  if (!has_field) {
    if (crs_from_mesh && has_field.error().kind == ErrorKind::kUsage) {
      has_field.error().message += fmt::format("; {} names that CRS as its own, --crs overrides it", mesh_);
    }
    return has_field;
  }
  if (!asked.crs && fit_frame(judged.mesh, judged.field)) {
    read->crs = "source";
    SCARP_RETURN_IF_ERROR(read_field(*read, judged));
  }
  if (!raster_.crs) judged.warnings = place_frame(judged.mesh, judged.field);
  if (!judged.channels.empty()) {
    SCARP_RETURN_IF_ERROR(restore_channels(judged.mesh, judged.channels, mesh_));
  }
  if (judged.goal) {
    RasterInfo& info = judged.field.info;
    if (judged.plan.image && !judged.goal->unit.empty())
      return fail(ErrorKind::kUsage, "--fail-above with a unit is for heights: errors of --image are in grey levels");
    SCARP_RETURN_IF_ERROR(settle_goal("--fail-above", info, *judged.goal, info.warnings));
    judged.fail_above = judged.goal->absolute(judged.plan.image ? judged.channels.relief : info.max - info.min);
  }
  SCARP_TRY(const std::optional<std::uint64_t>& limit, memory_.parse());
  SCARP_TRY(const int threads, parse_threads(threads_));
  SCARP_TRY(judged.companions, read_companions(companions_, judged.field.info, judged.field, judged.fail_above,
                                               {progress, limit.value_or(0), threads}));
  if (error_raster_ && limit && judged.field.source) {
    const std::uint64_t bytes = judged.companions.bytes + RasterFile::bytes(judged.field.cols);
    SCARP_RETURN_IF_ERROR(check_room(judged.field, *limit, bytes, "--error-raster"));
  }
  SCARP_TRY(judged.cut, read_cut(cut_, judged.field.info, progress, judged.field, judged.companions.warnings));
  const std::vector<std::string>& of_raster = judged.field.info.warnings;
  judged.warnings.insert(judged.warnings.begin(), of_raster.begin(), of_raster.end());
  judged.warnings.insert(judged.warnings.end(), judged.companions.warnings.begin(), judged.companions.warnings.end());
  return {};
}

Result<void> MeasureCommand::read_field(const ReadOptions& options, Judged& judged) const {
  if (judged.plan.image) {
    SCARP_TRY(Image image, read_image(judged.plan, raster_.path(), options, raster_.band.has_value()));
    judged.field = std::move(image.field);
    judged.channels = std::move(image.channels);
    return {};
  }
  SCARP_TRY(const std::optional<std::uint64_t>& limit, memory_.parse());
  MemoryNeeds needs{cut_.files.empty() && companions_.roi.empty() ? 0 : kVectorBytes};
  if (companions_.gives_bounds()) needs.per_sample = kBoundedSampleBytes;
  Result<OwnedHeightField> field = read_within(raster_.path(), options, limit, needs);
  if (!field) return tl::unexpected(raster_.explain(std::move(field.error())));
  if (const std::optional<std::string> need = find_need_of_samples()) {
    SCARP_RETURN_IF_ERROR(check_in_memory(*field, *need, needs));
  }
  judged.field = std::move(*field);
  SCARP_TRY(judged.channels, read_textures(judged.plan, judged.field, options.run.progress));
  return {};
}

std::optional<std::string> MeasureCommand::find_need_of_samples() const {
  const std::string others = channels_.canonical();
  if (others.empty()) return std::nullopt;
  return others.substr(1, others.find(' ', 1) - 1);
}

Result<MeasureCommand::StreamedErrors> MeasureCommand::begin_errors(const Judged& judged) const {
  StreamedErrors errors;
  const OwnedHeightField& field = judged.field;
  if (!field.source) return errors;
  if (map_) {
    const std::uint64_t limit = memory_.parse()->value_or(0);
    const MemoryShare memory{limit, bytes_taken(field, limit) + judged.companions.bytes};
    const int side = picture_side(field, memory, judged.mesh.vertex_count());
    errors.map.emplace(field.cols, field.rows, map_options(judged, side));
  }
  if (error_raster_) {
    SCARP_TRY(errors.raster, RasterFile::create(*error_raster_, field.cols, field.rows, &field.info, overwrite_));
  }
  return errors;
}

Result<Judgement> MeasureCommand::judge(const ProgressCallback& progress, const Judged& judged,
                                        StreamedErrors& errors) const {
  JudgeOptions options;
  options.tolerances = judged.companions.bounds();
  options.max_error = judged.fail_above;
  options.norm = judged.plan.norm;
  options.cutline = judged.cut.judged();
  options.keep_errors = !judged.field.source && (map_ || error_raster_);
  options.run.threads = *parse_threads(threads_);
  options.run.progress = progress;
  Result<void> written;
  if (errors.map || errors.raster) {
    options.on_row = [&](int row, std::span<const float> of_row) {
      if (errors.map) errors.map->add(row, of_row);
      if (errors.raster && written) written = errors.raster->add(of_row);
    };
  }
  SCARP_TRY(auto&& judgement, judge_mesh(judged.view(), judged.mesh, options));
  if (errors.raster && written) written = errors.raster->finish();
  SCARP_RETURN_IF_ERROR(written);
  return judgement;
}

MeasurePointsArguments MeasureCommand::points_arguments() const {
  return {raster_, mesh_, fail_above_, threads_, json_, quiet_, json_progress_};
}

Result<void> MeasureCommand::judge_points_inputs(const Runner& runner, JudgedPoints& judged) const {
  return judge_points(*command_, points_arguments(), points_, runner, judged);
}

Result<void> MeasureCommand::judge_inputs(const Runner& runner, Judged& judged, StreamedErrors& errors) const {
  const Clock::time_point start = Clock::now();
  SCARP_RETURN_IF_ERROR(check_order());
  SCARP_RETURN_IF_ERROR(raster_.parse());
  SCARP_RETURN_IF_ERROR(parse_threads(threads_));
  SCARP_TRY(judged.is_y_up, parse_up(up_));
  SCARP_TRY(judged.plan, channels_.parse(raster_));
  SCARP_RETURN_IF_ERROR(companions_.check("--fail-above", fail_above_.has_value()));
  SCARP_RETURN_IF_ERROR(cut_.check());
  SCARP_TRY(const std::optional<std::uint64_t>& limit, memory_.parse());
  if (limit && judged.plan.image) {
    return fail(ErrorKind::kUsage, "--memory cannot be combined with --image: images are read as a whole");
  }
  if (fail_above_) {
    SCARP_TRY(ErrorGoal goal, parse_error_goal("--fail-above", *fail_above_));
    SCARP_RETURN_IF_ERROR(refuse_print("--fail-above", goal));
    judged.goal = std::move(goal);
  }
  SCARP_RETURN_IF_ERROR(check_outputs_of_run());

  SCARP_RETURN_IF_ERROR(read_inputs(runner.progress, judged));
  judged.seconds_read = seconds_since(start);

  const Clock::time_point measure_start = Clock::now();
  SCARP_TRY(errors, begin_errors(judged));
  SCARP_TRY(judged.judgement, judge(runner.progress, judged, errors));
  complete_info(judged.judgement.heights.heights, judged.field.info);
  judged.seconds_measure = seconds_since(measure_start);
  decide(judged);
  if (judged.judgement.heights.samples == 0)
    judged.broken = describe_elsewhere(extent_of(judged.mesh), extent_of(judged.field.view()), raster_.path());
  return {};
}

}  // namespace scarp::cli
