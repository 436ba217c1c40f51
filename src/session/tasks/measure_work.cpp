#include "session/tasks/measure_work.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "scarp/mesh.h"
#include "scarp/picture.h"
#include "session/inputs/cutline.h"
#include "session/inputs/memory.h"
#include "session/inputs/mesh_place.h"
#include "session/options/error_goal.h"
#include "session/options/output_kind.h"
#include "session/options/raster_options.h"
#include "session/plan/outputs.h"
#include "session/reports/pictures.h"
#include "session/text/clock.h"
#include "session/text/paths.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

using enum OptionId;

/// Fills mesh.channels from 8-bit colours if the file has nothing else, and checks their number. `path`: the mesh file,
/// for errors.
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

/// Detects the most likely mistake: the mesh before the raster.
Result<void> check_order(const GivenOptions& given) {
  if (given.inputs().size() != 1 || !find_mesh_file(given.input()) || find_mesh_format(lower_extension(*given[kMesh])))
    return {};
  return fail(ErrorKind::kUsage,
              fmt::format("{} is a mesh: the raster comes first, scarp measure {} {}", shell_word(given.input()),
                          shell_word(*given[kMesh]), shell_word(given.input())));
}

ErrorMapOptions map_options(const GivenOptions& given, const Judged& judged, int max_side) {
  const std::string unit = judged.plan.image ? "grey levels" : short_unit(judged.field.info.unit);
  return error_map_options(judged.field.info, unit, *given[kMesh], max_side);
}

Result<void> read_field(const GivenOptions& given, const ReadOptions& options, Judged& judged) {
  if (judged.plan.image) {
    SCARP_TRY(Image image, read_image(judged.plan, given.input(), options, given[kBand].has_value()));
    judged.field = std::move(image.field);
    judged.channels = std::move(image.channels);
    return {};
  }
  SCARP_TRY(const std::optional<std::uint64_t> limit, parse_memory(given));
  MemoryNeeds needs{given.all(kCutline).empty() && given.all(kRoi).empty() ? 0 : kVectorBytes};
  if (gives_bounds(given)) needs.per_sample = kBoundedSampleBytes;
  Result<OwnedHeightField> field = read_within(given.input(), options, limit, needs);
  if (!field) return tl::unexpected(explain_reading(given, std::move(field.error())));
  if (const auto need = given.first_of({kTexture, kNorm, kChannelWeights})) {
    SCARP_RETURN_IF_ERROR(check_in_memory(*field, name_of(*need), needs));
  }
  judged.field = std::move(*field);
  SCARP_TRY(judged.channels, read_textures(judged.plan, judged.field, options.run.progress));
  return {};
}

Result<void> read_inputs(const GivenOptions& given, const ProgressCallback& progress, Judged& judged) {
  SCARP_TRY(judged.mesh, read_mesh(*given[kMesh]));
  turn_up(judged.is_y_up, *given[kMesh], judged.mesh);
  undo_placement(judged.mesh);
  const GivenOptions asked = remember_options(given, judged.mesh);
  const bool crs_from_mesh = asked.has(kCrs) && !given.has(kCrs);
  Result<ReadOptions> read = parse_reading(asked);
  if (!read) {
    read.error().message += fmt::format("; {} says so of itself, the option overrides it", *given[kMesh]);
    return tl::unexpected(std::move(read.error()));
  }
  judged.band = read->band;
  read->run.progress = progress;
  read->heights_in = judged.plan.image ? HeightsIn::kFile : heights_in(*given[kMesh]);
  read->with_range = judged.goal && judged.goal->percent_of_relief;
  Result<void> has_field = read_field(given, *read, judged);
  if (!has_field) {
    if (crs_from_mesh && has_field.error().kind == ErrorKind::kUsage) {
      has_field.error().message += fmt::format("; {} names that CRS as its own, {} overrides it", *given[kMesh], kCrs);
    }
    return has_field;
  }
  if (!asked.has(kCrs) && fit_frame(judged.mesh, judged.field)) {
    read->crs = "source";
    SCARP_RETURN_IF_ERROR(read_field(given, *read, judged));
  }
  if (!given[kCrs]) judged.warnings = place_frame(judged.mesh, judged.field);
  if (!judged.channels.empty()) {
    SCARP_RETURN_IF_ERROR(restore_channels(judged.mesh, judged.channels, *given[kMesh]));
  }
  if (judged.goal) {
    RasterInfo& info = judged.field.info;
    if (judged.plan.image && !judged.goal->unit.empty())
      return fail(ErrorKind::kUsage,
                  fmt::format("{} with a unit is for heights: errors of {} are in grey levels", kFailAbove, kImage));
    SCARP_RETURN_IF_ERROR(settle_goal(kFailAbove, info, *judged.goal, info.warnings));
    judged.fail_above = judged.goal->absolute(judged.plan.image ? judged.channels.relief : info.max - info.min);
  }
  SCARP_TRY(const std::optional<std::uint64_t> limit, parse_memory(given));
  SCARP_TRY(const int threads, given.threads());
  SCARP_TRY(judged.companions, read_companions(given, judged.field.info, judged.field, judged.fail_above,
                                               {progress, limit.value_or(0), threads}));
  if (given[kErrorRaster] && limit && judged.field.source) {
    const std::uint64_t bytes = judged.companions.bytes + RasterFile::bytes(judged.field.cols);
    SCARP_RETURN_IF_ERROR(check_room(judged.field, *limit, bytes, name_of(kErrorRaster)));
  }
  SCARP_TRY(judged.cut, read_cut(given, judged.field.info, progress, judged.field, judged.companions.warnings));
  const std::vector<std::string>& of_raster = judged.field.info.warnings;
  judged.warnings.insert(judged.warnings.begin(), of_raster.begin(), of_raster.end());
  judged.warnings.insert(judged.warnings.end(), judged.companions.warnings.begin(), judged.companions.warnings.end());
  return {};
}

Result<StreamedErrors> begin_errors(const GivenOptions& given, const Judged& judged) {
  StreamedErrors errors;
  const OwnedHeightField& field = judged.field;
  if (!field.source) return errors;
  if (given[kMap]) {
    const std::uint64_t limit = parse_memory(given)->value_or(0);
    const MemoryShare memory{limit, bytes_taken(field, limit) + judged.companions.bytes};
    const int side = picture_side(field, memory, judged.mesh.vertex_count());
    errors.map.emplace(field.cols, field.rows, map_options(given, judged, side));
  }
  if (given[kErrorRaster]) {
    SCARP_TRY(errors.raster,
              RasterFile::create(*given[kErrorRaster], field.cols, field.rows, &field.info, given.has(kOverwrite)));
  }
  return errors;
}

Result<judge::Judgement> judge_errors(const GivenOptions& given, const ProgressCallback& progress, const Judged& judged,
                                      StreamedErrors& errors) {
  judge::JudgeOptions options;
  options.tolerances = judged.companions.bounds();
  options.max_error = judged.fail_above;
  options.norm = judged.plan.norm;
  options.cutline = judged.cut.judged();
  options.keep_errors = !judged.field.source && (given[kMap] || given[kErrorRaster]);
  options.run.threads = *given.threads();
  options.run.progress = progress;
  Result<void> written;
  if (errors.map || errors.raster) {
    options.on_row = [&](int row, std::span<const float> of_row) {
      if (errors.map) errors.map->add(row, of_row);
      if (errors.raster && written) written = errors.raster->add(of_row);
    };
  }
  SCARP_TRY(auto&& judgement, judge::judge_mesh(judged.view(), judged.mesh, options));
  if (errors.raster && written) written = errors.raster->finish();
  SCARP_RETURN_IF_ERROR(written);
  return judgement;
}

}  // namespace

Result<void> check_measure_outputs(const GivenOptions& given) {
  std::vector<PlannedOutput> outputs;
  for (const OptionId id : {kMap, kErrorRaster}) {
    if (!given.has(id)) continue;
    outputs.push_back({name_of(id), *given[id]});
    SCARP_RETURN_IF_ERROR(check_ending(*find_option(given.command(), id), outputs.back()));
  }
  SCARP_RETURN_IF_ERROR(check_outputs(outputs, given.files_read(), given.has(kOverwrite)));
  for (const PlannedOutput& output : outputs) {
    if (given.has(kJson) && is_stdout(output.path))
      return fail(ErrorKind::kUsage,
                  fmt::format("{} and {} /dev/stdout both write to standard output", kJson, output.option));
  }
  return {};
}

Result<void> judge_inputs(const GivenOptions& given, const Runner& runner, Judged& judged, StreamedErrors& errors) {
  const Clock::time_point start = Clock::now();
  SCARP_RETURN_IF_ERROR(check_order(given));
  SCARP_RETURN_IF_ERROR(parse_reading(given));
  SCARP_RETURN_IF_ERROR(given.threads());
  SCARP_TRY(judged.is_y_up, parse_up(given[kUp]));
  SCARP_TRY(judged.plan, parse_channels(given));
  SCARP_RETURN_IF_ERROR(check_regions(given));
  SCARP_RETURN_IF_ERROR(given.number(kInset));
  SCARP_RETURN_IF_ERROR(parse_memory(given));
  if (given[kFailAbove]) {
    SCARP_TRY(ErrorGoal goal, parse_error_goal(kFailAbove, *given[kFailAbove]));
    SCARP_RETURN_IF_ERROR(refuse_print(kFailAbove, goal));
    judged.goal = std::move(goal);
  }
  SCARP_RETURN_IF_ERROR(check_measure_outputs(given));

  SCARP_RETURN_IF_ERROR(read_inputs(given, runner.progress, judged));
  judged.seconds_read = seconds_since(start);

  const Clock::time_point measure_start = Clock::now();
  SCARP_TRY(errors, begin_errors(given, judged));
  SCARP_TRY(judged.judgement, judge_errors(given, runner.progress, judged, errors));
  complete_info(judged.judgement.heights.heights, judged.field.info);
  judged.seconds_measure = seconds_since(measure_start);
  decide(judged);
  if (judged.judgement.heights.samples == 0)
    judged.broken = describe_elsewhere(extent_of(judged.mesh), extent_of(judged.field.view()), given.input());
  return {};
}

Result<void> write_error_files(const GivenOptions& given, const Judged& judged, StreamedErrors& streamed) {
  if (!given[kMap] && !given[kErrorRaster]) return {};
  const OwnedHeightField& field = judged.field;
  std::vector<float> errors;
  if (!field.source)
    errors = judge::take_error_raster(judged.judgement,
                                      judged.plan.image ? judge::ErrorsOf::kNorms : judge::ErrorsOf::kHeights);
  std::vector<std::uint8_t> map, raster;
  std::vector<FileBytes> files;
  if (given[kMap]) {
    const Picture picture = streamed.map
                                ? streamed.map->draw()
                                : draw_error_map(errors, field.cols, field.rows, map_options(given, judged, 1400));
    SCARP_TRY(map, encode_png(picture));
    files.push_back({*given[kMap], map});
  }
  if (streamed.raster) {
    files.push_back({*given[kErrorRaster], {}, &*streamed.raster});
  } else if (given[kErrorRaster]) {
    SCARP_TRY(raster, encode_raster({errors, field.cols, field.rows, &field.info}, RasterFormat::kGeoTiff));
    files.push_back({*given[kErrorRaster], raster});
  }
  return write_files(files, given.has(kOverwrite));
}

}  // namespace scarp::cli
