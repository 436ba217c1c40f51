// Scattered points to a mesh: checks, then runs (point_run.h). After `snap_points`, every point has its own lattice
// point; after `build_domain`, the boundary is fixed.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <new>
#include <utility>
#include <vector>

#include "grid/far_points.h"
#include "grid/snapped_points.h"
#include "measure/point_judge.h"
#include "pieces/checks.h"
#include "refine/concave_outline.h"
#include "refine/hull_fit.h"
#include "scarp/point_blocks.h"
#include "scarp/points.h"
#include "simplify/budget_search.h"
#include "simplify/point_recipe.h"
#include "simplify/point_run.h"
#include "simplify/squares_search.h"
#include "simplify/working_set.h"

namespace scarp {

namespace {

/// Heights that vertices have in a mesh of float32 positions.
Result<std::vector<double>> round_heights(const PointSet& points, const grid::SnappedPoints& snapped) {
  for (const auto& values : {std::span(points.x), std::span(points.y)}) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    if (*most - *least > std::numeric_limits<float>::max())
      return fail(ErrorKind::kPromise,
                  fmt::format("the extent of the points, {}, does not fit float32: write OBJ or PLY, whose positions "
                              "are double",
                              *most - *least));
  }
  std::vector<double> heights;
  heights.reserve(snapped.size());
  for (std::size_t i = 0; i < snapped.size(); ++i) {
    if (std::abs(snapped.z[i]) > std::numeric_limits<float>::max())
      return fail(ErrorKind::kPromise,
                  fmt::format("the height {} at ({}, {}) does not fit float32: write OBJ or PLY, whose positions are "
                              "double",
                              snapped.z[i], points.x[snapped.source[i]], points.y[snapped.source[i]]));
    heights.push_back(double{static_cast<float>(snapped.z[i])});
  }
  return heights;
}

/// The middle of the extent, rounded so coarsely that offsets from it are exact doubles.
double middle(std::span<const double> values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double centre = *least + (*most - *least) / 2;
  const double unit = *least == *most ? 0 : std::ldexp(1.0, std::ilogb(*most - *least) - 4);
  if (unit == 0) return centre;
  return std::nearbyint(centre / unit) * unit + 0.0;  // no -0
}

/// Refuses points that rounding moves onto one line: the few points off it turn triangles over.
Result<void> check_width(const PointSet& points, const grid::SnappedPoints& snapped,
                         const refine::ScatteredDomain& domain) {
  const grid::PointLattice& lattice = snapped.lattice;
  const double reach = lattice.step * std::max(lattice.cols, lattice.rows) / 2;
  const double rounding = std::max(snapped.is_exact ? 0 : lattice.step / 2, reach * 0x1p-53);
  if (domain.width > 4 * rounding) return {};
  const std::string far = grid::describe_far_points(points);
  return fail(ErrorKind::kInput,
              fmt::format("all points lie on one line, to {:.2g}, so there is no surface to simplify{}", domain.width,
                          far.empty() ? "" : "; " + far));
}

using Outlines = std::vector<std::vector<std::uint32_t>>;

/// The lattice points of a set's own boundary.
Outlines snap_boundary(const PointSet& points, const grid::SnappedPoints& snapped) {
  Outlines outlines;
  for (const auto& ring : points.boundary) {
    outlines.emplace_back();
    for (const std::uint32_t corner : ring) outlines.back().push_back(snapped.place[corner]);
  }
  return outlines;
}

Result<run::PointMesh> run_from(const run::PointTask& task, const run::PointRecipe& recipe, const Outlines& outlines) {
  // The points may have grown in number since the outlines were made.
  SCARP_TRY(auto&& domain,
            task.proof == nullptr ? refine::build_domain(task.snapped, outlines) : refine::build_domain(task.snapped));
  for (const std::uint32_t point : task.lines.ends()) {
    const Point p = task.snapped.at[point];
    domain.insert(point, p, domain.tin.locate(p, domain.tin.last_touched()));
  }
  return run::run_points(task, recipe, std::move(domain));
}

/// Judges a mesh by tolerances that were multiplied for it: the least factor that all errors keep, and the RMS of the
/// ratios of error to bound.
Result<void> judge_factor(const run::PointTask& task, const PointOptions& asked, Simplified& made) {
  double factor = 0, squares = 0;
  std::uint64_t count = 0;
  MeasureOptions judge;
  judge.run.threads = asked.run.threads;
  judge.inlets = asked.boundary_length.has_value();
  judge.tolerance = asked.tolerances;
  judge.on_row = [&](int, std::span<const float> errors) {
    for (std::size_t i = 0; i < errors.size(); ++i) {
      const double bound = std::min(*asked.max_error, double{asked.tolerances[i]}), error = std::abs(double{errors[i]});
      if (!(error >= 0)) continue;
      const double ratio = error > 0 ? error / bound : 0;
      factor = std::max(factor, ratio);
      squares += ratio * ratio;
      ++count;
    }
  };
  SCARP_TRY(made.measurement, judge::judge_points(task.points, task.snapped, made.mesh, judge));
  made.judged_max_error = factor * (1 + 0x1p-22);  // errors are float32
  made.judged_rmse = std::sqrt(squares / static_cast<double>(std::max<std::uint64_t>(count, 1)));
  made.tolerance_factor = std::max(1.0, made.judged_max_error);
  return {};
}

/// Finds the mesh of a budget by runs for several errors or, with tolerances, for several factors of all bounds.
Result<run::PointMesh> search(const run::PointTask& task, const run::PointRecipe& recipe, const Outlines& outlines) {
  const PointOptions& asked = recipe.options;
  SimplifyOptions options;
  options.goals = {asked.max_error, asked.max_triangles, asked.max_vertices, asked.objective};
  options.tolerances.values = asked.tolerances;
  options.quality = asked.quality;
  options.run = asked.run;
  // The address of a run's positions, and its facts; a later run may reuse the address of a worse mesh.
  std::vector<std::pair<const double*, run::PointFacts>> facts;
  run::BudgetTask search;
  search.run = [&](const SimplifyOptions& towards, const pieces::Scale& scale) -> Result<Simplified> {
    PointOptions once = asked;
    once.max_error = towards.goals.max_error;
    once.max_triangles = towards.goals.max_triangles;
    once.max_vertices = towards.goals.max_vertices;
    std::vector<float> tolerances;
    for (const float bound : asked.tolerances) tolerances.push_back(static_cast<float>(scale.factor * double{bound}));
    once.tolerances = tolerances;
    SCARP_TRY(auto&& made, run_from(task, run::PointRecipe(task.points, once, scale), outlines));
    if (!tolerances.empty()) {
      SCARP_RETURN_IF_ERROR(judge_factor(task, asked, made.simplified));
    }
    facts.emplace_back(made.simplified.mesh.positions.data(), made.facts);
    return std::move(made.simplified);
  };
  search.traits = recipe.traits;
  search.insertion_stops = recipe.insertion_stops;
  search.most = [&] {
    const auto [least, most] = std::minmax_element(task.snapped.z.begin(), task.snapped.z.end());
    double bound = asked.tolerances.empty() ? 1 : asked.max_error.value();
    for (const float tolerance : asked.tolerances) {
      if (tolerance > 0) bound = std::min(bound, double{tolerance});
    }
    return 2 * (*most - *least) / (bound > 0 ? bound : 1);
  };
  search.least = task.least(asked);
  SCARP_TRY(auto&& found, recipe.search == pieces::Search::kSquares ? run::search_squares(options, search)
                                                                    : run::search_budget(options, search));
  auto of_found = facts.rbegin();
  while (of_found->first != found.mesh.positions.data()) ++of_found;
  return run::PointMesh{std::move(found), of_found->second};
}

Result<SimplifiedPoints> simplify(const PointSet& points, const grid::SnappedPoints& snapped,
                                  const std::vector<double>& heights, const run::PointRecipe& recipe,
                                  run::WiderProof* proof) {
  const PointOptions& options = recipe.options;
  SCARP_TRY(auto&& domain, refine::build_domain(snapped));
  SCARP_RETURN_IF_ERROR(check_width(points, snapped, domain));
  const double width = domain.width;
  const grid::PointLattice& lattice = snapped.lattice;
  const double area = lattice.step * lattice.cols * lattice.step * lattice.rows;
  const std::uint64_t count = proof == nullptr ? snapped.size() : proof->total();
  SCARP_RETURN_IF_ERROR(pieces::check_shape_goals(options.quality.shape, std::sqrt(area / static_cast<double>(count))));
  if (!points.boundary.empty()) {
    SCARP_TRY(domain, refine::build_domain(snapped, snap_boundary(points, snapped)));
  } else if (options.boundary_length) {
    SCARP_TRY(domain, refine::build_concave_domain(snapped, std::move(domain), *options.boundary_length));
  }
  SCARP_TRY(const auto& lines, refine::PointLines::build(points, snapped));
  const run::PointTask task{points, snapped, heights, lines, recipe.steps, width, proof};
  SimplifiedPoints result;
  result.points = points.size();
  result.duplicates = snapped.duplicates;
  for (const auto& ring : domain.outlines) result.on_hull += ring.size();
  result.lattice_step = snapped.lattice.step;
  if (!options.boundary_length && points.boundary.empty() && points.lines.empty() && proof == nullptr)
    result.hull_fit = refine::find_hull_fit(snapped);
  const Outlines outlines = domain.outlines;
  SCARP_TRY(auto&& made,
            recipe.search == pieces::Search::kNone ? run_from(task, recipe, outlines) : search(task, recipe, outlines));
  result.simplified = std::move(made.simplified);
  result.flat = made.facts.flat;
  result.loose = made.facts.loose;
  return result;
}

Error refuse_memory() {
  return {ErrorKind::kInput, "not enough memory for these points and this goal: allow a larger error or fewer points"};
}

Result<void> check_blocks(const PointBlocks& blocks, const PointOptions& options) {
  if (!options.tolerances.empty() || options.boundary_length || options.placement)
    return fail(ErrorKind::kUsage, "points in blocks take no tolerances, boundary_length or placement");
  if (blocks.size() == 0) return fail(ErrorKind::kInput, "there are no points");
  return {};
}

/// The options of the first run, above whose mesh points are chosen.
PointOptions first_options(PointOptions options) {
  options.quality = {};
  options.quality.effort = Effort::kFast;
  options.objective = Objective::kMax;
  return options;
}

}  // namespace

std::array<double, 2> local_origin(const PointSet& points) { return {middle(points.x), middle(points.y)}; }

Result<SimplifiedPoints> simplify_points(const PointSet& points, const PointOptions& options) try {
  SCARP_RETURN_IF_ERROR(run::check_point_options(points, options));
  const run::PointRecipe recipe(points, options);
  SCARP_TRY(const auto& snapped, grid::snap_points(points, options.duplicates, recipe.steps));
  if (!options.float32_positions) return simplify(points, snapped, snapped.z, recipe, nullptr);
  SCARP_TRY(const auto& rounded, round_heights(points, snapped));
  return simplify(points, snapped, rounded, recipe, nullptr);
} catch (const std::bad_alloc&) {
  return tl::unexpected(refuse_memory());
} catch (const std::exception& e) {
  return fail(ErrorKind::kInternal, fmt::format("an exception while simplifying: {}", e.what()));
}

Result<SimplifiedBlocks> simplify_points(const PointBlocks& blocks, const PointOptions& options) try {
  SCARP_RETURN_IF_ERROR(check_blocks(blocks, options));
  SCARP_RETURN_IF_ERROR(run::check_point_options({}, options));
  run::WorkingSet working(blocks, options);
  SCARP_RETURN_IF_ERROR(working.find_extent());
  const run::PointRecipe recipe(working.points(), options);
  // Vertices off the points leave errors near the bound everywhere, so too many other points would break it.
  if (recipe.traits.moves_vertices || recipe.frees_vertices)
    return fail(ErrorKind::kUsage,
                "high and max effort and free vertices need all points at once, not in blocks: use "
                "normal effort");
  SCARP_RETURN_IF_ERROR(working.start(recipe.steps));
  if (options.float32_positions) {
    SCARP_RETURN_IF_ERROR(round_heights(working.points(), working.snapped()));
  }
  const auto run = [&](const run::PointRecipe& of, run::WiderProof* proof) {
    return simplify(working.points(), working.snapped(), working.heights(), of, proof);
  };
  {
    SCARP_TRY(const auto& first, run(run::PointRecipe(working.points(), first_options(options)), nullptr));
    SCARP_RETURN_IF_ERROR(working.add_extremes(first.simplified.mesh));
  }
  SimplifiedBlocks result;
  // A run that ends at a budget leaves larger errors than its own at points that it did not use; they join the next.
  constexpr int kMostRuns = 5;
  const auto ended_at_budget = [&] {
    const StopReason stop = result.made.simplified.stop;
    return stop != StopReason::kMaxError && stop != StopReason::kExact;
  };
  for (int k = 0; k == 0 || (k < kMostRuns && ended_at_budget() && working.take_growth()); ++k) {
    SCARP_TRY(auto&& made, run(recipe, &working));
    const auto error = [&](const SimplifiedPoints& of) {
      return options.objective == Objective::kRms ? of.simplified.judged_rmse : of.simplified.judged_max_error;
    };
    if (k == 0 || error(made) < error(result.made)) result.made = std::move(made);
  }
  result.made.points = blocks.size();
  result.made.duplicates = 0;
  result.kept = working.take_points();
  return result;
} catch (const std::bad_alloc&) {
  return tl::unexpected(refuse_memory());
} catch (const std::exception& e) {
  return fail(ErrorKind::kInternal, fmt::format("an exception while simplifying: {}", e.what()));
}

}  // namespace scarp
