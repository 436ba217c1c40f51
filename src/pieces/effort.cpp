#include "pieces/effort.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "lines/breaklines.h"
#include "scarp/lines.h"
#include "shape/shape_refinement.h"

namespace scarp {

namespace {

bool has_tolerances(const SimplifyOptions& options) {
  return !options.tolerance.empty() || options.tolerance_source != nullptr;
}

/// Whether there are per-sample tolerances.
bool has_bounds(const SimplifyOptions& options) {
  return !options.mask.empty() || has_tolerances(options) || !options.script.empty();
}

bool inserts(const ScriptStep& step) { return step.action == ScriptStep::Action::kInsert; }

static_assert(kMostFitFields > kMaxChannels);

/// The option that needs more than heights; null if there is none.
const char* find_beyond_heights(const HeightField& field, const SimplifyOptions& options) {
  if (has_norm(field)) return "has no channels";
  return options.outline_tolerance > 0 ? "keeps the exact outline" : nullptr;
}

/// The option that needs more than heights and one error; null if there is none.
const char* find_beyond_one_error(const HeightField& field, const SimplifyOptions& options) {
  if (!options.mask.empty() || !options.tolerance.empty()) return "has no mask and no tolerances";
  if (!options.script.empty()) return "has no script";
  return find_beyond_heights(field, options);
}

/// The option that changes the strategy of insertion; null if there is none.
const char* find_strategy(const SimplifyOptions& options) {
  if (options.edges.data_dependent) return "has Delaunay edges only";
  if (options.importance != Importance{}) return "ranks by the error alone";
  if (options.algorithm != Algorithm::kHeap || options.batch != Batch{}) return "has no other algorithm and no batches";
  return nullptr;
}

/// The obstacle to removing vertices; null if there is none.
const char* find_fit_obstacle(const SimplifyOptions& options) {
  if (std::any_of(options.script.begin(), options.script.end(), inserts))
    return "takes vertices away, also those that a script inserts";
  if (has_bounds(options) && has_budget(options)) return "has no budget where samples have bounds of their own";
  if (!options.max_error && !has_tolerances(options) && !has_budget(options)) return "needs a max error or a budget";
  if (options.edges.data_dependent) return "chooses edges itself";
  return nullptr;
}

bool moves_vertices(Effort effort) { return effort == Effort::kHigh || effort == Effort::kMax; }

/// The option that cannot be combined with fast effort; null if there is none.
const char* find_need_of_effort(const SimplifyOptions& options) {
  if (options.objective == Objective::kRms) return "the rms objective";
  if (options.min_shape) return "a floor of shapes";
  return options.is_time_up ? "a time limit" : nullptr;
}

using Question = std::function<bool()>;

Question either(const Question& first, const Question& second) {
  if (!first || !second) return first ? first : second;
  return [first, second] { return first() || second(); };
}

/// The obstacle to vertices between samples, besides the bound; null if there is none.
const char* find_lattice_obstacle(const HeightField& field, const SimplifyOptions& options) {
  if (const char* obstacle = find_beyond_heights(field, options)) return obstacle;
  if (!field.frame.is_affine()) return "needs a frame in which the grid is regular";
  return find_strategy(options) != nullptr ? "has no strategies of insertion" : nullptr;
}

/// Whether constraints can be inserted.
Result<void> check_lines(const HeightField& field, const SimplifyOptions& options) {
  const char* obstacle = has_lines(options) ? find_lattice_obstacle(field, options) : nullptr;
  if (has_lines(options) && obstacle == nullptr && !has_budget(options) && !options.max_error)
    obstacle = "needs a max error or a budget";
  if (has_lines(options) && obstacle == nullptr && has_budget(options) && has_bounds(options))
    obstacle = "has no budget where samples have bounds of their own";
  const bool is_cut = !options.cutline.rings.empty();
  const bool is_of_faults = obstacle == nullptr && has_faults(options) && options.shape.any();
  if (is_of_faults) obstacle = "has no goals for angles and edges";
  if (obstacle == nullptr) return {};
  const auto& lines = options.breaklines.lines;
  const auto all = [&](bool (*kind)(const Line&)) {
    return !lines.empty() && std::all_of(lines.begin(), lines.end(), kind);
  };
  const char* what = is_of_faults || all(is_fault) ? "cliffs"
                     : is_cut                      ? "a cutline"
                     : all(is_ridge_line)          ? "ridges"
                                                   : "breaklines";
  return fail(ErrorKind::kUsage, fmt::format("a mesh with {} {}: leave out one or the other", what, obstacle));
}

/// Whether goals of shapes are possible.
Result<void> check_shape(const HeightField& field, const SimplifyOptions& options) {
  const ShapeGoals& shape = options.shape;
  constexpr double kLargestAngle = 33, kLeastEdge = 0.125;
  const auto usage = [](std::string message) { return fail(ErrorKind::kUsage, std::move(message)); };
  if (!(shape.min_angle >= 0 && shape.min_angle <= kLargestAngle))
    return usage(fmt::format("the minimum angle must lie in 0 … {} degrees, not {}", kLargestAngle, shape.min_angle));
  if (shape.grade && !(*shape.grade > 0 && std::isfinite(*shape.grade)))
    return usage(fmt::format("the grade must be a finite number above 0, not {}", *shape.grade));
  if (!shape.any()) return {};
  const char* obstacle = find_lattice_obstacle(field, options);
  if (obstacle == nullptr && (has_budget(options) || !options.max_error)) obstacle = "needs a max error and no budget";
  if (obstacle != nullptr)
    return usage(fmt::format("a mesh with goals for angles and edges {}: leave out one or the other", obstacle));
  if (std::max(field.cols, field.rows) > kMaxCoordinate / kLatticeSteps)
    return usage(
        fmt::format("a raster of {} x {} samples is too large for goals of angles and edges: at most {} a side",
                    field.cols, field.rows, kMaxCoordinate / kLatticeSteps));
  const auto& a = field.frame.affine;
  const double side = std::max(std::hypot(a[1], a[4]), std::hypot(a[2], a[5]));
  if (shape.max_edge && !(*shape.max_edge >= kLeastEdge * side))
    return usage(fmt::format("the max edge must be at least {} of a sample, that is {}, not {}", kLeastEdge,
                             kLeastEdge * side, *shape.max_edge));
  return {};
}

}  // namespace

bool has_lines(const SimplifyOptions& options) {
  return !options.breaklines.lines.empty() || options.breaklines_for || !options.cutline.rings.empty();
}

bool has_faults(const SimplifyOptions& options) {
  return std::any_of(options.breaklines.lines.begin(), options.breaklines.lines.end(), is_fault);
}

bool lays_first(const SimplifyOptions& options) {
  return std::any_of(options.breaklines.lines.begin(), options.breaklines.lines.end(), is_laid_first);
}

bool has_budget(const SimplifyOptions& options) { return options.max_triangles || options.max_vertices; }

const char* find_obstacle(const HeightField& field, const SimplifyOptions& options) {
  if (!options.max_error && options.tolerance_source == nullptr) return "needs a max error";
  if (has_budget(options)) return "has no budgets";
  if (lays_first(options) && field.samples != nullptr) return "lays no lines of cliffs and ridges";
  if (const char* obstacle = find_beyond_one_error(field, options)) return obstacle;
  return find_strategy(options);
}

Effort choose_effort(const SimplifyOptions& options) {
  if (options.effort != Effort::kAuto) return options.effort;
  // Users choose strategies to see their effect, so removal is not combined with them, nor with per-sample tolerances:
  // there insertion spends vertices where tolerances are small.
  const bool is_default = options.order != Order::kGreedy && options.memory_limit == 0 && options.best_of_budget &&
                          !has_bounds(options) && find_strategy(options) == nullptr &&
                          find_fit_obstacle(options) == nullptr;
  return is_default ? Effort::kNormal : Effort::kFast;
}

Result<void> check_effort(const HeightField& field, const SimplifyOptions& options) {
  const auto usage = [](std::string message) { return fail(ErrorKind::kUsage, std::move(message)); };
  if (options.min_shape && !(*options.min_shape >= 0 && *options.min_shape <= 0.5))
    return usage(fmt::format("the floor of shapes must lie in 0 … 0.5, not {}", *options.min_shape));
  if (options.objective == Objective::kRms && !has_budget(options))
    return usage("the rms objective needs a budget of triangles or vertices: a max error alone decides the mesh");
  if (options.is_time_up && has_budget(options))
    return usage("a time limit and a budget contradict each other: whether a mesh fits is known when it is finished");
  if (options.effort == Effort::kFast) {
    if (const char* need = find_need_of_effort(options))
      return usage(fmt::format("{} needs normal effort or more: fast effort is refinement alone", need));
  } else if (const char* obstacle = find_fit_obstacle(options)) {
    return usage(fmt::format("more than fast effort {}: leave that out, or take fast effort", obstacle));
  }
  if (options.tolerance_source != nullptr && has_budget(options))
    return usage("a budget beside tolerances needs the raster in memory as a whole: leave out one or the other");
  if (auto sound = check_lines(field, options); !sound) return sound;
  if (auto sound = check_shape(field, options); !sound) return sound;
  if (options.vertices != Vertices::kFree || vertices_are_free(field, options)) return {};
  return usage(fmt::format("free vertices need {}: leave them on samples",
                           !moves_vertices(options.effort) ? "high effort or more"
                           : has_norm(field)               ? "heights alone, without channels"
                                                           : "a frame in which the grid is regular"));
}

bool vertices_are_free(const HeightField& field, const SimplifyOptions& options) {
  return moves_vertices(options.effort) && options.vertices != Vertices::kSamples && field.frame.is_affine() &&
         !has_norm(field);
}

bool removes_last(const HeightField& field, const SimplifyOptions& options) {
  return options.shape.any() && shape_rule(options.shape, field.frame);
}

bool places_are_exact(const HeightField& field, const SimplifyOptions& options, std::int32_t steps) {
  return field.frame.is_affine() &&
         (!options.float32_positions || offsets_are_exact(field.frame, field.cols, field.rows, steps));
}

std::int32_t place_steps(const HeightField& field, const SimplifyOptions& options) {
  if (has_lines(options) || options.shape.any()) return kLatticeSteps;
  return vertices_are_free(field, options) ? kLatticeSteps / kFreeStep : 1;
}

double aim_of(const HeightField& field, const SimplifyOptions& options) {
  constexpr double kRoundingShare = 0x1p-9;
  const std::int32_t steps = place_steps(field, options);
  return steps > 1 && !places_are_exact(field, options, steps) ? 1 - kRoundingShare : 1;
}

bool has_norm(const HeightField& field) { return !field.channels.empty() || field.height_scale != 1; }

std::optional<FitNorm> fit_norm(const SimplifyOptions& options, const Raster& raster, const Criterion& criterion) {
  const std::vector<JudgedField> fields = criterion.judged_fields();
  if (fields.size() == 1 && fields[0].samples == raster.samples && fields[0].scale == 1) return std::nullopt;
  FitNorm norm;
  for (const JudgedField& field : fields) norm.fields.push_back({field.samples, field.scale});
  norm.norm = options.norm;
  norm.find_breach = [&judge = criterion.judge()](const std::array<Point, 3>& corners) {
    const auto candidate = judge.find_candidate(corners, judge.fit(corners, {}));
    return candidate ? std::optional(candidate->at) : std::nullopt;
  };
  return norm;
}

FitOptions fit_options(const HeightField& field, const SimplifyOptions& options, double threshold) {
  // On samples a floor would cost up to a tenth more, and could leave more triangles than normal effort does.
  constexpr double kUsualShape = 0.1;
  const auto& a = field.frame.affine;
  FitOptions fit;
  fit.threshold = threshold;
  if (!field.frame.is_affine()) fit.free_sides = {false, false, false, false};
  fit.vertices_are_free = vertices_are_free(field, options);
  if (options.effort == Effort::kHigh) fit.depth = kHighDepth;
  if (options.effort == Effort::kMax) fit.depth = kMaxDepth;
  fit.min_shape = options.min_shape.value_or(fit.vertices_are_free ? kUsualShape : 0);
  fit.aspect = std::hypot(a[2], a[5]) / std::hypot(a[1], a[4]);
  if (options.shape.any()) fit.shape = shape_rule(options.shape, field.frame);
  if (!has_budget(options)) fit.is_time_up = either(options.is_time_up, options.is_enough);
  fit.goes_on = options.effort == Effort::kMax && options.is_time_up;
  return fit;
}

}  // namespace scarp
