#include <fmt/format.h>

#include <utility>
#include <vector>

#include "commands/measure_command.h"
#include "scarp/picture.h"
#include "scarp/solid.h"
#include "session/inputs/mesh_place.h"
#include "session/options/output_kind.h"
#include "session/reports/measure_report.h"
#include "session/reports/pictures.h"
#include "session/reports/report.h"
#include "session/table/option_table.h"
#include "session/text/clock.h"
#include "session/text/text.h"

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
    const Result<void> named = check_png_name(outputs.back());
    if (!named) return named;
  }
  if (error_raster_) {
    outputs.push_back({"--error-raster", *error_raster_});
    const Result<void> named = check_tiff_name(outputs.back());
    if (!named) return named;
  }
  const Result<void> checked = check_outputs(outputs, files_read(*command_), overwrite_);
  if (!checked) return checked;
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
    Result<std::vector<std::uint8_t>> png = encode_png(picture);
    if (!png) return tl::unexpected(std::move(png.error()));
    map = std::move(*png);
    files.push_back({*map_, map});
  }
  if (streamed.raster) {
    files.push_back({*error_raster_, {}, &*streamed.raster});
  } else if (error_raster_) {
    Result<std::vector<std::uint8_t>> tiff =
        encode_raster({errors, field.cols, field.rows, &field.info}, RasterFormat::kGeoTiff);
    if (!tiff) return tl::unexpected(std::move(tiff.error()));
    raster = std::move(*tiff);
    files.push_back({*error_raster_, raster});
  }
  return scarp::write_files(files, overwrite_);
}

Result<void> MeasureCommand::read_inputs(const ProgressCallback& progress, Judged& judged) const {
  Result<Mesh> mesh = read_mesh(mesh_);
  if (!mesh) return tl::unexpected(std::move(mesh.error()));
  judged.mesh = std::move(*mesh);
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
    if (auto again = read_field(*read, judged); !again) return again;
  }
  if (!raster_.crs) judged.warnings = place_frame(judged.mesh, judged.field);
  if (!judged.channels.empty()) {
    const Result<void> restored = restore_channels(judged.mesh, judged.channels, mesh_);
    if (!restored) return restored;
  }
  if (judged.goal) {
    RasterInfo& info = judged.field.info;
    if (judged.plan.image && !judged.goal->unit.empty())
      return fail(ErrorKind::kUsage, "--fail-above with a unit is for heights: errors of --image are in grey levels");
    if (auto fits = settle_goal("--fail-above", info, *judged.goal, info.warnings); !fits) return fits;
    judged.fail_above = judged.goal->absolute(judged.plan.image ? judged.channels.relief : info.max - info.min);
  }
  const Result<std::optional<std::uint64_t>> limit = memory_.parse();
  if (!limit) return tl::unexpected(limit.error());
  const Result<int> threads = parse_threads(threads_);
  if (!threads) return tl::unexpected(threads.error());
  Result<Companions> companions = read_companions(companions_, judged.field.info, judged.field, judged.fail_above,
                                                  {progress, limit->value_or(0), *threads});
  if (!companions) return tl::unexpected(std::move(companions.error()));
  judged.companions = std::move(*companions);
  if (error_raster_ && *limit && judged.field.source) {
    const std::uint64_t bytes = judged.companions.bytes + RasterFile::bytes(judged.field.cols);
    if (auto fits = check_room(judged.field, **limit, bytes, "--error-raster"); !fits) return fits;
  }
  Result<Cut> cut = read_cut(cut_, judged.field.info, progress, judged.field, judged.companions.warnings);
  if (!cut) return tl::unexpected(std::move(cut.error()));
  judged.cut = std::move(*cut);
  const std::vector<std::string>& of_raster = judged.field.info.warnings;
  judged.warnings.insert(judged.warnings.begin(), of_raster.begin(), of_raster.end());
  judged.warnings.insert(judged.warnings.end(), judged.companions.warnings.begin(), judged.companions.warnings.end());
  return {};
}

Result<void> MeasureCommand::read_field(const ReadOptions& options, Judged& judged) const {
  if (judged.plan.image) {
    Result<Image> image = read_image(judged.plan, raster_.path(), options, raster_.band.has_value());
    if (!image) return tl::unexpected(std::move(image.error()));
    judged.field = std::move(image->field);
    judged.channels = std::move(image->channels);
    return {};
  }
  const Result<std::optional<std::uint64_t>> limit = memory_.parse();
  if (!limit) return tl::unexpected(limit.error());
  MemoryNeeds needs{cut_.files.empty() && companions_.roi.empty() ? 0 : kVectorBytes};
  if (companions_.gives_bounds()) needs.per_sample = kBoundedSampleBytes;
  Result<OwnedHeightField> field = read_within(raster_.path(), options, *limit, needs);
  if (!field) return tl::unexpected(raster_.explain(std::move(field.error())));
  if (const std::optional<std::string> need = find_need_of_samples()) {
    if (auto in_memory = check_in_memory(*field, *need, needs); !in_memory) return in_memory;
  }
  judged.field = std::move(*field);
  Result<Channels> textures = read_textures(judged.plan, judged.field, options.run.progress);
  if (!textures) return tl::unexpected(std::move(textures.error()));
  judged.channels = std::move(*textures);
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
    auto raster = RasterFile::create(*error_raster_, field.cols, field.rows, &field.info, overwrite_);
    if (!raster) return tl::unexpected(raster.error());
    errors.raster = std::move(*raster);
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
  auto judgement = judge_mesh(judged.view(), judged.mesh, options);
  if (!judgement) return judgement;
  if (errors.raster && written) written = errors.raster->finish();
  if (!written) return tl::unexpected(written.error());
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
  if (auto ordered = check_order(); !ordered) return ordered;
  const Result<ReadOptions> read = raster_.parse();
  if (!read) return tl::unexpected(read.error());
  const Result<int> threads = parse_threads(threads_);
  if (!threads) return tl::unexpected(threads.error());
  const Result<bool> is_y_up = parse_up(up_);
  if (!is_y_up) return tl::unexpected(is_y_up.error());
  judged.is_y_up = *is_y_up;
  Result<ChannelPlan> plan = channels_.parse(raster_);
  if (!plan) return tl::unexpected(std::move(plan.error()));
  judged.plan = std::move(*plan);
  const Result<void> companions_agree = companions_.check("--fail-above", fail_above_.has_value());
  if (!companions_agree) return companions_agree;
  if (auto checked = cut_.check(); !checked) return checked;
  const Result<std::optional<std::uint64_t>> limit = memory_.parse();
  if (!limit) return tl::unexpected(limit.error());
  if (*limit && judged.plan.image) {
    return fail(ErrorKind::kUsage, "--memory cannot be combined with --image: images are read as a whole");
  }
  if (fail_above_) {
    Result<ErrorGoal> goal = parse_error_goal("--fail-above", *fail_above_);
    if (!goal) return tl::unexpected(std::move(goal.error()));
    if (auto fits = refuse_print("--fail-above", *goal); !fits) return fits;
    judged.goal = std::move(*goal);
  }
  const Result<void> outputs = check_outputs_of_run();
  if (!outputs) return outputs;

  const Result<void> has_inputs = read_inputs(runner.progress, judged);
  if (!has_inputs) return has_inputs;
  judged.seconds_read = seconds_since(start);

  const Clock::time_point measure_start = Clock::now();
  Result<StreamedErrors> begun = begin_errors(judged);
  if (!begun) return tl::unexpected(std::move(begun.error()));
  errors = std::move(*begun);
  Result<Judgement> judgement = judge(runner.progress, judged, errors);
  if (!judgement) return tl::unexpected(std::move(judgement.error()));
  judged.judgement = std::move(*judgement);
  complete_info(judged.judgement.heights.heights, judged.field.info);
  judged.seconds_measure = seconds_since(measure_start);
  decide(judged);
  if (judged.judgement.heights.samples == 0)
    judged.broken = describe_elsewhere(extent_of(judged.mesh), extent_of(judged.field.view()), raster_.path());
  return {};
}

}  // namespace scarp::cli
