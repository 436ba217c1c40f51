#include "session/plan/simplify_plan.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

#include "session/plan/conflicts.h"
#include "session/plan/page_template.h"
#include "session/text/paths.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

Result<void> plan_goals(const SimplifyArguments& given, SimplifyPlan& plan) {
  if (!given.max_error && !given.max_triangles && !given.max_points && given.companions.find_tolerance() == nullptr) {
    return fail(ErrorKind::kUsage,
                fmt::format("no goal is given: say how good the mesh must be, such as -e 1 for heights within 1 unit, "
                            "or how small with -t or -p; 'scarp info {}' suggests errors",
                            shell_word(given.raster.path())));
  }
  if (given.max_error) {
    SCARP_TRY(plan.error_goal, parse_error_goal("--max-error", *given.max_error));
  }
  if (given.max_triangles) {
    SCARP_TRY(plan.simplify.goals.max_triangles, parse_count("--max-triangles", *given.max_triangles, 1));
  }
  if (given.max_points) {
    SCARP_TRY(plan.simplify.goals.max_vertices, parse_count("--max-points", *given.max_points, 1));
  }
  return {};
}

Result<void> plan_nodata(const SimplifyArguments& given, SimplifyPlan& plan) {
  const std::string policy = given.nodata_policy.value_or("hole");
  if (policy == "fill") {
    plan.policy = NodataPolicy::kFill;
  } else if (policy == "background") {
    plan.policy = NodataPolicy::kBackground;
  } else if (policy != "hole") {
    return fail(ErrorKind::kUsage,
                fmt::format("--nodata-policy {} is unknown: choose hole, fill or background", shell_word(policy)));
  }
  SCARP_TRY(plan.fill_distance, parse_fill_distance(given.fill_distance, plan.policy == NodataPolicy::kFill));
  if (given.background.has_value() != (plan.policy == NodataPolicy::kBackground)) {
    return fail(ErrorKind::kUsage, given.background
                                       ? "--background needs --nodata-policy background"
                                       : "--nodata-policy background needs the height to use: --background V");
  }
  if (given.background) {
    SCARP_TRY(const double height, parse_number("--background", *given.background));
    if (std::abs(height) > std::numeric_limits<float>::max()) {
      return fail(ErrorKind::kUsage, fmt::format("--background {} does not fit a float", *given.background));
    }
    plan.background = static_cast<float>(height);
  }
  if (given.outline_tolerance) {
    SCARP_TRY(plan.simplify.domain.outline_tolerance,
              parse_non_negative("--outline-tolerance", *given.outline_tolerance));
  }
  return {};
}

Result<void> plan_channels(const SimplifyArguments& given, SimplifyPlan& plan) {
  SCARP_TRY(const ChannelPlan& channels, given.channels.parse(given.raster));
  plan.channels = channels;
  plan.simplify.goals.norm = channels.norm;
  if (channels.image && plan.policy != NodataPolicy::kHole) {
    return fail(ErrorKind::kUsage, "--image cannot be combined with --nodata-policy: missing pixels are holes");
  }
  if (channels.has_channels() && !channels.image && channels.texture_weight == 1) {
    if (given.max_error) {
      return fail(ErrorKind::kUsage,
                  "--max-error bounds heights, and --texture-weight 1 does not look at them: ask for "
                  "a size with -t or -p, or choose a smaller weight");
    }
    if (const char* tolerance = given.companions.find_tolerance()) {
      return fail(ErrorKind::kUsage,
                  fmt::format("{} bounds heights, and --texture-weight 1 does not look at them", tolerance));
    }
  }
  return {};
}

Result<void> plan_strategy(const SimplifyArguments& given, SimplifyPlan& plan) {
  plan.companions = given.companions;
  SCARP_RETURN_IF_ERROR(given.companions.check("--max-error", given.max_error.has_value()));
  SCARP_RETURN_IF_ERROR(given.strategy.parse_into(plan.simplify, plan.strategy));
  const char* strategy = given.strategy.find_strategy();
  plan.by_paper = strategy != nullptr;
  if (plan.by_paper) plan.strategy_option = strategy;
  const Importance::Feature feature = plan.strategy.importance.feature;
  const bool is_of_heights = feature != Importance::Feature::kNoFeature && feature != Importance::Feature::kDistance;
  if (plan.channels.image && is_of_heights) {
    return fail(ErrorKind::kUsage, "--importance measures features of heights, which an --image has not: leave it out");
  }
  return {};
}

/// The budget that was given; null if there is none.
const char* find_budget(const SimplifyArguments& given) {
  if (given.max_triangles) return "--max-triangles";
  return given.max_points ? "--max-points" : nullptr;
}

/// The option that gives samples bounds of their own; null if there is none.
const char* find_bounds(const SimplifyArguments& given) {
  if (given.companions.mask) return "--mask";
  if (const char* tolerance = given.companions.find_tolerance()) return tolerance;
  return given.companions.script ? "--script" : nullptr;
}

Result<void> plan_lines(const SimplifyArguments& given, SimplifyPlan& plan) {
  plan.lines = given.lines;
  plan.cliff = given.cliff;
  plan.ridges = given.ridges;
  plan.cut = given.cut;
  plan.zones = given.zones;
  SCARP_RETURN_IF_ERROR(given.lines.check());
  SCARP_RETURN_IF_ERROR(given.cliff.check(given.max_error || find_budget(given) != nullptr));
  SCARP_RETURN_IF_ERROR(given.ridges.check(given.max_error || find_budget(given) != nullptr));
  SCARP_RETURN_IF_ERROR(given.cut.check());
  // Water is level where all corners of its triangles are: at samples and on its shore.
  const char* lakes = given.lines.find_lakes();
  if (lakes != nullptr && plan.simplify.quality.vertices == Vertices::kFree)
    return fail(ErrorKind::kUsage, fmt::format("{} cannot be combined with --vertices free; drop one of them", lakes));
  if (lakes != nullptr) plan.simplify.quality.vertices = Vertices::kSamples;
  return {};
}

Result<void> plan_shape(const SimplifyArguments& given, SimplifyPlan& plan) {
  SCARP_TRY(plan.simplify.quality.shape, given.shape.parse());
  return {};
}

Result<void> plan_objective(const SimplifyArguments& given, SimplifyPlan& plan) {
  if (plan.simplify.goals.objective == Objective::kMax || find_budget(given) != nullptr) return {};
  return fail(ErrorKind::kUsage,
              "--objective rms needs a budget, -t or -p: a max error alone decides the mesh, whatever its RMSE");
}

Result<void> plan_levels(const SimplifyArguments& given, SimplifyPlan& plan) {
  plan.simplify.domain.border.is_locked = given.levels.locks_border || given.levels.lods;
  if (plan.simplify.domain.border.is_locked && !given.max_error && given.companions.find_tolerance() == nullptr) {
    return fail(ErrorKind::kUsage,
                fmt::format("{} needs --max-error: a budget finds another error for each raster and level",
                            given.levels.lods ? "--lods" : "--lock-border"));
  }
  if (given.levels.lods && (given.base || plan.solid))
    return fail(ErrorKind::kUsage, fmt::format("--lods cannot be combined with {}: levels are surfaces that take each "
                                               "other's place, not solids",
                                               given.base ? "--base" : "--solid"));
  return {};
}

Result<void> plan_conflicts(const SimplifyArguments& given, SimplifyPlan& plan) { return check_conflicts(given, plan); }

/// The option that asks for more than one bound on heights, by which alone a print is judged; null if there is none.
const char* find_print_obstacle(const SimplifyArguments& given) {
  if (given.base) return "--base";
  if (given.normals) return "--normals";
  if (given.uvs) return "--uvs";
  if (given.channels.image) return "--image";
  if (!given.channels.textures.empty()) return "--texture";
  if (const char* strategy = given.strategy.find_strategy()) return strategy;
  return find_bounds(given);
}

Result<void> plan_solid(const SimplifyArguments& given, SimplifyPlan& plan) {
  SCARP_TRY(plan.solid, given.solid.parse(plan.warnings));
  if (plan.error_goal && plan.error_goal->is_on_print) {
    if (!plan.solid || !plan.solid->size)
      return fail(ErrorKind::kUsage, fmt::format("--max-error {} is an error on a print, which needs its size: --solid "
                                                 "size=120mm",
                                                 *given.max_error));
    if (!(plan.error_goal->value > 0))
      return fail(
          ErrorKind::kUsage,
          fmt::format("--max-error {} is not above 0: give 0 without a unit for every sample", *given.max_error));
    plan.solid->max_error = plan.error_goal->value;
  }
  if (!plan.solid) return {};
  if (const char* obstacle = find_print_obstacle(given); obstacle != nullptr)
    return fail(ErrorKind::kUsage, fmt::format("--solid cannot be combined with {}; drop one of them", obstacle));
  return {};
}

/// Checks the needs of solids and of the format.
Result<void> plan_solid_format(const SimplifyArguments& given, SimplifyPlan& plan) {
  const OutputFormat& format = plan.format;
  if (format.holds_solids_only() && !plan.solid && !plan.base)
    return fail(ErrorKind::kUsage,
                fmt::format("{} holds closed solids only: say how to close the terrain, such as --solid size=120mm",
                            format.title()));
  if (!plan.solid) return {};
  if (!format.holds_prints())
    return fail(ErrorKind::kUsage,
                fmt::format("--solid is for printing, and {} has no place for millimetres: choose .stl, .3mf, .obj or "
                            ".ply, or --base for a solid in the raster's units",
                            format.title()));
  if (plan.has_file_per_tile() && is_stdout(given.output))
    return fail(ErrorKind::kUsage, "--split writes several files: standard output is only one");
  return {};
}

Result<void> plan_zones(const SimplifyArguments& given, SimplifyPlan& plan) {
  if (const char* zones = given.zones.find_lines(); zones != nullptr && given.base)
    return fail(ErrorKind::kUsage,
                fmt::format("{} cannot be combined with --base: a flow model has no underside", zones));
  return given.zones.check(plan.format);
}

/// Refuses settings that conflict with images inside the file.
Result<void> plan_images(const SimplifyArguments& given, SimplifyPlan& plan) {
  SCARP_TRY(plan.images, given.images.parse(plan.format));
  if (plan.images.drape && plan.channels.has_channels()) {
    return fail(ErrorKind::kUsage,
                fmt::format("--drape cannot be combined with {}: the colours of both would be multiplied",
                            plan.channels.image ? "--image" : "--texture"));
  }
  if (!plan.images.normal_map) return {};
  const std::pair<const char*, bool> others[] = {
      {"--normals", given.normals}, {"--image", plan.channels.image}, {"--base", given.base.has_value()}};
  const char* reasons[] = {"the image has the normals of all samples", "an image is flat, and its normals say nothing",
                           "a solid's walls have no terrain normal"};
  for (std::size_t k = 0; k < std::size(others); ++k) {
    if (others[k].second) {
      return fail(ErrorKind::kUsage,
                  fmt::format("--normal-map cannot be combined with {}: {}", others[k].first, reasons[k]));
    }
  }
  return {};
}

/// Checks attributes that the format has no place for: refuses if nothing would remain, else warns.
Result<void> plan_attributes(const SimplifyArguments& given, SimplifyPlan& plan) {
  const OutputFormat& format = plan.format;
  const std::string title = format.title();
  plan.simplify.output.normals = given.normals && format.holds_attributes();
  plan.simplify.output.uvs =
      (given.uvs || plan.channels.has_channels() || plan.images.any()) && format.holds_attributes();
  const std::string& crs = plan.read.crs;
  const bool is_centred = crs.empty() || crs == "local" || crs == "grid" || crs == "enu";
  plan.simplify.output.float32_positions = format.is_float32() || (format.is_ply() && is_centred && !given.doubles);
  plan.doubles = given.doubles;
  if (given.doubles && !format.is_ply())
    return fail(ErrorKind::kUsage, fmt::format("--double is for PLY: the positions of {} are what they are", title));
  SCARP_TRY(const bool is_y_up, choose_y_up(given.up, format, plan.solid.has_value()));
  // Who reads earth-centred coordinates expects them as they are.
  plan.is_y_up = is_y_up && (given.up || crs == "enu" || !is_in_space(crs));
  if (given.compress && !format.is_glb()) {
    return fail(ErrorKind::kUsage, fmt::format("--compress writes GLB, and OUTPUT is {}: choose .glb", title));
  }
  plan.compress = plan.simplify.output.lattice = given.compress;
  const bool shows_image =
      format.holds_attributes() || format.kind == OutputKind::kSvg || format.kind == OutputKind::kEps;
  if (given.channels.image && !shows_image) {
    return fail(ErrorKind::kUsage, fmt::format("{} has no place for colours, and an image has no heights: choose .glb, "
                                               ".ply or .obj",
                                               title));
  }
  if (given.base && !format.is_mesh()) {
    return fail(ErrorKind::kUsage,
                fmt::format("--base makes a solid, which {} cannot hold: choose a mesh format", title));
  }
  if (given.normals && given.base) {
    return fail(ErrorKind::kUsage, "--normals cannot be combined with --base: a solid's walls have no terrain normal");
  }
  if (given.normals && given.channels.image) {
    return fail(ErrorKind::kUsage,
                "--normals cannot be combined with --image: an image is flat, and its normals say nothing");
  }
  if (format.kind == OutputKind::kDem && given.raster.crs) {
    plan.warnings.push_back("a raster's approximation lies on the raster's own grid, whatever --crs says");
  }
  if (format.holds_attributes()) return {};
  if (given.normals) {
    plan.warnings.push_back(fmt::format("{} has no place for vertex normals: --normals changes nothing", title));
  }
  if (given.uvs) plan.warnings.push_back(fmt::format("{} has no place for uvs: --uvs changes nothing", title));
  if (!given.channels.textures.empty()) {
    plan.warnings.push_back(fmt::format("{} has no place for colours: the texture shapes the mesh only", title));
  }
  return {};
}

Result<void> plan_outputs(const SimplifyArguments& given, SimplifyPlan& plan) {
  SCARP_TRY(const OutputFormat& format, choose_output_format(given.format, given.output));
  plan.format = format;
  plan.read.default_frame = format.default_frame();
  plan.read.heights_in = plan.channels.image ? HeightsIn::kFile : format.heights_in();
  if (given.base) {
    SCARP_TRY(const double base, parse_number("--base", *given.base));
    constexpr double kFarthest = 1e30;  // differences to heights must fit float32
    if (std::abs(base) > kFarthest) {
      return fail(ErrorKind::kUsage, fmt::format("--base {} is out of the range of float32 heights: choose one between "
                                                 "-1e30 and 1e30",
                                                 *given.base));
    }
    plan.base = base;
  }
  SCARP_RETURN_IF_ERROR(plan_images(given, plan));
  SCARP_RETURN_IF_ERROR(plan_attributes(given, plan));
  SCARP_RETURN_IF_ERROR(plan_solid_format(given, plan));

  SCARP_TRY(plan.levels, given.levels.parse(plan.format, given.output));
  plan.levels_in_one = given.levels.in_one;
  std::vector<PlannedOutput> outputs;
  if (plan.has_file_per_level()) {
    for (int k = 0; k < plan.levels->count; ++k) outputs.push_back({"--lods", level_path(given.output, k)});
  } else if (!plan.has_file_per_tile())
    outputs.push_back({"OUTPUT", given.output});
  for (int k = 0; plan.has_file_per_tile() && k < plan.solid->columns * plan.solid->rows; ++k) {
    const int columns = plan.solid->columns;
    outputs.push_back({"--split", tile_path(given.output, k / columns + 1, k % columns + 1)});
  }
  const std::pair<const char*, const Given*> pictures[] = {{"--preview", &given.preview}, {"--render", &given.render}};
  for (const auto& [option, path] : pictures) {
    if (!*path) continue;
    outputs.push_back({option, **path});
    SCARP_RETURN_IF_ERROR(check_png_name(outputs.back()));
  }
  if (given.error_raster) {
    outputs.push_back({"--error-raster", *given.error_raster});
    SCARP_RETURN_IF_ERROR(check_tiff_name(outputs.back()));
  }
  if (given.html) outputs.push_back({"--html", *given.html});
  if (given.report) outputs.push_back({"--report", *given.report});
  plan.outputs = std::move(outputs);
  return {};
}

Result<void> plan_page(const SimplifyArguments& given, SimplifyPlan& plan) {
  if (!given.html) return {};
  const std::pair<const char*, bool> others[] = {{"--base", given.base.has_value()},
                                                 {"--solid", plan.solid.has_value()},
                                                 {"--image", plan.channels.image},
                                                 {"--memory", given.memory.memory.has_value()}};
  for (const auto& [name, is_given] : others) {
    if (is_given)
      return fail(ErrorKind::kUsage, fmt::format("--html cannot be combined with {}: the page holds all samples of a "
                                                 "terrain of heights",
                                                 name));
  }
  SCARP_TRY(plan.page_template, read_page_template());
  return {};
}

/// Refuses settings of a mesh that conflict with a frame in space, where z is not the height.
Result<void> plan_space(const SimplifyArguments& given, SimplifyPlan& plan) {
  if (!is_in_space(plan.read.crs)) return {};
  const std::string output = plan.format.title() + " as OUTPUT";
  const std::tuple<const char*, bool, const char*> others[] = {
      {output.c_str(), !plan.format.holds_space(), "it holds heights over a map; choose .glb, .obj, .ply or .stl"},
      {"--base", given.base.has_value(), "a base lies below heights over a map"},
      {"--solid", plan.solid.has_value(), "a print stands on a flat base"},
      {"--preview", given.preview.has_value(), "pictures show maps"},
      {"--render", given.render.has_value(), "pictures show maps"},
      {"--normal-map", plan.images.normal_map.has_value(), "its normals are those of a map"}};
  for (const auto& [name, is_given, reason] : others) {
    if (is_given)
      return fail(ErrorKind::kUsage,
                  fmt::format("--crs {} cannot be combined with {}: {}", shell_word(plan.read.crs), name, reason));
  }
  return {};
}

/// The first option that was given and cannot do with a few samples at a time; nothing if there is none.
std::optional<std::string> find_need_of_samples(const SimplifyArguments& given, const SimplifyPlan& plan) {
  if (const auto unstreamed = find_unstreamed(given, plan)) return unstreamed;
  const std::pair<const char*, bool> options[] = {
      {"--nodata-policy", plan.policy != NodataPolicy::kHole},
      {"--render", given.render.has_value()},
      {".pgm as OUTPUT", plan.format.kind == OutputKind::kDem && plan.format.raster == RasterFormat::kPgm},
  };
  for (const auto& [name, is_given] : options) {
    if (is_given) return name;
  }
  return std::nullopt;
}

Result<void> plan_memory(const SimplifyArguments& given, SimplifyPlan& plan) {
  SCARP_TRY(plan.memory, given.memory.parse());
  if (!plan.memory) return {};
  if (plan.channels.image) {
    return fail(ErrorKind::kUsage, "--memory cannot be combined with --image: images are read as a whole");
  }
  if (const char* image = given.images.find_image()) {
    return fail(ErrorKind::kUsage,
                fmt::format("--memory cannot be combined with {}: the image is held as a whole", image));
  }
  plan.simplify.run.memory.limit = *plan.memory;
  plan.simplify.run.memory.per_vertex = plan.format.bytes_per_vertex();
  // A solid's bottom and walls are as many vertices again; a print is judged while its mesh is in memory.
  constexpr std::uint64_t kMeshBytes = 48;
  if (plan.base) plan.simplify.run.memory.per_vertex = 2 * plan.simplify.run.memory.per_vertex + kMeshBytes;
  if (plan.solid) plan.simplify.run.memory.per_vertex += 4 * kMeshBytes;
  plan.needs_samples = find_need_of_samples(given, plan);
  // The proof sees the range of all other rasters, but of this one with its lakes.
  const bool is_flattened = !given.lines.water.empty();
  plan.read.with_range = is_flattened || (plan.error_goal && plan.error_goal->percent_of_relief);
  return {};
}

}  // namespace

Result<SimplifyPlan> plan_simplify(const SimplifyArguments& given, std::vector<std::string> files_read) {
  SimplifyPlan plan;
  plan.files_read = std::move(files_read);
  plan.input = given.raster.path();
  plan.output = given.output;
  plan.preview = given.preview;
  plan.render = given.render;
  plan.error_raster = given.error_raster;
  plan.html = given.html;
  plan.report = given.report;
  plan.overwrite = given.overwrite;
  plan.canonical_command = given.canonical();

  SCARP_TRY(plan.read, given.raster.parse());
  SCARP_TRY(const int threads, parse_threads(given.threads));
  plan.simplify.run.threads = plan.read.run.threads = threads;
  for (const auto step :
       {plan_goals, plan_nodata, plan_channels, plan_strategy, plan_solid, plan_lines, plan_shape, plan_levels,
        plan_objective, plan_conflicts, plan_outputs, plan_page, plan_zones, plan_space, plan_memory}) {
    SCARP_RETURN_IF_ERROR(step(given, plan));
  }
  // Last: who has mistaken an option reads of that first.
  SCARP_RETURN_IF_ERROR(check_outputs(plan.outputs, plan.files_read, given.overwrite));
  return plan;
}

}  // namespace scarp::cli
