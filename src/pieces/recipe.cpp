#include "pieces/recipe.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "grid/vertex_lattice.h"
#include "metric/criterion.h"
#include "metric/source_bounds.h"
#include "pieces/conflicts.h"
#include "shape/shape_refinement.h"

namespace scarp::pieces {

namespace {

/// The requested effort, or the choice for Effort::kAuto.
Effort choose_effort(const HeightField& field, const SimplifyOptions& options) {
  if (options.quality.effort != Effort::kAuto) return options.quality.effort;
  const Fields set = fields_of(field, options);
  if (set.has_any(Fields(Field::kMinShape, Field::kTimeLimit, Field::kObjectiveRms, Field::kVerticesFree)))
    return Effort::kNormal;
  return set.has(Field::kOrderGreedy) ? Effort::kFast : Effort::kNormal;
}

/// The default for few samples is one thread: they are finished before another thread starts.
int choose_threads(const HeightField& field, int asked, Effort effort) {
  constexpr std::int64_t kFewSamples = 1 << 14;
  const bool is_small = std::int64_t{field.cols} * field.rows <= kFewSamples;
  return asked == 0 && !traits_of(effort).moves_vertices && is_small ? 1 : asked;
}

bool may_be_dominant(const HeightField& field, const SimplifyOptions& options, bool has_own_bounds) {
  const bool has_goal = options.goals.max_error || metric::has_tolerances(options);
  if (!has_goal || metric::has_budget(options) || options.quality.order == Order::kGreedy) return false;
  // If bounds differ, inserting the worst sample of the whole raster first needs fewer triangles.
  if (options.quality.order == Order::kAuto && has_own_bounds) return false;
  // A raster with a locked border is refined as one tile, which may begin with points.
  const auto of_order = [&](const Conflict& conflict) {
    return conflict.one == Field::kOrderDominant &&
           !(conflict.other == Field::kPoints && options.domain.border.is_locked);
  };
  const auto conflicts = find_conflicts(fields_of(field, options) | Fields(Field::kOrderDominant));
  return std::none_of(conflicts.begin(), conflicts.end(), of_order);
}

/// There is no search for a small squared error with shape goals, nor with a locked border, which has a separate error.
/// There is none for streamed samples with lines, tolerances or curved frames either, because refinement of a fine
/// start would read them triangle by triangle.
Search choose_search(const Recipe& recipe) {
  const SimplifyOptions& options = recipe.options;
  if (!recipe.has_budget || (!recipe.fits && recipe.insertion_stops)) return Search::kNone;
  const bool needs_strips = recipe.has_lines || recipe.has_source_bounds || !recipe.field.frame.is_affine();
  const bool lowers_squares = options.goals.objective == Objective::kRms && recipe.fits &&
                              !(recipe.is_streamed && needs_strips) && !options.quality.shape.any() &&
                              !options.domain.border.is_locked;
  return lowers_squares ? Search::kSquares : Search::kError;
}

bool rows_run_along_x(const Frame& frame) { return frame.is_affine() && frame.affine[2] == 0 && frame.affine[4] == 0; }

/// Share of the max error for the rounding of heights.
constexpr double kHeightShare = 0x1p-8;

double choose_height_step(const HeightField& field, const SimplifyOptions& options) {
  const Tolerances& own = options.tolerances;
  const bool has_own =
      !own.values.empty() || own.source != nullptr || !own.weights.empty() || own.weights_source != nullptr;
  if (!options.output.lattice || !rows_run_along_x(field.frame) || has_own || has_norm(field)) return 0;
  // Meshes with a common border share the border's bound, but may have different bounds inside. Examples are levels,
  // and neighbours with other errors.
  const Border& border = options.domain.border;
  const double asked = options.goals.max_error.value_or(0);
  const double shared = border.is_locked ? border.max_error.value_or(asked) : asked;
  const double bound = std::min(asked, shared) - field.sample_rounding;
  if (!(bound > 0) || std::isinf(bound)) return 0;
  return std::ldexp(1.0, std::ilogb(2 * kHeightShare * bound));
}

/// The judge moves a position to the lattice if rounding explains the distance, up to this share of a cell. Coordinates
/// cannot represent the positions of relatively tiny cells.
bool doubles_hold_lattice(const HeightField& field, std::int32_t steps) {
  const auto& a = field.frame.affine;
  const double near = steps > 1 ? 0x1p-16 : 0x1p-8;
  const double cell = std::min(std::hypot(a[1], a[4]), std::hypot(a[2], a[5]));
  const double x = std::max({std::abs(a[0]), std::abs(a[1]) * field.cols, std::abs(a[2]) * field.rows});
  const double y = std::max({std::abs(a[3]), std::abs(a[4]) * field.cols, std::abs(a[5]) * field.rows});
  return 0x1p-50 * std::max(x, y) <= near * cell;
}

/// True if the mesh represents all lattice points exactly, with `steps` steps between two samples.
bool lattice_is_exact(const HeightField& field, bool rounds_offsets, std::int32_t steps) {
  if (!field.frame.is_affine()) return false;
  return rounds_offsets ? offsets_are_exact(field.frame, field.cols, field.rows, steps)
                        : doubles_hold_lattice(field, steps);
}

/// True if samples are multiples of a power of two; false if unknown.
bool samples_are_multiples(const HeightField& field, double step) {
  if (field.samples == nullptr) return false;
  const auto count = static_cast<std::size_t>(field.cols) * static_cast<std::size_t>(field.rows);
  return std::all_of(field.samples, field.samples + count, [step](float z) {
    const double multiple = z / step;
    return !std::isfinite(z) || multiple == std::floor(multiple);
  });
}

double choose_aim(const Recipe& recipe) {
  constexpr double kRoundingShare = 0x1p-9;
  const double step = recipe.height_step;
  const bool is_between = recipe.lattice_steps > 1;
  if (step > 0 && (is_between || !samples_are_multiples(recipe.field, step))) return 1 - kHeightShare;
  return is_between && !recipe.is_exact ? 1 - kRoundingShare : 1;
}

MemoryBudget memory_budget(const Recipe& recipe) {
  constexpr std::uint64_t kMesh = 48, kProof = 145;
  const SimplifyOptions& options = recipe.options;
  const bool has_shapes = options.quality.shape.any();
  const bool is_fitted_whole = recipe.fits && (!recipe.is_streamed || has_shapes);
  const std::uint64_t fit = is_fitted_whole ? fit::kFitBytesPerVertex + fit::kFitBytesPerVertexAndThread : 0;
  const std::uint64_t shape = has_shapes ? shape::kShapeBytesPerVertex : 0;
  const std::uint64_t normals = options.output.normals ? 3 * sizeof(float) : 0;
  return {options.run.memory.limit, options.run.memory.taken,
          std::max({kProof + normals, kMesh + normals + options.run.memory.per_vertex, fit, shape})};
}

using Question = std::function<bool()>;

Question either(const Question& first, const Question& second) {
  if (!first || !second) return first ? first : second;
  return [first, second] { return first() || second(); };
}

/// A short edge is worth any number of trials.
constexpr double kAnyPatience = 100;

fit::FitOptions fit_options(const Recipe& recipe) {
  const SimplifyOptions& options = recipe.options;
  const Frame& frame = recipe.field.frame;
  const auto& a = frame.affine;
  fit::FitOptions fit;
  if (frame.transform || options.domain.border.is_locked) fit.free_sides = {false, false, false, false};
  fit.vertices_are_free = recipe.frees_vertices;
  fit.depth = recipe.traits.depth;
  // If two vertices are too close, both are usually needed, but one vertex between them may suffice.
  if (options.quality.shape.min_edge && recipe.traits.moves_vertices) {
    fit.depth.repair = fit::kMaxDepth.repair;
    fit.depth.repair.patience = kAnyPatience;
    fit.depth.repair.worth = 0;
  }
  fit.min_shape = options.quality.min_shape.value_or(usual_shape(recipe.traits, recipe.frees_vertices));
  fit.floor_yields = !options.quality.min_shape;
  fit.aspect = std::hypot(a[2], a[5]) / std::hypot(a[1], a[4]);
  if (options.quality.shape.any()) {
    fit.shape = shape::shape_rule(options.quality.shape, frame);
    fit.floor_yields = false;
  }
  if (!recipe.has_budget) fit.is_time_up = either(options.run.is_time_up, options.run.is_enough);
  fit.goes_on = recipe.traits.goes_on && options.run.is_time_up;
  return fit;
}

}  // namespace

metric::Request settle_request(const HeightField& field, const SimplifyOptions& asked) {
  metric::Request request = asked;
  request.chose_effort = asked.quality.effort == Effort::kAuto;
  request.quality.effort = choose_effort(field, asked);
  if (has_norm(field)) request.quality.vertices = Vertices::kSamples;
  request.run.threads = choose_threads(field, asked.run.threads, request.quality.effort);
  Border& border = request.domain.border;
  if (!border.max_error) border.max_error = asked.goals.max_error;
  return request;
}

Recipe::Recipe(const HeightField& given, const metric::Request& asked, const Scale& by)
    : field(given),
      options(asked),
      scale(by),
      effort(by.refines_only ? Effort::kFast : asked.quality.effort),
      traits(traits_of(effort)),
      is_streamed(given.samples == nullptr),
      has_budget(metric::has_budget(asked)),
      has_lines(metric::has_lines(asked)),
      has_source_bounds(metric::has_source_bounds(asked, is_streamed)),
      has_own_bounds(metric::has_own_bounds(asked, is_streamed)),
      is_dominant(may_be_dominant(given, asked, has_own_bounds)),
      route(asked.domain.border.is_locked ? Route::kLocked
            : is_dominant                 ? Route::kTiles
                                          : Route::kGreedy),
      insertion_stops(!is_streamed && asked.quality.order != Order::kDominant && !asked.quality.shape.any() &&
                      !has_lines),
      fits(traits.fits),
      search(choose_search(*this)),
      frees_vertices(may_free(traits, asked.quality.vertices) && given.frame.is_affine() && !has_norm(given)),
      releases_starts((traits.fits && !traits.moves_vertices) || frees_vertices),
      // With shape goals, redundant vertices of tile borders must be removed from strips at every effort.
      fits_pieces((fits && !by.squares) || asked.quality.shape.any()),
      raises_bound(fits && by.room && by.start < 1 && !by.squares),
      removes_last(asked.quality.shape.any() && shape::shape_rule(asked.quality.shape, given.frame)),
      fits_strips(is_streamed && fits_pieces),
      finishes_strips(fits_strips || (is_streamed && (has_lines || has_source_bounds))),
      reads_beyond(asked.output.normals || !given.frame.is_affine() || fits || has_lines || has_own_bounds),
      rounds_offsets(asked.output.float32_positions && !(asked.output.lattice && rows_run_along_x(given.frame))),
      height_step(choose_height_step(given, asked)),
      lattice_steps(has_lines || asked.quality.shape.any() ? grid::kLatticeSteps
                    : frees_vertices                       ? grid::kLatticeSteps / grid::kFreeStep
                                                           : 1),
      is_exact(lattice_is_exact(given, rounds_offsets, lattice_steps)),
      is_exact_on_samples(lattice_is_exact(given, rounds_offsets, 1)),
      aim(choose_aim(*this)),
      memory(memory_budget(*this)),
      fit(fit_options(*this)) {}

Recipe Recipe::on(const HeightField& prepared) const {
  Recipe recipe = *this;
  recipe.field = prepared;
  return recipe;
}

}  // namespace scarp::pieces
