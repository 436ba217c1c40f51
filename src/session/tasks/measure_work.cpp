#include "session/tasks/measure_work.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "scarp/picture.h"
#include "scarp/solid.h"
#include "session/inputs/cutline.h"
#include "session/inputs/memory.h"
#include "session/inputs/mesh_place.h"
#include "session/options/error_goal.h"
#include "session/options/output_kind.h"
#include "session/plan/outputs.h"
#include "session/reports/pictures.h"
#include "session/text/clock.h"
#include "session/text/paths.h"
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

/// The likeliest mistake of all: the mesh before the raster.
Result<void> check_order(const MeasureArguments& given) {
  if (given.raster.paths.size() != 1 || !find_mesh_file(given.raster.path()) ||
      find_mesh_format(lower_extension(given.mesh)))
    return {};
  return fail(ErrorKind::kUsage,
              fmt::format("{} is a mesh: the raster comes first, scarp measure {} {}", shell_word(given.raster.path()),
                          shell_word(given.mesh), shell_word(given.raster.path())));
}

Result<void> check_outputs_of_run(const MeasureArguments& given, const std::vector<std::string>& files_read) {
  std::vector<PlannedOutput> outputs;
  if (given.map) {
    outputs.push_back({"--map", *given.map});
    SCARP_RETURN_IF_ERROR(check_png_name(outputs.back()));
  }
  if (given.error_raster) {
    outputs.push_back({"--error-raster", *given.error_raster});
    SCARP_RETURN_IF_ERROR(check_tiff_name(outputs.back()));
  }
  SCARP_RETURN_IF_ERROR(check_outputs(outputs, files_read, given.overwrite));
  for (const PlannedOutput& output : outputs) {
    if (given.json && is_stdout(output.path)) {
      return fail(ErrorKind::kUsage,
                  fmt::format("--json and {} /dev/stdout both write to standard output", output.option));
    }
  }
  return {};
}

ErrorMapOptions map_options(const MeasureArguments& given, const Judged& judged, int max_side) {
  const std::string unit = judged.plan.image ? "grey levels" : short_unit(judged.field.info.unit);
  return error_map_options(judged.field.info, unit, given.mesh, max_side);
}

/// The first option that was given and needs all samples in memory; nothing if there is none.
std::optional<std::string> find_need_of_samples(const MeasureArguments& given) {
  const std::string others = given.channels.canonical();
  if (others.empty()) return std::nullopt;
  return others.substr(1, others.find(' ', 1) - 1);
}

Result<void> read_field(const MeasureArguments& given, const ReadOptions& options, Judged& judged) {
  if (judged.plan.image) {
    SCARP_TRY(Image image, read_image(judged.plan, given.raster.path(), options, given.raster.band.has_value()));
    judged.field = std::move(image.field);
    judged.channels = std::move(image.channels);
    return {};
  }
  SCARP_TRY(const std::optional<std::uint64_t> limit, given.memory.parse());
  MemoryNeeds needs{given.cut.files.empty() && given.companions.roi.empty() ? 0 : kVectorBytes};
  if (given.companions.gives_bounds()) needs.per_sample = kBoundedSampleBytes;
  Result<OwnedHeightField> field = read_within(given.raster.path(), options, limit, needs);
  if (!field) return tl::unexpected(given.raster.explain(std::move(field.error())));
  if (const std::optional<std::string> need = find_need_of_samples(given)) {
    SCARP_RETURN_IF_ERROR(check_in_memory(*field, *need, needs));
  }
  judged.field = std::move(*field);
  SCARP_TRY(judged.channels, read_textures(judged.plan, judged.field, options.run.progress));
  return {};
}

Result<void> read_inputs(const MeasureArguments& given, const ProgressCallback& progress, Judged& judged) {
  SCARP_TRY(judged.mesh, read_mesh(given.mesh));
  turn_up(judged.is_y_up, given.mesh, judged.mesh);
  undo_placement(judged.mesh);
  const RasterArguments asked = remember_options(given.raster, judged.mesh);
  const bool crs_from_mesh = asked.crs && !given.raster.crs;
  Result<ReadOptions> read = asked.parse();
  if (!read) {
    read.error().message += fmt::format("; {} says so of itself, the option overrides it", given.mesh);
    return tl::unexpected(std::move(read.error()));
  }
  judged.band = read->band;
  read->run.progress = progress;
  read->heights_in = judged.plan.image ? HeightsIn::kFile : heights_in(given.mesh);
  read->with_range = judged.goal && judged.goal->percent_of_relief;
  Result<void> has_field = read_field(given, *read, judged);
  if (!has_field) {
    if (crs_from_mesh && has_field.error().kind == ErrorKind::kUsage) {
      has_field.error().message += fmt::format("; {} names that CRS as its own, --crs overrides it", given.mesh);
    }
    return has_field;
  }
  if (!asked.crs && fit_frame(judged.mesh, judged.field)) {
    read->crs = "source";
    SCARP_RETURN_IF_ERROR(read_field(given, *read, judged));
  }
  if (!given.raster.crs) judged.warnings = place_frame(judged.mesh, judged.field);
  if (!judged.channels.empty()) {
    SCARP_RETURN_IF_ERROR(restore_channels(judged.mesh, judged.channels, given.mesh));
  }
  if (judged.goal) {
    RasterInfo& info = judged.field.info;
    if (judged.plan.image && !judged.goal->unit.empty())
      return fail(ErrorKind::kUsage, "--fail-above with a unit is for heights: errors of --image are in grey levels");
    SCARP_RETURN_IF_ERROR(settle_goal("--fail-above", info, *judged.goal, info.warnings));
    judged.fail_above = judged.goal->absolute(judged.plan.image ? judged.channels.relief : info.max - info.min);
  }
  SCARP_TRY(const std::optional<std::uint64_t> limit, given.memory.parse());
  SCARP_TRY(const int threads, parse_threads(given.threads));
  SCARP_TRY(judged.companions, read_companions(given.companions, judged.field.info, judged.field, judged.fail_above,
                                               {progress, limit.value_or(0), threads}));
  if (given.error_raster && limit && judged.field.source) {
    const std::uint64_t bytes = judged.companions.bytes + RasterFile::bytes(judged.field.cols);
    SCARP_RETURN_IF_ERROR(check_room(judged.field, *limit, bytes, "--error-raster"));
  }
  SCARP_TRY(judged.cut, read_cut(given.cut, judged.field.info, progress, judged.field, judged.companions.warnings));
  const std::vector<std::string>& of_raster = judged.field.info.warnings;
  judged.warnings.insert(judged.warnings.begin(), of_raster.begin(), of_raster.end());
  judged.warnings.insert(judged.warnings.end(), judged.companions.warnings.begin(), judged.companions.warnings.end());
  return {};
}

Result<StreamedErrors> begin_errors(const MeasureArguments& given, const Judged& judged) {
  StreamedErrors errors;
  const OwnedHeightField& field = judged.field;
  if (!field.source) return errors;
  if (given.map) {
    const std::uint64_t limit = given.memory.parse()->value_or(0);
    const MemoryShare memory{limit, bytes_taken(field, limit) + judged.companions.bytes};
    const int side = picture_side(field, memory, judged.mesh.vertex_count());
    errors.map.emplace(field.cols, field.rows, map_options(given, judged, side));
  }
  if (given.error_raster) {
    SCARP_TRY(errors.raster,
              RasterFile::create(*given.error_raster, field.cols, field.rows, &field.info, given.overwrite));
  }
  return errors;
}

Result<Judgement> judge_errors(const MeasureArguments& given, const ProgressCallback& progress, const Judged& judged,
                               StreamedErrors& errors) {
  JudgeOptions options;
  options.tolerances = judged.companions.bounds();
  options.max_error = judged.fail_above;
  options.norm = judged.plan.norm;
  options.cutline = judged.cut.judged();
  options.keep_errors = !judged.field.source && (given.map || given.error_raster);
  options.run.threads = *parse_threads(given.threads);
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

}  // namespace

Result<void> judge_inputs(const MeasureArguments& given, const std::vector<std::string>& files_read,
                          const Runner& runner, Judged& judged, StreamedErrors& errors) {
  const Clock::time_point start = Clock::now();
  SCARP_RETURN_IF_ERROR(check_order(given));
  SCARP_RETURN_IF_ERROR(given.raster.parse());
  SCARP_RETURN_IF_ERROR(parse_threads(given.threads));
  SCARP_TRY(judged.is_y_up, parse_up(given.up));
  SCARP_TRY(judged.plan, given.channels.parse(given.raster));
  SCARP_RETURN_IF_ERROR(given.companions.check("--fail-above", given.fail_above.has_value()));
  SCARP_RETURN_IF_ERROR(given.cut.check());
  SCARP_TRY(const std::optional<std::uint64_t> limit, given.memory.parse());
  if (limit && judged.plan.image) {
    return fail(ErrorKind::kUsage, "--memory cannot be combined with --image: images are read as a whole");
  }
  if (given.fail_above) {
    SCARP_TRY(ErrorGoal goal, parse_error_goal("--fail-above", *given.fail_above));
    SCARP_RETURN_IF_ERROR(refuse_print("--fail-above", goal));
    judged.goal = std::move(goal);
  }
  SCARP_RETURN_IF_ERROR(check_outputs_of_run(given, files_read));

  SCARP_RETURN_IF_ERROR(read_inputs(given, runner.progress, judged));
  judged.seconds_read = seconds_since(start);

  const Clock::time_point measure_start = Clock::now();
  SCARP_TRY(errors, begin_errors(given, judged));
  SCARP_TRY(judged.judgement, judge_errors(given, runner.progress, judged, errors));
  complete_info(judged.judgement.heights.heights, judged.field.info);
  judged.seconds_measure = seconds_since(measure_start);
  decide(judged);
  if (judged.judgement.heights.samples == 0)
    judged.broken = describe_elsewhere(extent_of(judged.mesh), extent_of(judged.field.view()), given.raster.path());
  return {};
}

Result<void> write_error_files(const MeasureArguments& given, const Judged& judged, StreamedErrors& streamed) {
  if (!given.map && !given.error_raster) return {};
  const OwnedHeightField& field = judged.field;
  std::vector<float> errors;
  if (!field.source)
    errors = take_error_raster(judged.judgement, judged.plan.image ? ErrorsOf::kNorms : ErrorsOf::kHeights);
  std::vector<std::uint8_t> map, raster;
  std::vector<FileBytes> files;
  if (given.map) {
    const Picture picture = streamed.map
                                ? streamed.map->draw()
                                : draw_error_map(errors, field.cols, field.rows, map_options(given, judged, 1400));
    SCARP_TRY(map, encode_png(picture));
    files.push_back({*given.map, map});
  }
  if (streamed.raster) {
    files.push_back({*given.error_raster, {}, &*streamed.raster});
  } else if (given.error_raster) {
    SCARP_TRY(raster, encode_raster({errors, field.cols, field.rows, &field.info}, RasterFormat::kGeoTiff));
    files.push_back({*given.error_raster, raster});
  }
  return write_files(files, given.overwrite);
}

}  // namespace scarp::cli
