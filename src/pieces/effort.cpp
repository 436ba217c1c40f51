#include "pieces/effort.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "lines/breaklines.h"
#include "shape/shape_refinement.h"

namespace scarp {

namespace {

static_assert(kMostFitFields > kMaxChannels);

bool moves_vertices(Effort effort) { return effort == Effort::kHigh || effort == Effort::kMax; }

using Question = std::function<bool()>;

Question either(const Question& first, const Question& second) {
  if (!first || !second) return first ? first : second;
  return [first, second] { return first() || second(); };
}

/// Share of the max error for the rounding of heights.
constexpr double kHeightShare = 0x1p-8;

bool rows_run_along_x(const Frame& frame) { return frame.is_affine() && frame.affine[2] == 0 && frame.affine[4] == 0; }

/// True if samples are multiples of a power of two; false where that is not known.
bool samples_are_multiples(const HeightField& field, double step) {
  if (field.samples == nullptr) return false;
  const auto count = static_cast<std::size_t>(field.cols) * static_cast<std::size_t>(field.rows);
  return std::all_of(field.samples, field.samples + count, [step](float z) {
    const double multiple = z / step;
    return !std::isfinite(z) || multiple == std::floor(multiple);
  });
}

}  // namespace

bool has_lines(const SimplifyOptions& options) {
  return options.features.have_lines() || !options.features.cutline.rings.empty();
}

bool inserts_first(const SimplifyOptions& options) {
  return std::any_of(options.features.breaklines.lines.begin(), options.features.breaklines.lines.end(),
                     is_inserted_first);
}

bool has_budget(const SimplifyOptions& options) { return options.goals.max_triangles || options.goals.max_vertices; }

bool vertices_are_free(const HeightField& field, const SimplifyOptions& options) {
  return moves_vertices(options.quality.effort) && options.quality.vertices != Vertices::kSamples &&
         field.frame.is_affine() && !has_norm(field);
}

bool removes_last(const HeightField& field, const SimplifyOptions& options) {
  return options.quality.shape.any() && shape_rule(options.quality.shape, field.frame);
}

namespace {

/// The judge moves a position to a place of the lattice that is as near as rounding may have moved it, but not farther
/// off than this share of a cell: cells that are tiny compared with their coordinates lose their places.
bool doubles_hold_lattice(const HeightField& field, std::int32_t steps) {
  const auto& a = field.frame.affine;
  const double near = steps > 1 ? 0x1p-16 : 0x1p-8;
  const double cell = std::min(std::hypot(a[1], a[4]), std::hypot(a[2], a[5]));
  const double x = std::max({std::abs(a[0]), std::abs(a[1]) * field.cols, std::abs(a[2]) * field.rows});
  const double y = std::max({std::abs(a[3]), std::abs(a[4]) * field.cols, std::abs(a[5]) * field.rows});
  return 0x1p-50 * std::max(x, y) <= near * cell;
}

}  // namespace

bool rounds_offsets(const HeightField& field, const SimplifyOptions& options) {
  return options.output.float32_positions && !(options.output.lattice && rows_run_along_x(field.frame));
}

double height_step(const HeightField& field, const SimplifyOptions& options) {
  const Tolerances& own = options.tolerances;
  const bool has_own =
      !own.values.empty() || own.source != nullptr || !own.weights.empty() || own.weights_source != nullptr;
  if (!options.output.lattice || !rows_run_along_x(field.frame) || has_own || has_norm(field)) return 0;
  // Meshes that share a border share its bound, and not always their own: levels, and neighbours of other errors.
  const Border& border = options.domain.border;
  const double asked = options.goals.max_error.value_or(0);
  const double shared = border.is_locked ? border.max_error.value_or(asked) : asked;
  const double bound = std::min(asked, shared) - field.sample_rounding;
  if (!(bound > 0) || std::isinf(bound)) return 0;
  return std::ldexp(1.0, std::ilogb(2 * kHeightShare * bound));
}

bool lattice_is_exact(const HeightField& field, const SimplifyOptions& options, std::int32_t steps) {
  if (!field.frame.is_affine()) return false;
  return rounds_offsets(field, options) ? offsets_are_exact(field.frame, field.cols, field.rows, steps)
                                        : doubles_hold_lattice(field, steps);
}

std::int32_t choose_lattice_steps(const HeightField& field, const SimplifyOptions& options) {
  if (has_lines(options) || options.quality.shape.any()) return kLatticeSteps;
  return vertices_are_free(field, options) ? kLatticeSteps / kFreeStep : 1;
}

double aim_of(const HeightField& field, const SimplifyOptions& options) {
  constexpr double kRoundingShare = 0x1p-9;
  const std::int32_t steps = choose_lattice_steps(field, options);
  const double step = height_step(field, options);
  if (step > 0 && (steps > 1 || !samples_are_multiples(field, step))) return 1 - kHeightShare;
  return steps > 1 && !lattice_is_exact(field, options, steps) ? 1 - kRoundingShare : 1;
}

bool has_norm(const HeightField& field) { return !field.channels.empty() || field.height_scale != 1; }

std::optional<FitNorm> fit_norm(const SimplifyOptions& options, const Raster& raster, const Criterion& criterion) {
  const std::vector<MetricField> fields = criterion.metric_fields();
  if (fields.size() == 1 && fields[0].samples == raster.samples && fields[0].scale == 1) return std::nullopt;
  FitNorm norm;
  for (const MetricField& field : fields) norm.fields.push_back({field.samples, field.scale});
  norm.norm = options.goals.norm;
  norm.find_breach = [&metric = criterion.metric()](const std::array<Point, 3>& corners) {
    const auto candidate = metric.find_candidate(corners, metric.fit(corners, {}));
    return candidate ? std::optional(candidate->at) : std::nullopt;
  };
  return norm;
}

/// A short edge is worth any try.
constexpr double kAnyPatience = 100;

FitOptions fit_options(const HeightField& field, const SimplifyOptions& options, double threshold) {
  // On samples a floor would cost up to a tenth more, and could result in more triangles than normal effort.
  constexpr double kUsualShape = 0.1;
  const auto& a = field.frame.affine;
  FitOptions fit;
  fit.threshold = threshold;
  if (field.frame.transform || options.domain.border.is_locked) fit.free_sides = {false, false, false, false};
  fit.vertices_are_free = vertices_are_free(field, options);
  if (options.quality.effort == Effort::kNormal) fit.depth = kNormalDepth;
  if (options.quality.effort == Effort::kHigh) fit.depth = kHighDepth;
  if (options.quality.effort == Effort::kMax) fit.depth = kMaxDepth;
  // Two neighbours that are too near to each other are mostly both needed, but one between them may do.
  if (options.quality.shape.min_edge && moves_vertices(options.quality.effort)) {
    fit.depth.repair = kMaxDepth.repair;
    fit.depth.repair.patience = kAnyPatience;
  }
  fit.min_shape = options.quality.min_shape.value_or(fit.vertices_are_free ? kUsualShape : 0);
  fit.floor_yields = !options.quality.min_shape;
  fit.aspect = std::hypot(a[2], a[5]) / std::hypot(a[1], a[4]);
  if (options.quality.shape.any()) {
    fit.shape = shape_rule(options.quality.shape, field.frame);
    fit.floor_yields = false;
  }
  if (!has_budget(options)) fit.is_time_up = either(options.run.is_time_up, options.run.is_enough);
  fit.goes_on = options.quality.effort == Effort::kMax && options.run.is_time_up;
  return fit;
}

}  // namespace scarp
