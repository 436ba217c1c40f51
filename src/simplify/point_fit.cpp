#include "simplify/point_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "base/reporter.h"
#include "fit/fit.h"
#include "fit/point_samples.h"
#include "shape/shape_refinement.h"

namespace scarp::run {

namespace {

constexpr std::int32_t kMostCells = fit::kMaxFitSteps / grid::kLatticeSteps;

/// The points, including those that share a lattice point. A point whose bound b is smaller than the threshold t
/// becomes two samples, t − b above and t − b below it: if the errors at both samples are at most t, the error at the
/// point is at most b. If no b remains, the point is not a sample: it is a vertex or on an edge, and the proof decides.
class AllSamples {
 public:
  AllSamples(const grid::SnappedPoints& points, const PointRecipe& recipe) : recipe_(recipe) {
    const Point last{points.lattice.cols - 1, points.lattice.rows - 1};
    const double rounding = points.is_exact ? 0 : std::numbers::sqrt2 / 2;
    if (points.echoes.empty() && recipe.options.tolerances.empty()) {
      samples_.emplace(points.at, points.z, last, rounding);
      return;
    }
    auto echo = points.echoes.begin();
    for (std::uint32_t point = 0; point < points.size(); ++point) {
      add(points.at[point], points.z[point], points.source[point]);
      for (; echo != points.echoes.end() && echo->point == point; ++echo) add(points.at[point], echo->z, echo->source);
    }
    samples_.emplace(at_, z_, last, rounding);
  }

  const fit::PointSamples& samples() const { return *samples_; }

 private:
  void add(Point at, double z, std::uint32_t source) {
    const double threshold = recipe_.aims.fit;
    const double bound =
        recipe_.options.tolerances.empty() ? threshold : PointAims(recipe_.bound_of(source), recipe_.largest).fit;
    if (bound <= 0) return;
    const double room = threshold - bound;
    for (const double height : {z - room, z + room}) {
      at_.push_back(at);
      z_.push_back(height);
      if (room == 0) break;
    }
  }

  const PointRecipe& recipe_;
  std::vector<Point> at_;
  std::vector<double> z_;
  std::optional<fit::PointSamples> samples_;
};

grid::VertexLattice make_lattice(const refine::ScatteredDomain& domain, std::span<const double> heights,
                                 std::span<const std::uint32_t> fixed) {
  grid::VertexLattice lattice{grid::kLatticeSteps, {}, {}};
  lattice.heights.reserve(domain.point_of.size());
  lattice.fixed.reserve(domain.point_of.size());
  for (tin::Vertex v = 0; v < domain.point_of.size(); ++v) {
    const std::uint32_t point = domain.point_of[v];
    lattice.heights.push_back(static_cast<float>(domain.is_unused(v) ? 0 : domain.height(v, heights)));
    lattice.fixed.push_back(point != tin::kNone && std::binary_search(fixed.begin(), fixed.end(), point));
  }
  return lattice;
}

/// Makes the domain of a fitted mesh. A vertex at the place and height of a point becomes that point.
void rebuild(const grid::SnappedPoints& points, std::span<const double> heights, fit::Fitted fitted,
             refine::ScatteredDomain& domain) {
  const tin::Triangulation& tin = domain.tin = std::move(fitted.tin);
  std::vector<std::uint8_t> is_used(tin.vertex_count(), 0);
  for (tin::HalfEdge h = 0; h < 3 * tin.triangle_count(); ++h) {
    if (!tin.is_outside(h / 3)) is_used[tin.origin(h)] = 1;
  }
  domain.point_of.assign(tin.vertex_count(), tin::kNone);
  domain.heights.assign(tin.vertex_count(), std::numeric_limits<double>::quiet_NaN());
  domain.unused = 0;
  for (tin::Vertex v = 0; v < tin.vertex_count(); ++v) {
    if (is_used[v] == 0) {
      ++domain.unused;
      continue;
    }
    const std::uint32_t point = grid::find_point(points, tin.point(v));
    if (point != points.size() && static_cast<float>(heights[point]) == fitted.lattice.heights[v]) {
      domain.point_of[v] = point;
    } else {
      domain.heights[v] = double{fitted.lattice.heights[v]};
    }
  }
}

}  // namespace

Result<PointFit> fit_points(const grid::SnappedPoints& points, std::span<const double> heights,
                            std::span<const std::uint32_t> fixed, const PointRecipe& recipe,
                            refine::ScatteredDomain& domain) {
  const PointOptions& options = recipe.options;
  const Quality& quality = options.quality;
  const AllSamples all(points, recipe);
  const fit::PointSamples& samples = all.samples();
  fit::FitOptions fit_options;
  fit_options.points = &samples;
  fit_options.threshold = recipe.aims.fit;
  fit_options.threads = options.run.threads;
  fit_options.depth = recipe.traits.depth;
  fit_options.vertices_are_free = recipe.frees_vertices;
  fit_options.min_shape = quality.min_shape.value_or(pieces::usual_shape(recipe.traits, recipe.frees_vertices));
  fit_options.floor_yields = !quality.min_shape && !quality.shape.any();
  if (quality.shape.any()) fit_options.shape = shape::shape_rule(quality.shape, points.lattice);
  fit_options.squares = recipe.scale.squares;
  if (fit_options.squares && fit_options.squares->most_vertices != fit::kNoBudget)
    fit_options.squares->most_vertices += domain.unused;
  fit_options.is_time_up = options.run.is_time_up;
  fit_options.goes_on = recipe.traits.goes_on && options.run.is_time_up;
  Reporter reporter(options.run.progress);
  if (options.run.progress) {
    fit_options.progress = [&](double share, std::uint64_t vertices) {
      return !reporter.due() || reporter.report("fit", share, vertices, 0);
    };
  }
  const grid::Raster cells{nullptr, samples.last().x / grid::kLatticeSteps + 2,
                           samples.last().y / grid::kLatticeSteps + 2};
  if (std::max(cells.cols, cells.rows) > kMostCells) fit_options.most_side = kMostCells / 2;
  grid::VertexLattice lattice = make_lattice(domain, heights, fixed);
  SCARP_TRY(auto&& fitted, fit::fit(cells, std::move(domain.tin), std::move(lattice), fit_options));
  const PointFit result{fitted.counts.removed, fitted.is_cut_short};
  rebuild(points, heights, std::move(fitted), domain);
  return result;
}

}  // namespace scarp::run
