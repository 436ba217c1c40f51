#include "pieces/checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "grid/samples.h"
#include "metric/criterion.h"
#include "pieces/conflicts.h"
#include "pieces/effort.h"
#include "scarp/features.h"
#include "shape/shape_refinement.h"

namespace scarp::pieces {

namespace {

tl::unexpected<Error> usage(std::string message) { return fail(ErrorKind::kUsage, std::move(message)); }

/// The name of the lines.
const char* name_lines(const SimplifyOptions& options) {
  const auto& lines = options.features.breaklines.lines;
  const auto all = [&](bool (*kind)(const Line&)) {
    return !lines.empty() && std::all_of(lines.begin(), lines.end(), kind);
  };
  if (all(is_wall)) return "cliffs";
  if (!options.features.cutline.rings.empty()) return "a cutline";
  return all(is_ridge_line) ? "ridges" : "breaklines";
}

Result<void> check_border(const HeightField& field, const SimplifyOptions& options) {
  const Border& border = options.domain.border;
  if (!border.is_locked) return {};
  if (!options.goals.max_error && !metric::has_tolerances(options))
    return usage("a locked border needs a max error: a budget finds another one for each raster");
  const std::optional<double>& error = border.max_error;
  if (error && !(*error >= 0 && *error <= options.goals.max_error.value_or(HUGE_VAL) && std::isfinite(*error)))
    return usage(fmt::format("the border's max error must lie in 0 … {}, that of the mesh, not {}",
                             options.goals.max_error.value_or(HUGE_VAL), *error));
  const auto fits = [](const std::vector<float>& beyond, int samples) {
    return beyond.empty() || beyond.size() == static_cast<std::size_t>(samples);
  };
  const BeyondEdges& beyond = border.beyond;
  if (!fits(beyond.top, field.cols) || !fits(beyond.bottom, field.cols) || !fits(beyond.left, field.rows) ||
      !fits(beyond.right, field.rows))
    return usage(fmt::format("heights beyond a raster's edges must be as many as its {} columns or {} rows, or none",
                             field.cols, field.rows));
  for (const auto& [col, row] : options.features.points) {
    if (col <= 0 || row <= 0 || col >= field.cols - 1 || row >= field.rows - 1)
      return usage(fmt::format(
          "sample ({}, {}) lies on the raster's edge, which is locked: leave it out, or give it as one of the border's "
          "vertices",
          col, row));
  }
  return {};
}

Result<void> check_shape(const HeightField& field, const ShapeGoals& shape) {
  const auto& a = field.frame.affine;
  SCARP_RETURN_IF_ERROR(check_shape_goals(shape, std::max(std::hypot(a[1], a[4]), std::hypot(a[2], a[5]))));
  if (shape.any() && std::max(field.cols, field.rows) > kMaxCoordinate / grid::kLatticeSteps)
    return usage(
        fmt::format("a raster of {} x {} samples is too large for goals of angles and edges: at most {} a side",
                    field.cols, field.rows, kMaxCoordinate / grid::kLatticeSteps));
  return {};
}

/// The smallest number with two digits that is not below the value. REQUIRES: value > 0.
double round_to_two_digits(double value) {
  const double exponent = std::floor(std::log10(value)) - 1, unit = std::pow(10, std::abs(exponent));
  const auto scale = [&](double count) { return exponent < 0 ? count / unit : count * unit; };
  const double count = std::ceil(exponent < 0 ? value * unit : value / unit);
  return scale(scale(count) < value ? count + 1 : count);
}

/// Fails where doubles are coarser than the spacing of samples, far from 0.
Result<void> check_places(const HeightField& field) {
  for (int axis = 0; axis < 2; ++axis) {
    const double* const terms = &field.frame.affine[3 * static_cast<std::size_t>(axis)];
    const double far = std::abs(terms[0]) + std::abs(terms[1]) * field.cols + std::abs(terms[2]) * field.rows;
    const double cell = std::max(std::abs(terms[1]), std::abs(terms[2]));
    if (cell < far * std::numeric_limits<double>::epsilon())
      return fail(ErrorKind::kPromise, fmt::format("coordinates of {:.3g} cannot tell samples {:.3g} apart from each "
                                                   "other, as double has 16 digits; move the raster nearer to 0",
                                                   far, cell));
  }
  return {};
}

Result<void> check_conflicts(const HeightField& field, const SimplifyOptions& options) {
  const std::vector<Conflict> conflicts = find_conflicts(field, options);
  if (conflicts.empty()) return {};
  return usage(describe(conflicts.front()));
}

Result<void> check_needs(const HeightField& field, const SimplifyOptions& options) {
  const bool has_error_for_all = options.goals.max_error || metric::has_budget(options);
  SCARP_RETURN_IF_ERROR(check_min_shape(options.quality.min_shape));
  SCARP_RETURN_IF_ERROR(check_border(field, options));
  if (options.goals.objective == Objective::kRms && !metric::has_budget(options))
    return usage("the rms objective needs a budget of triangles or vertices: a max error alone decides the mesh");
  if (metric::has_lines(options) && !has_error_for_all)
    return usage(fmt::format("a mesh with {} needs a max error or a budget", name_lines(options)));
  if (options.quality.shape.any() && !has_error_for_all)
    return usage("a mesh with goals for angles and edges needs a max error or a budget");
  return check_shape(field, options.quality.shape);
}

}  // namespace

Result<void> check_shape_goals(const ShapeGoals& shape, double spacing) {
  constexpr double kLargestAngle = 33, kLeastEdge = 0.125;
  if (!(shape.min_angle >= 0 && shape.min_angle <= kLargestAngle))
    return usage(fmt::format("the minimum angle must lie in 0 … {} degrees, not {}", kLargestAngle, shape.min_angle));
  if (shape.grade && !(*shape.grade > 0 && std::isfinite(*shape.grade)))
    return usage(fmt::format("the grade must be a finite number above 0, not {}", *shape.grade));
  if (shape.max_edge && !(*shape.max_edge >= kLeastEdge * spacing))
    return usage(fmt::format("the max edge must be at least {} of the distance between samples, that is {}, not {}",
                             kLeastEdge, kLeastEdge * spacing, *shape.max_edge));
  if (shape.min_edge && !(*shape.min_edge > 0 && std::isfinite(*shape.min_edge)))
    return usage(fmt::format("the min edge must be a finite number above 0, not {}", *shape.min_edge));
  if (shape.min_edge && shape.max_edge && !(*shape.min_edge <= *shape.max_edge / 2))
    return usage(
        fmt::format("the min edge must be at most half of the max edge, that is {}, not {}: longer edges are "
                    "halved",
                    *shape.max_edge / 2, *shape.min_edge));
  return {};
}

Result<void> check_min_shape(const std::optional<double>& min_shape) {
  if (!min_shape || (*min_shape >= 0 && *min_shape <= 0.5)) return {};
  return usage(fmt::format("the floor of shapes must lie in 0 … 0.5, not {}", *min_shape));
}

Result<void> check_max_error(const std::optional<double>& max_error) {
  if (!max_error || (*max_error >= 0 && std::isfinite(*max_error))) return {};
  return usage(fmt::format("max_error must be a finite number of at least 0, not {}", *max_error));
}

Result<void> check_values(const HeightField& field, const SimplifyOptions& options) {
  const Goals& goals = options.goals;
  if (!goals.max_error && !goals.max_triangles && !goals.max_vertices && !metric::has_tolerances(options))
    return usage("no goal given: set max_error, max_triangles, max_vertices or tolerance");
  SCARP_RETURN_IF_ERROR(check_max_error(goals.max_error));
  SCARP_RETURN_IF_ERROR(check_places(field));
  if (!(options.domain.outline_tolerance >= 0 && std::isfinite(options.domain.outline_tolerance)))
    return usage(fmt::format("outline_tolerance must be a finite number of at least 0, not {}",
                             options.domain.outline_tolerance));
  if (options.goals.max_error && *options.goals.max_error < field.sample_rounding)
    return fail(
        ErrorKind::kPromise,
        fmt::format(
            "a max error of {} cannot be kept: the raster's values do not fit float32 and are rounded by up to {:.3g}; "
            "ask for {} or more, or subtract a base from them",
            *options.goals.max_error, field.sample_rounding, round_to_two_digits(field.sample_rounding)));
  return {};
}

Result<void> check_options(const HeightField& field, const SimplifyOptions& options) {
  for (const auto check : {check_values, check_conflicts, check_needs}) {
    SCARP_RETURN_IF_ERROR(check(field, options));
  }
  return grid::check_size(field);
}

}  // namespace scarp::pieces
