#include "simplify/point_recipe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "fit/triangle_error.h"
#include "pieces/checks.h"

namespace scarp::run {

namespace {

Result<void> check_goals(const PointOptions& options) {
  if (!options.max_error && !options.max_triangles && !options.max_vertices)
    return fail(ErrorKind::kUsage, "no goal given: set max_error, max_triangles or max_vertices");
  if (options.objective == Objective::kRms) {
    if (!options.max_triangles && !options.max_vertices)
      return fail(ErrorKind::kUsage, "the objective rms needs max_triangles or max_vertices");
    if (options.quality.effort == Effort::kFast)
      return fail(ErrorKind::kUsage, "the objective rms needs more than fast effort");
  }
  if (options.boundary_length && !(*options.boundary_length > 0))
    return fail(ErrorKind::kUsage,
                fmt::format("boundary_length must be above 0, and {} is not", *options.boundary_length));
  const Quality& quality = options.quality;
  if (quality.order == Order::kDominant)
    return fail(ErrorKind::kUsage, "the dominant order is for rasters, not for points");
  if (quality.vertices == Vertices::kFree && quality.effort == Effort::kFast)
    return fail(ErrorKind::kUsage, "free vertices need more than fast effort, which only refines");
  if (quality.min_shape && quality.effort == Effort::kFast)
    return fail(ErrorKind::kUsage, "min_shape needs more than fast effort, which only refines");
  SCARP_RETURN_IF_ERROR(pieces::check_min_shape(quality.min_shape));
  return pieces::check_max_error(options.max_error);
}

Result<void> check_lines(const PointSet& points, const PointOptions& options) {
  if (!points.boundary.empty() && options.boundary_length)
    return fail(ErrorKind::kUsage, "boundary_length and a boundary of polygons exclude each other: omit one");
  if (!points.lines.empty() && options.boundary_length)
    return fail(ErrorKind::kUsage,
                "boundary_length cannot be combined with lines such as contours, which may cross what it takes away: "
                "leave it out");
  return {};
}

Result<void> check_tolerances(const PointSet& points, const PointOptions& options) {
  if (options.tolerances.empty()) return {};
  if (!options.max_error) return fail(ErrorKind::kUsage, "tolerances of points need a max error");
  const bool are_valid =
      options.tolerances.size() == points.size() &&
      std::all_of(options.tolerances.begin(), options.tolerances.end(), [](float bound) { return bound >= 0; });
  if (!are_valid) return fail(ErrorKind::kUsage, "tolerances of points: give one for each, at least 0");
  return {};
}

double largest_of(std::span<const double> heights) {
  double largest = 0;
  for (const double z : heights) largest = std::max(largest, std::abs(z));
  return largest;
}

/// There is no search for a small squared error with shape goals, nor with tolerances: a point with a tolerance is two
/// samples for fitting (point_fit.cpp), whose squares are not those of its error.
pieces::Search choose_search(const PointRecipe& recipe) {
  const PointOptions& options = recipe.options;
  const bool has_budget = options.max_triangles || options.max_vertices;
  if (!has_budget || (!recipe.removes && recipe.insertion_stops)) return pieces::Search::kNone;
  const bool lowers_squares = options.objective == Objective::kRms && recipe.removes && !options.quality.shape.any() &&
                              options.tolerances.empty();
  return lowers_squares ? pieces::Search::kSquares : pieces::Search::kError;
}

constexpr double kPositionShare = 0x1p-9;  ///< share of the bound for the rounding of positions

}  // namespace

PointAims::PointAims(double max_error, double largest) {
  // A point and the surface are each rounded by half a unit in the last place.
  const double rounding = largest * 0x1p-24 * (1 + 0x1p-10);
  fit = max_error * (1 - kPositionShare) - rounding;
  refinement = largest < double{geom::kMaxScanHeight} ? fit - 2 * rounding : 0;
}

Result<void> check_point_options(const PointSet& points, const PointOptions& options) {
  SCARP_RETURN_IF_ERROR(check_goals(options));
  SCARP_RETURN_IF_ERROR(check_tolerances(points, options));
  return check_lines(points, options);
}

PointRecipe::PointRecipe(const PointSet& points, const PointOptions& asked, const pieces::Scale& wanted)
    : options(asked),
      scale(wanted),
      largest(largest_of(points.z)),
      effort(wanted.refines_only                     ? Effort::kFast
             : asked.quality.effort == Effort::kAuto ? Effort::kNormal
                                                     : asked.quality.effort),
      traits(pieces::traits_of(effort)),
      aims(asked.max_error.value_or(0), largest),
      removes(traits.fits && (!asked.max_error || aims.is_open())),
      insertion_stops(points.lines.empty() && !asked.quality.shape.any() && asked.tolerances.empty()),
      search(choose_search(*this)),
      frees_vertices(pieces::may_free(traits, asked.quality.vertices)),
      removes_last(removes && asked.quality.shape.any() && !asked.quality.shape.grade),
      steps(asked.float32_positions && (removes || asked.quality.shape.any() || !points.lines.empty())
                ? grid::PointSteps::kFloat32
            : removes || asked.quality.shape.any() ? grid::PointSteps::kFit
                                                   : grid::PointSteps::kFinest) {}

}  // namespace scarp::run
