// Algorithm IV against its definition, and effects of settling.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "geom/plane.h"
#include "grid/generate.h"
#include "laws/strategies.h"
#include "metric/height_metric.h"
#include "refine/data_dependent.h"
#include "refine/domain.h"
#include "refine/quadrilateral.h"
#include "refine/refinement.h"
#include "refine/settle_edges.h"

namespace scarp::data_dependent_laws_test {
namespace {

using testing::Field;
using testing::Relief;
using Corners = std::array<Point, 3>;

Field any_field(std::int32_t largest) {
  const auto cols = *rc::gen::inRange(3, largest), rows = *rc::gen::inRange(3, largest);
  const auto relief =
      *rc::gen::elementOf(std::vector<Relief>(std::begin(testing::kReliefs), std::end(testing::kReliefs)));
  return testing::random_field(*rc::gen::arbitrary<std::uint32_t>(), cols, rows, relief, *rc::gen::element(0.0, 0.1));
}

/// Errors of all valid samples in the closed triangle, by scanning every sample of the raster.
struct Errors {
  double largest = 0, squares = 0;
};
Errors errors_in(const grid::Raster& raster, const Corners& corners) {
  const geom::Plane plane =
      geom::Plane::through(corners, {raster.at(corners[0]), raster.at(corners[1]), raster.at(corners[2])});
  Errors errors;
  for (std::int32_t y = 0; y < raster.rows; ++y) {
    for (std::int32_t x = 0; x < raster.cols; ++x) {
      const Point p{x, y};
      if (!raster.is_valid(p) || orient(corners[0], corners[1], p) < 0 || orient(corners[1], corners[2], p) < 0 ||
          orient(corners[2], corners[0], p) < 0)
        continue;
      const double error = std::abs(plane.height_at(p) - double{raster.at(p)});
      errors.largest = std::max(errors.largest, error);
      errors.squares += error * error;
    }
  }
  return errors;
}

/// The rule of the paper's program, without cache, early end or any other optimisation.
class TextbookRule final : public tin::FlipRule {
 public:
  TextbookRule(const grid::Raster& raster, EdgeScore score, double threshold)
      : raster_(raster), score_(score), threshold_(threshold) {}

  bool should_flip(const tin::Triangulation& tin, tin::HalfEdge h) override {
    const refine::Quadrilateral quad(tin, h);
    if (!quad.can_flip()) return false;
    if (tin.is_outside(quad.t)) {
      const auto [a, b, c] = quad.kept[0];
      return geom::in_circle(a, b, c, quad.kept[1][2]) > 0;
    }
    const double kept = refine::box_quality(quad.kept[0]) * refine::box_quality(quad.kept[1]);
    const double other = refine::box_quality(quad.other[0]) * refine::box_quality(quad.other[1]);
    if (!(std::min(kept, other) / std::max(kept, other) > threshold_)) return other > kept;
    return score(quad.other) < score(quad.kept);
  }

 private:
  double score(const Corners (&pair)[2]) const {
    const Errors first = errors_in(raster_, pair[0]), second = errors_in(raster_, pair[1]);
    if (score_ == EdgeScore::kMax) return std::max(first.largest, second.largest);
    return score_ == EdgeScore::kSum ? first.largest + second.largest : first.squares + second.squares;
  }

  grid::Raster raster_;
  EdgeScore score_;
  double threshold_;
};

RC_GTEST_PROP(data_dependent, edges_are_those_of_the_textbook_rule, ()) {
  const Field field = any_field(14);
  const grid::Raster raster = field.raster();
  auto fast = refine::build_domain(raster, 0, grid_frame(field.rows)),
       slow = refine::build_domain(raster, 0, grid_frame(field.rows));
  RC_PRE(fast.has_value());
  const EdgeScore score = *rc::gen::element(EdgeScore::kSum, EdgeScore::kMax);
  const double threshold = *rc::gen::element(0.0, 0.2, 0.5, 1.0);
  const metric::HeightMetric metric(raster, 0);
  refine::Refinement refinement(metric, fast->tin, Algorithm::kHeap, {true, score, threshold, 0, false});
  TextbookRule rule(raster, score, threshold);
  while (!refinement.done()) {
    refinement.insert_worst();
    const Point p = fast->tin.point(static_cast<tin::Vertex>(fast->tin.vertex_count() - 1));
    slow->tin.insert(p, slow->tin.locate(p, slow->tin.last_touched()), &rule);
    RC_ASSERT(fast->tin.triangle_count() == slow->tin.triangle_count());
    std::vector<std::array<tin::Vertex, 3>> first, second;
    for (const auto& [tin, list] : {std::pair{&fast->tin, &first}, {&slow->tin, &second}}) {
      for (tin::Triangle t = 0; t < tin->triangle_count(); ++t) {
        std::array<tin::Vertex, 3> ids{tin->origin(3 * t), tin->origin(3 * t + 1), tin->origin(3 * t + 2)};
        std::sort(ids.begin(), ids.end());
        list->push_back(ids);
      }
      std::sort(list->begin(), list->end());
    }
    RC_ASSERT(first == second);
  }
}

// Scape's data-dependent mode lost samples on edges, so that its reported max error was too small.
RC_GTEST_PROP(data_dependent, the_engines_largest_error_is_the_largest_error, ()) {
  const Field field = any_field(24);
  const grid::Raster raster = field.raster();
  auto domain = refine::build_domain(raster, 0, grid_frame(field.rows));
  RC_PRE(domain.has_value());
  const metric::HeightMetric metric(raster, 0);
  const EdgeRule rule = testing::any_edge_rule();
  refine::Refinement refinement(metric, domain->tin, Algorithm::kHeap, rule);
  const auto steps = *rc::gen::inRange(1, 120);
  for (int k = 0; k < steps && !refinement.done(); ++k) refinement.insert_worst();
  double largest = 0;
  for (tin::Triangle t = 0; t < domain->tin.triangle_count(); ++t) {
    if (!domain->tin.is_outside(t)) largest = std::max(largest, errors_in(raster, domain->tin.corners(t)).largest);
  }
  if (!refinement.done()) RC_ASSERT(refinement.worst_error() == largest);
}

RC_GTEST_PROP(data_dependent, settling_lowers_the_squares_and_raises_no_largest_error, ()) {
  const Field field = any_field(28);
  PaperOptions options;
  options.strategy.edges = testing::any_edge_rule();
  options.strategy.best_of_budget = false;
  options.goals.max_vertices = *rc::gen::inRange<std::uint64_t>(4, 200);
  options.strategy.edges.settle = false;
  const auto before = simplify_by_paper(field.view(), options);
  options.strategy.edges.settle = true;
  const auto after = simplify_by_paper(field.view(), options);
  RC_PRE(before.has_value());
  RC_ASSERT(after.has_value());
  RC_ASSERT(after->measurement.max_error <= before->measurement.max_error);
  RC_ASSERT(after->mesh.vertex_count() == before->mesh.vertex_count());
  RC_ASSERT(after->measurement.rmse <= before->measurement.rmse * (1 + 1e-12) + 1e-9);
}

// Synthetic fields: if the surface bends in only one direction, Delaunay's round triangles are wasteful.
TEST(data_dependent, follows_a_diagonal_step_far_better_than_delaunay) {
  const auto field = grid::generate_field(grid::FieldStyle::kDiagonalStep, 256, 256);
  ASSERT_TRUE(field);
  PaperOptions options{.goals = {.max_vertices = 200}};
  const double delaunay = simplify_by_paper(*field, options)->measurement.max_error;
  for (const EdgeScore score : {EdgeScore::kSum, EdgeScore::kTight}) {
    options.strategy.edges = {true, score};
    EXPECT_LT(simplify_by_paper(*field, options)->measurement.max_error, delaunay / 2);
  }
}

}  // namespace
}  // namespace scarp::data_dependent_laws_test
