#include "session/plan/simplify_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "session/options/memory_options.h"
#include "session/options/raster_options.h"
#include "session/options/shape_options.h"
#include "session/options/strategy_options.h"
#include "session/plan/conflicts.h"
#include "session/plan/page_template.h"
#include "session/table/format_words.h"
#include "session/text/paths.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

using enum OptionId;

constexpr Choice<NodataPolicy> kPolicies[] = {
    {"hole", NodataPolicy::kHole}, {"fill", NodataPolicy::kFill}, {"background", NodataPolicy::kBackground}};

Result<void> plan_goals(const GivenOptions& given, SimplifyPlan& plan) {
  if (!given.first_of({kMaxError, kMaxTriangles, kMaxPoints, kTolerance, kRoi}))
    return fail(ErrorKind::kUsage,
                fmt::format("no goal is given: say how good the mesh must be, such as -e 1 for heights within 1 unit, "
                            "or how small with -t or -p; 'scarp info {}' suggests errors",
                            shell_word(given.input())));
  if (given.has(kMaxError)) {
    SCARP_TRY(plan.error_goal, parse_error_goal(kMaxError, *given[kMaxError]));
  }
  SCARP_TRY(plan.simplify.goals.max_triangles, given.count(kMaxTriangles));
  SCARP_TRY(plan.simplify.goals.max_vertices, given.count(kMaxPoints));
  return {};
}

Result<void> plan_nodata(const GivenOptions& given, SimplifyPlan& plan) {
  SCARP_TRY(const auto policy, given.choice(kNodataPolicy, kPolicies));
  plan.policy = policy.value_or(NodataPolicy::kHole);
  SCARP_TRY(plan.fill_distance, parse_fill_distance(given, plan.policy == NodataPolicy::kFill));
  SCARP_TRY(const auto height, given.number(kBackground));
  if (height && std::abs(*height) > std::numeric_limits<float>::max())
    return fail(ErrorKind::kUsage, fmt::format("{} {} does not fit a float", kBackground, *given[kBackground]));
  plan.background = static_cast<float>(height.value_or(0));
  SCARP_TRY(const auto outline, given.number(kOutlineTolerance));
  plan.simplify.domain.outline_tolerance = outline.value_or(plan.simplify.domain.outline_tolerance);
  return {};
}

Result<void> plan_channels(const GivenOptions& given, SimplifyPlan& plan) {
  SCARP_TRY(plan.channels, parse_channels(given));
  plan.simplify.goals.norm = plan.channels.norm;
  return {};
}

Result<void> plan_strategy(const GivenOptions& given, SimplifyPlan& plan) {
  SCARP_RETURN_IF_ERROR(check_regions(given));
  SCARP_RETURN_IF_ERROR(parse_strategy(given, plan.simplify, plan.strategy));
  plan.strategy_option = find_strategy(given);
  plan.by_paper = !plan.strategy_option.empty();
  const Importance::Feature feature = plan.strategy.importance.feature;
  const bool is_of_heights = feature != Importance::Feature::kNoFeature && feature != Importance::Feature::kDistance;
  if (plan.channels.image && is_of_heights)
    return fail(ErrorKind::kUsage,
                fmt::format("{} measures features of heights, which an {} has not: leave it out", kImportance, kImage));
  return {};
}

Result<void> plan_lines(const GivenOptions& given, SimplifyPlan& plan) {
  // Water is level if all corners of its triangles are at samples in it or on its shore.
  if (find_lakes(given)) plan.simplify.quality.vertices = Vertices::kSamples;
  return check_lines(given);
}

Result<void> plan_shape(const GivenOptions& given, SimplifyPlan& plan) {
  SCARP_TRY(plan.simplify.quality.shape, parse_shape(given));
  return {};
}

Result<void> plan_border(const GivenOptions& given, SimplifyPlan& plan) {
  plan.simplify.domain.border.is_locked = given.first_of({kLockBorder, kLods}).has_value();
  return {};
}

Result<void> plan_conflicts(const GivenOptions& given, SimplifyPlan& plan) { return check_conflicts(given, plan); }

Result<void> plan_solid(const GivenOptions& given, SimplifyPlan& plan) {
  SCARP_TRY(plan.solid, parse_solid(given, plan.warnings));
  if (!plan.error_goal || !plan.error_goal->is_on_print) return {};
  if (!plan.solid || !plan.solid->size)
    return fail(ErrorKind::kUsage, fmt::format("{} {} is an error on a print, which needs its size: {} size=120mm",
                                               kMaxError, *given[kMaxError], kSolid));
  if (!(plan.error_goal->value > 0))
    return fail(ErrorKind::kUsage, fmt::format("{} {} is not above 0: give 0 without a unit for every sample",
                                               kMaxError, *given[kMaxError]));
  plan.solid->max_error = plan.error_goal->value;
  return {};
}

/// Checks the requirements of solids and of the format.
Result<void> plan_solid_format(const SimplifyPlan& plan) {
  const OutputFormat& format = plan.format;
  if (format.holds_solids_only() && !plan.solid && !plan.base)
    return fail(ErrorKind::kUsage,
                fmt::format("{} holds closed solids only: say how to close the terrain, such as {} size=120mm",
                            format.title(), kSolid));
  if (!plan.solid) return {};
  if (!format.holds_prints())
    return fail(ErrorKind::kUsage,
                fmt::format("{} is for printing, and {} has no place for millimetres: choose .stl, .3mf, .obj or "
                            ".ply, or {} for a solid in the input's units",
                            kSolid, format.title(), kBase));
  if (plan.has_file_per_tile() && is_stdout(plan.output))
    return fail(ErrorKind::kUsage, fmt::format("{} writes several files: standard output is only one", kSplit));
  return {};
}

Result<void> plan_zones(const GivenOptions& given, SimplifyPlan& plan) {
  const auto zones = given.first_of({kMaterials, kNodeStrings});
  if (!zones || plan.format.holds_zones()) return {};
  const auto holds_zones = [](const MeshFormatTraits& traits) { return traits.holds_zones; };
  return fail(ErrorKind::kUsage, fmt::format("{} is for flow models, and {} has no place for it: choose {}", *zones,
                                             plan.format.title(), list_mesh_endings(holds_zones)));
}

/// Checks attributes that the format cannot hold: refuses if none would remain, else warns.
Result<void> plan_attributes(const GivenOptions& given, SimplifyPlan& plan) {
  const OutputFormat& format = plan.format;
  const std::string title = format.title();
  plan.simplify.output.normals = given.has(kNormals) && format.holds_attributes();
  plan.simplify.output.uvs =
      (given.has(kUvs) || plan.channels.has_channels() || plan.images.any()) && format.holds_attributes();
  const std::string& crs = plan.read.crs;
  const bool is_centred = crs.empty() || crs == "local" || crs == "grid" || crs == "enu";
  plan.simplify.output.float32_positions =
      format.is_float32() || (format.is_ply() && is_centred && !given.has(kDouble));
  plan.doubles = given.has(kDouble);
  if (given.has(kDouble) && !format.is_ply())
    return fail(ErrorKind::kUsage, fmt::format("{} is for PLY: the positions of {} are what they are", kDouble, title));
  SCARP_TRY(const bool is_y_up, choose_y_up(given[kUp], format, plan.solid.has_value()));
  // Readers of earth-centred coordinates expect them unchanged.
  plan.is_y_up = is_y_up && (given[kUp] || crs == "enu" || !is_in_space(crs));
  if (given.has(kCompress) && !format.is_glb()) {
    return fail(ErrorKind::kUsage, fmt::format("{} writes GLB, and OUTPUT is {}: choose .glb", kCompress, title));
  }
  plan.compress = plan.simplify.output.lattice = given.has(kCompress);
  const bool shows_image =
      format.holds_attributes() || format.kind == OutputKind::kSvg || format.kind == OutputKind::kEps;
  if (given.has(kImage) && !shows_image) {
    return fail(ErrorKind::kUsage, fmt::format("{} has no place for colours, and an image has no heights: choose .glb, "
                                               ".ply or .obj",
                                               title));
  }
  if (given[kBase] && !format.is_mesh()) {
    return fail(ErrorKind::kUsage,
                fmt::format("{} makes a solid, which {} cannot hold: choose a mesh format", kBase, title));
  }
  if (format.kind == OutputKind::kDem && given[kCrs]) {
    plan.warnings.push_back(
        fmt::format("a raster's approximation lies on the raster's own grid, whatever {} is", kCrs));
  }
  if (format.holds_attributes()) return {};
  if (given.has(kNormals)) {
    plan.warnings.push_back(fmt::format("{} has no place for vertex normals: {} changes nothing", title, kNormals));
  }
  if (given.has(kUvs)) plan.warnings.push_back(fmt::format("{} has no place for uvs: {} changes nothing", title, kUvs));
  if (!given.all(kTexture).empty()) {
    plan.warnings.push_back(fmt::format("{} has no place for colours: the texture shapes the mesh only", title));
  }
  return {};
}

Result<void> plan_outputs(const GivenOptions& given, SimplifyPlan& plan) {
  SCARP_TRY(const OutputFormat& format, choose_output_format(given[kOf], *given[kOutput]));
  plan.format = format;
  plan.read.default_frame = format.default_frame();
  plan.read.heights_in = plan.channels.image ? HeightsIn::kFile : format.heights_in();
  SCARP_TRY(plan.base, given.number(kBase));
  SCARP_TRY(plan.images, parse_images(given, format));
  SCARP_RETURN_IF_ERROR(plan_attributes(given, plan));
  SCARP_RETURN_IF_ERROR(plan_solid_format(plan));

  SCARP_TRY(plan.levels, parse_levels(given, plan.format));
  plan.levels_in_one = given.has(kLodsInOne);
  std::vector<PlannedOutput> outputs;
  if (plan.has_file_per_level()) {
    for (int k = 0; k < plan.levels->count; ++k) outputs.push_back({name_of(kLods), level_path(plan.output, k)});
  } else if (!plan.has_file_per_tile())
    outputs.push_back({name_of(kOutput), plan.output});
  for (int k = 0; plan.has_file_per_tile() && k < plan.solid->columns * plan.solid->rows; ++k) {
    const int columns = plan.solid->columns;
    outputs.push_back({name_of(kSplit), tile_path(plan.output, k / columns + 1, k % columns + 1)});
  }
  for (const OptionId id : {kPreview, kRender, kErrorRaster, kHtml, kContoursOut, kReport}) {
    if (!given.has(id)) continue;
    outputs.push_back({name_of(id), *given[id]});
    SCARP_RETURN_IF_ERROR(check_ending(*find_option(given.command(), id), outputs.back()));
  }
  SCARP_RETURN_IF_ERROR(given.number(kContourInterval));
  plan.outputs = std::move(outputs);
  return {};
}

Result<void> plan_page(const GivenOptions& given, SimplifyPlan& plan) {
  if (!given[kHtml]) return {};
  SCARP_TRY(plan.page_template, read_page_template());
  return {};
}

/// Refuses settings of a mesh that conflict with a frame in space, where z is not the height.
Result<void> plan_space(const GivenOptions& given, SimplifyPlan& plan) {
  if (!is_in_space(plan.read.crs)) return {};
  const std::pair<OptionId, const char*> others[] = {{kBase, "a base lies below heights over a map"},
                                                     {kSolid, "a print stands on a flat base"},
                                                     {kPreview, "pictures show maps"},
                                                     {kRender, "pictures show maps"},
                                                     {kContoursOut, "contours have the height of a map"},
                                                     {kNormalMap, "its normals are those of a map"}};
  const std::string space = fmt::format("{} {}", kCrs, shell_word(plan.read.crs));
  if (!plan.format.holds_space())
    return fail(ErrorKind::kUsage,
                fmt::format("{} cannot be combined with {} as OUTPUT: it holds heights over a map; choose .glb, .obj, "
                            ".ply or .stl",
                            space, plan.format.title()));
  for (const auto& [id, reason] : others) {
    if (given.has(id))
      return fail(ErrorKind::kUsage, fmt::format("{} cannot be combined with {}: {}", space, id, reason));
  }
  return {};
}

/// "scarp simplify dem.tif OUTPUT --max-error 1"; scarp classic for a strategy of the paper.
std::string canonical_command(const GivenOptions& given) {
  std::string options = given.canonical();
  if (asks_for_greedy(given)) options += fmt::format(" {} greedy", kOrder);
  const std::vector<const OptionRow*> rows = given.given();
  const bool is_classic = asks_for_greedy(given) || std::any_of(rows.begin(), rows.end(), [](const OptionRow* row) {
                            return row->group == OptionGroup::kStrategies && row->is_of_mesh;
                          });
  std::string command = is_classic ? "scarp classic" : "scarp simplify";
  for (const std::string& path : given.inputs()) command += " " + shell_word(base_name(path));
  return command + " OUTPUT" + options;
}

/// The first option given that needs more than a few samples at a time, if any.
std::optional<std::string> find_need_of_samples(const GivenOptions& given, const SimplifyPlan& plan) {
  if (const auto unstreamed = find_unstreamed(given, plan)) return unstreamed;
  if (plan.policy != NodataPolicy::kHole) return name_of(kNodataPolicy);
  if (given.has(kRender)) return name_of(kRender);
  const bool is_pgm = plan.format.kind == OutputKind::kDem && plan.format.raster == RasterFormat::kPgm;
  return is_pgm ? std::optional<std::string>(".pgm as OUTPUT") : std::nullopt;
}

Result<void> plan_memory(const GivenOptions& given, SimplifyPlan& plan) {
  SCARP_TRY(plan.memory, parse_memory(given));
  if (!plan.memory) return {};
  plan.simplify.run.memory.limit = *plan.memory;
  plan.simplify.run.memory.per_vertex = plan.format.bytes_per_vertex();
  // A solid's bottom and walls double the vertices; a print is judged while its mesh is in memory.
  constexpr std::uint64_t kMeshBytes = 48;
  if (plan.base) plan.simplify.run.memory.per_vertex = 2 * plan.simplify.run.memory.per_vertex + kMeshBytes;
  if (plan.solid) plan.simplify.run.memory.per_vertex += 4 * kMeshBytes;
  plan.needs_samples = find_need_of_samples(given, plan);
  // The proof finds the range of all other rasters, but not of one with lakes.
  const bool is_flattened = !given.all(kWater).empty();
  plan.read.with_range = is_flattened || (plan.error_goal && plan.error_goal->percent_of_relief);
  return {};
}

}  // namespace

Result<SimplifyPlan> plan_simplify(const GivenOptions& given, const std::vector<std::string>& files_read) {
  SimplifyPlan plan;
  plan.given = given;
  plan.input = given.input();
  plan.output = *given[kOutput];
  plan.preview = given[kPreview];
  plan.render = given[kRender];
  plan.error_raster = given[kErrorRaster];
  plan.html = given[kHtml];
  plan.report = given[kReport];
  plan.overwrite = given.has(kOverwrite);
  plan.canonical_command = canonical_command(given);

  SCARP_TRY(plan.read, parse_reading(given));
  SCARP_TRY(const int threads, given.threads());
  plan.simplify.run.threads = plan.read.run.threads = threads;
  for (const auto step : {plan_goals, plan_nodata, plan_channels, plan_strategy, plan_solid, plan_lines, plan_shape,
                          plan_border, plan_conflicts, plan_outputs, plan_page, plan_zones, plan_space, plan_memory}) {
    SCARP_RETURN_IF_ERROR(step(given, plan));
  }
  // Checked last, so that a wrong option is reported first.
  SCARP_RETURN_IF_ERROR(check_outputs(plan.outputs, files_read, plan.overwrite));
  return plan;
}

}  // namespace scarp::cli
