#include "session/tasks/simplify_work.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "scarp/height_field.h"
#include "scarp/io.h"
#include "scarp/paper.h"
#include "session/inputs/cutline.h"
#include "session/inputs/heightmap.h"
#include "session/inputs/lines.h"
#include "session/inputs/nodata_warnings.h"
#include "session/inputs/waters.h"
#include "session/inputs/zones.h"
#include "session/options/error_goal.h"
#include "session/plan/conflicts.h"
#include "session/reports/feature_report.h"
#include "session/reports/shape_report.h"
#include "session/reports/verdict.h"
#include "session/tasks/mesh_output.h"
#include "session/tasks/with_level.h"
#include "session/text/clock.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

using enum OptionId;

constexpr const char* kBroken = "the mesh does not keep its promise and was not written; this is a bug in Scarp: ";

/// Bytes of vector files, in addition to the raster's.
std::uint64_t vector_bytes(const SimplifyPlan& plan) {
  const auto file = plan.given.first_of({kBreaklines, kWater, kRivers, kMaterials, kNodeStrings, kCutline, kRoi});
  return file ? kVectorBytes : 0;
}

MemoryNeeds needs_of(const SimplifyPlan& plan) {
  MemoryNeeds needs{vector_bytes(plan)};
  if (gives_bounds(plan.given)) needs.per_sample = kBoundedSampleBytes;
  return needs;
}

Result<void> read_heights(const SimplifyPlan& plan, const ReadOptions& options, Outcome& outcome) {
  const MemoryNeeds needs = needs_of(plan);
  SCARP_TRY(OwnedHeightField field, read_within(plan.input, options, plan.memory, needs));
  if (plan.needs_samples) {
    SCARP_RETURN_IF_ERROR(check_in_memory(field, *plan.needs_samples, needs));
  }
  outcome.field = std::move(field);
  outcome.as_read = outcome.field.info;
  if (plan.policy == NodataPolicy::kFill) outcome.filled = fill_nodata(outcome.field, plan.fill_distance);
  if (plan.policy == NodataPolicy::kBackground) outcome.filled = fill_background(outcome.field, plan.background);
  SCARP_TRY(outcome.channels, read_textures(plan.channels, outcome.field, options.run.progress));
  if (!plan.error_goal) return {};
  ErrorGoal goal = *plan.error_goal;
  SCARP_RETURN_IF_ERROR(settle_goal(kMaxError, outcome.as_read, goal, outcome.as_read.warnings));
  outcome.asked = goal.absolute(outcome.as_read.max - outcome.as_read.min);
  if (!plan.error_goal->is_on_print) return {};
  const Result<double> scale = estimate_print_scale(outcome.field.view(), *plan.solid);
  if (!scale) return fail(scale.error().kind, fmt::format("{}: {}", plan.input, scale.error().message));
  outcome.asked = plan.error_goal->value / *scale;
  return {};
}

Result<void> read_colors(const SimplifyPlan& plan, const ReadOptions& options, bool one_band, Outcome& outcome) {
  SCARP_TRY(Image image, read_image(plan.channels, plan.input, options, one_band));
  outcome.field = std::move(image.field);
  outcome.channels = std::move(image.channels);
  outcome.as_read = outcome.field.info;
  if (plan.error_goal && !plan.error_goal->unit.empty())
    return fail(ErrorKind::kUsage,
                fmt::format("{} with a unit is for heights: errors of {} are in grey levels", kMaxError, kImage));
  if (plan.error_goal) outcome.asked = plan.error_goal->absolute(outcome.channels.relief);
  return {};
}

}  // namespace

MemoryShare memory_of(const SimplifyPlan& plan, const Outcome& outcome) {
  if (!plan.memory) return {};
  const OwnedHeightField& field = outcome.field;
  std::uint64_t taken = bytes_taken(field, *plan.memory) + bytes_of(outcome.features.lakes) + outcome.companions.bytes;
  if (gives_bounds(plan.given) && !field.source)
    taken += (kBoundedSampleBytes - MemoryNeeds().per_sample) * static_cast<std::uint64_t>(field.cols) *
             static_cast<std::uint64_t>(field.rows);
  return {*plan.memory, taken};
}

namespace {

using enum OptionId;

Result<void> read_draped_image(const SimplifyPlan& plan, const ProgressCallback& progress, Outcome& outcome) {
  if (!plan.images.drape) return {};
  Run run;
  run.progress = progress;
  SCARP_TRY(Drape drape, read_drape(*plan.images.drape, outcome.as_read, outcome.field.cols, outcome.field.rows,
                                    plan.images.drape_size, run));
  outcome.drape = std::move(drape.picture);
  for (std::string& warning : drape.warnings) outcome.companions.warnings.push_back(std::move(warning));
  return {};
}

/// Breaklines, lakes, rivers, walls and ridges.
Result<void> read_features(const SimplifyPlan& plan, const ProgressCallback& progress, Outcome& outcome) {
  Features& features = outcome.features;
  std::vector<std::string>& warnings = outcome.companions.warnings;
  Result<LineConstraints> lines = read_breaklines(plan.given, outcome.as_read, outcome.field.rows, progress, warnings);
  if (!lines) return tl::unexpected(std::move(lines.error()));
  features.breaklines = std::move(*lines);
  Result<ZonePlan> zones =
      read_zones(plan.given, outcome.as_read, outcome.field.rows, progress, features.breaklines, warnings);
  if (!zones) return tl::unexpected(std::move(zones.error()));
  outcome.zone_plan = std::move(*zones);
  const auto waters = read_waters(plan.given, progress, memory_of(plan, outcome), outcome.field, features, warnings);
  if (!waters) return waters;
  features.walls = wall_goals(plan.given);
  features.ridges = ridge_goals(plan.given);
  return {};
}

Result<void> read_inputs(const SimplifyPlan& plan, bool one_band, const ProgressCallback& progress, Outcome& outcome) {
  const Clock::time_point start = Clock::now();
  ReadOptions options = plan.read;
  options.run.progress = progress;
  SCARP_RETURN_IF_ERROR(plan.channels.image ? read_colors(plan, options, one_band, outcome)
                                            : read_heights(plan, options, outcome));
  SCARP_TRY(outcome.companions, read_companions(plan.given, outcome.as_read, outcome.field, outcome.asked,
                                                {progress, plan.memory.value_or(0), plan.simplify.run.threads}));
  SCARP_RETURN_IF_ERROR(read_draped_image(plan, progress, outcome));
  if (plan.memory && outcome.companions.inserts_samples()) {
    SCARP_RETURN_IF_ERROR(check_in_memory(outcome.field, name_of(kScript), needs_of(plan)));
  }
  const bool is_dem = plan.format.kind == OutputKind::kDem;
  if (plan.memory && (plan.error_raster || is_dem) && outcome.field.source) {
    const std::uint64_t bytes = outcome.companions.bytes + RasterFile::bytes(outcome.field.cols);
    const std::string culprit = is_dem ? "the approximation as a raster" : name_of(kErrorRaster);
    SCARP_RETURN_IF_ERROR(check_room(outcome.field, *plan.memory, bytes, culprit));
  }
  SCARP_RETURN_IF_ERROR(read_features(plan, progress, outcome));
  SCARP_TRY(outcome.cut, read_cut(plan.given, outcome.as_read, progress, outcome.field, outcome.companions.warnings));
  complete_info(outcome.field.info, outcome.as_read);
  outcome.seconds_read = seconds_since(start);
  return {};
}

/// OBJ cannot hold channels other than colours: an image would lose its bound, and a texture its values.
Result<void> check_place_of_channels(SimplifyPlan& plan, const Channels& channels) {
  const bool is_obj = plan.format.is_mesh() && plan.format.mesh == MeshFormat::kObj;
  if (!is_obj || channels.empty() || channels.are_colors()) return {};
  const std::string sentence = "OBJ has a place for 8-bit colours only";
  if (plan.channels.image) {
    return fail(ErrorKind::kUsage,
                fmt::format("{}, and {} holds {} of {}: choose .glb or .ply", sentence, plan.input,
                            format_plural(channels.count(), "band"), channels.bands.info.sample_type));
  }
  plan.warnings.push_back(sentence + ": the values of the texture's bands are not in the file");
  return {};
}

/// Records the time of a judgement that follows simplify()'s own proof.
void add_judging(Clock::time_point start, Outcome& outcome) {
  const double seconds = seconds_since(start);
  outcome.simplified.passes.push_back({"judge", seconds});
  outcome.simplified.seconds_measure += seconds;
}

/// simplify() reports the largest errors of all samples. If some are ignored, this finds the largest errors of the
/// others.
Result<void> judge_bounded(const SimplifyPlan& plan, const ProgressCallback& progress, Outcome& outcome) {
  const Clock::time_point start = Clock::now();
  const Companions& companions = outcome.companions;
  const bool has_norms = !outcome.channels.empty() && (companions.ignores_samples() || plan.channels.image);
  judge::JudgeOptions options;
  options.tolerances = companions.bounds();
  options.max_error = outcome.asked;
  options.norm = plan.channels.norm;
  options.cutline = outcome.cut.judged();
  options.topology = false;
  options.weigh = has_norms || companions.ignores_samples();
  options.run.threads = plan.simplify.run.threads;
  options.run.progress = progress;
  SCARP_TRY(const judge::Judgement& judged,
            judge::judge_mesh(has_norms ? outcome.view() : outcome.field.view(), outcome.simplified.mesh, options));
  outcome.bounded = plan.channels.image ? judged.combined->bounded : judged.bounded;
  if (companions.ignores_samples()) {
    outcome.bounded_goal = judged.weighted   ? judged.weighted->bounded.value
                           : judged.combined ? judged.combined->bounded.value
                                             : judged.bounded.value;
  }
  add_judging(start, outcome);
  return {};
}

/// The engine proves its own result; a mesh whose proof fails is never written.
Result<void> check_promise(const Outcome& outcome) {
  const Simplified& simplified = outcome.simplified;
  const Measurement& measured = simplified.measurement;
  const GoalError goal = find_goal_error(outcome);
  const bool has_tolerance = outcome.companions.has_tolerance();
  const bool has_budget_ended =
      simplified.stop == StopReason::kMaxTriangles || simplified.stop == StopReason::kMaxVertices;
  const std::optional<double> asked = has_tolerance ? simplified.tolerance_factor : outcome.asked;
  if (asked && (!has_budget_ended || has_tolerance)) {
    const double height_scale = outcome.channels.empty() ? 1 : outcome.channels.height_scale;
    // With weights, the engine subtracted the samples' rounding from each bound before weighing errors.
    const double rounding = outcome.companions.has_weights() ? 0 : outcome.field.sample_rounding * height_scale;
    const double allowance =
        judge::judging_allowance(*asked, measured.heights) + 1e-12 * outcome.channels.magnitude +
        (goal.is_rounded ? std::ldexp(*asked, -24) * static_cast<double>(4 + outcome.channels.count()) : 0);
    if (!(goal.value + rounding <= *asked + allowance)) {
      return fail(ErrorKind::kPromise,
                  fmt::format("{}{} {:.10g} exceeds {:.10g}", kBroken, goal.name, goal.value + rounding, *asked));
    }
  }
  if (measured.uncovered == 0) return {};
  return fail(ErrorKind::kPromise, kBroken + format_plural(measured.uncovered, "sample") + " without a triangle");
}

/// simplify() does not check a topology that is valid by construction, but a report contains only checked facts. A
/// print is judged as a whole: its proof covered the terrain.
Result<void> judge_topology(const ProgressCallback& progress, const SimplifyPlan& plan, Outcome& outcome) {
  MeasureOptions options;
  options.cutline = outcome.cut.judged();
  options.run.threads = plan.simplify.run.threads;
  options.run.progress = progress;
  const Clock::time_point start = Clock::now();
  Simplified& simplified = outcome.simplified;
  if (plan.solid) {
    SCARP_TRY(simplified.measurement, measure(outcome.field, simplified.mesh, options));
  } else {
    SCARP_RETURN_IF_ERROR(measure_topology(outcome.field, simplified.mesh, options, simplified.measurement));
  }
  add_judging(start, outcome);
  return {};
}

/// True for slow efforts, which at any time have a mesh that satisfies the bound.
bool keeps_mesh_on_interrupt(const SimplifyOptions& options) {
  const bool is_long = options.quality.effort == Effort::kHigh || options.quality.effort == Effort::kMax;
  return is_long && !options.goals.max_triangles && !options.goals.max_vertices && options.run.memory.limit == 0;
}

/// Simplifies all levels. Returns the finest; the others are in the outcome.
Result<Simplified> simplify_as_levels(const SimplifyPlan& plan, const SimplifyOptions& options, Outcome& outcome) {
  Result<std::vector<Simplified>> levels = simplify_levels(outcome.view(), options, *plan.levels);
  if (!levels) return tl::unexpected(std::move(levels.error()));
  for (std::size_t k = 1; k < levels->size(); ++k) {
    const double times = std::pow(plan.levels->ratio, static_cast<double>(k));
    outcome.coarser.push_back({times * options.goals.max_error.value_or(0), std::move((*levels)[k])});
  }
  return std::move(levels->front());
}

/// simplify_for_print(), whose errors name options.
Result<PrintedTerrain> simplify_as_print(const PrintOptions& plan, OwnedHeightField& field,
                                         const SimplifyOptions& options) {
  if (plan.is_split() && !field.frame.is_affine()) {
    return fail(
        ErrorKind::kUsage,
        fmt::format(
            "{} cuts along rows and columns of the raster, which {} bends here: omit it, or choose local or source",
            kSplit, kCrs));
  }
  Result<PrintedTerrain> printed = simplify_for_print(field, plan, options);
  if (printed) return printed;
  return tl::unexpected(name_print(std::move(printed.error())));
}

/// A print is made together with its mesh.
Result<Simplified> simplify_as_planned(const SimplifyPlan& plan, const SimplifyOptions& options, Outcome& outcome) {
  if (plan.by_paper) {
    return simplify_by_paper(outcome.view(), {options.goals, options.tolerances, options.features.points,
                                              options.domain, options.output, plan.strategy, options.run});
  }
  if (plan.levels) return simplify_as_levels(plan, options, outcome);
  if (!plan.solid) return simplify(outcome.view(), options);
  SCARP_TRY(PrintedTerrain printed, simplify_as_print(*plan.solid, outcome.field, options));
  take_print(plan, std::move(printed.print), outcome);
  return std::move(printed.simplified);
}

/// Rewrites the library's error about an outline tolerance in terms of the option.
Error name_outline(Error error) {
  constexpr std::string_view kTolerance = "an outline tolerance";
  if (const std::size_t at = error.message.find(kTolerance); at != std::string::npos)
    error.message.replace(at, kTolerance.size(), name_of(kOutlineTolerance));
  return error;
}

}  // namespace

Result<void> make_mesh(const GivenOptions& given, SimplifyPlan& plan, const Runner& runner, Outcome& outcome) {
  const Result<void> has_inputs = read_inputs(plan, given[kBand].has_value(), runner.progress, outcome);
  if (!has_inputs) return tl::unexpected(name_memory(given, outcome.field, explain_reading(given, has_inputs.error())));

  SCARP_RETURN_IF_ERROR(check_place_of_channels(plan, outcome.channels));
  const Frame& frame = outcome.field.frame;
  if (plan.read.heights_in == HeightsIn::kMetres) {
    SCARP_RETURN_IF_ERROR(check_unit_of_frame(plan.format, frame.unit_in_metres));
  }
  SCARP_RETURN_IF_ERROR(check_crs_of(plan.format, frame.crs, outcome.as_read.unit));
  SCARP_TRY(outcome.projections, plan_projection_files(plan, frame.crs));
  if (plan.format.has_lengths_only() && frame.kind == Frame::Kind::kLocal && outcome.as_read.is_geographic &&
      plan.read.crs.empty()) {
    plan.warnings.push_back(
        fmt::format("{} has no degrees: the surface is in metres around the raster's centre; a projected CRS (--crs) "
                    "puts it in its place",
                    plan.format.title()));
  }
  SCARP_RETURN_IF_ERROR(check_frame_of_lines(find_lines(plan.given) ? name_of(*find_lines(plan.given)) : "", frame,
                                             plan.read.crs, plan.input));
  SimplifyOptions options = plan.simplify;
  // Nodata is filled differently on both sides of a shared edge.
  if (options.output.normals && options.domain.border.is_locked && plan.policy == NodataPolicy::kHole) {
    const OwnedHeightField& field = outcome.field;
    SCARP_TRY(options.domain.border.beyond,
              read_beyond(plan.input, plan.read, outcome.as_read, field.cols, field.rows));
  }
  options.goals.max_error = outcome.asked;
  options.tolerances = outcome.companions.bounds();
  options.features = outcome.features;
  options.features.points = outcome.companions.script.inserted;
  options.features.cutline = outcome.cut.cutline;
  options.run.progress = runner.progress;
  if (keeps_mesh_on_interrupt(options)) {
    options.run.is_enough = runner.is_enough;
    if (runner.on_keeping) runner.on_keeping();
  }
  if (plan.memory) options.run.memory.taken = memory_of(plan, outcome).taken + outcome.cut.bytes;
  SCARP_RETURN_IF_ERROR(check_conflicts(given, outcome.view(), options));
  Result<Simplified> simplified = simplify_as_planned(plan, options, outcome);
  if (!simplified) {
    Error error = name_outline(name_memory(given, outcome.field, std::move(simplified.error())));
    if (plan.error_goal)
      error = name_goal(*plan.error_goal, outcome.as_read.max - outcome.as_read.min, std::move(error));
    if (error.kind == ErrorKind::kInput && !error.message.starts_with(plan.input) && !error.message.starts_with("--"))
      error.message = fmt::format("{}: {}", plan.input, error.message);
    return tl::unexpected(std::move(error));
  }
  outcome.simplified = std::move(*simplified);
  const FittedFeatures& fitted = outcome.simplified.features;
  warn_of_dry_lines(outcome.features, fitted.rivers, outcome.companions.warnings);
  apply_edits(outcome.simplified.edits, outcome.field);
  complete_info(outcome.simplified.measurement.heights, outcome.as_read);
  const OwnedHeightField& field = outcome.field;
  const bool by_construction = options.output.float32_positions ? offsets_are_exact(field.frame, field.cols, field.rows)
                                                                : field.frame.is_affine();
  if (plan.report && by_construction) {
    SCARP_RETURN_IF_ERROR(judge_topology(runner.progress, plan, outcome));
  }
  if (outcome.simplified.ignored > 0) {
    SCARP_RETURN_IF_ERROR(judge_bounded(plan, runner.progress, outcome));
  }
  Result<void> promise = check_promise(outcome);
  for (Level& level : outcome.coarser) {
    if (promise) promise = with_level(outcome, level, [&] { return check_promise(outcome); });
  }
  SCARP_RETURN_IF_ERROR(promise);
  outcome.warnings = plan.warnings;
  const auto needle = plan.channels.image ? std::nullopt : find_needle(field, outcome.as_read);
  if (needle) outcome.warnings.push_back(*needle);
  std::vector<const std::vector<std::string>*> sources{&outcome.as_read.warnings, &outcome.companions.warnings};
  if (!plan.channels.image) sources.push_back(&outcome.channels.bands.info.warnings);
  for (const std::vector<std::string>* more : sources) {
    outcome.warnings.insert(outcome.warnings.end(), more->begin(), more->end());
  }
  if (options.quality.order == Order::kDominant && outcome.simplified.order != Order::kDominant) {
    outcome.warnings.push_back(
        "the greedy order was taken: the goal is so coarse that tiles would cost vertices, some samples have no bound, "
        "or "
        "the heights span magnitudes beyond exact arithmetic");
  }
  if (!plan.channels.image) {
    for (std::string& sentence : warn_of_undeclared_nodata(outcome.as_read, outcome.field))
      outcome.warnings.push_back(std::move(sentence));
  }
  warn_of_far_lines(outcome.simplified, outcome.asked.value_or(outcome.simplified.lines_for), outcome.warnings);
  warn_of_missing_walls(given, fitted.walls, outcome.warnings);
  warn_of_missing_ridges(given, fitted.ridges, outcome.warnings);
  warn_of_shapes(options.quality.shape, outcome.simplified, outcome.warnings);
  if (fitted.given_lines() > 0 && outcome.simplified.lines_inserted == 0) {
    outcome.warnings.push_back(
        fmt::format("{}: no line lies on the raster's surface, so they change nothing: is their CRS the right one?",
                    name_of(*find_lines(plan.given))));
  }
  if (outcome.companions.has_tolerance() && std::isinf(outcome.simplified.tolerance_factor)) {
    outcome.warnings.push_back(
        "the budget has no room for all samples of tolerance 0: the mesh breaks some, and no factor of the tolerances "
        "is kept; allow more");
  }
  if (const std::string faults = list_faults(outcome.simplified.measurement); !faults.empty()) {
    outcome.warnings.push_back("the mesh keeps its error bound but is not sound: " + faults);
  }
  return {};
}

}  // namespace scarp::cli
