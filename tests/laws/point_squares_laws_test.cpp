// Meshes of scattered points within a budget and with a small squared error.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "laws/point_sets.h"
#include "laws/sanitized.h"
#include "scarp/measure.h"
#include "scarp/points.h"

namespace scarp::point_squares_laws_test {
namespace {

using testing::Heights;
using testing::Scatter;

RC_GTEST_PROP(point_squares, are_within_the_budget_and_the_bound, ()) {
  const auto scatter = *rc::gen::element(Scatter::kWhole, Scatter::kUtm, Scatter::kFloats, Scatter::kStreets);
  const auto heights = *rc::gen::element(Heights::kReal, Heights::kSteps);
  PointSet points =
      testing::random_points(*rc::gen::arbitrary<std::uint32_t>(), *rc::gen::inRange(4, 150), scatter, heights);
  std::vector<float> tolerances(points.size());
  for (float& tolerance : tolerances) tolerance = *rc::gen::element(0.1f, 2.0f, 9.0f);
  PointOptions options{.float32_positions = *rc::gen::arbitrary<bool>()};
  if (*rc::gen::arbitrary<bool>()) options.max_error = *rc::gen::element(0.5, 4.0, 20.0);
  if (options.max_error && *rc::gen::arbitrary<bool>()) options.tolerances = tolerances;
  (*rc::gen::arbitrary<bool>() ? options.max_triangles : options.max_vertices) =
      *rc::gen::inRange<std::uint64_t>(4, 120);
  options.quality.effort = Effort::kFast;
  const auto fast = simplify_points(points, options);
  if (!fast) RC_DISCARD("no surface, or a budget too small");
  options.objective = Objective::kRms;
  options.quality.effort = *rc::gen::element(Effort::kAuto, Effort::kNormal, Effort::kHigh);
  options.run.threads = *rc::gen::element(1, 3);
  const auto made = simplify_points(points, options);
  RC_ASSERT(made.has_value());
  const Simplified& simplified = made->simplified;
  RC_ASSERT(simplified.mesh.triangle_count() <= options.max_triangles.value_or(simplified.mesh.triangle_count()));
  RC_ASSERT(simplified.mesh.vertex_count() <= options.max_vertices.value_or(simplified.mesh.vertex_count()));
  const int missed = testing::judge_by_brute_force(points, simplified.mesh).first;
  RC_ASSERT(missed == 0 || options.float32_positions);
  const auto judged = *measure_points(points, simplified.mesh, DuplicatePolicy::kFirst, {});
  RC_ASSERT(judged.is_sound());
  RC_ASSERT(std::abs(judged.rmse - simplified.measurement.rmse) <= 1e-9 * (1 + judged.rmse));
  if (simplified.stop == StopReason::kMaxError && options.tolerances.empty())
    RC_ASSERT(judged.max_error <= *options.max_error + 1e-9);
  options.run.threads = 2;
  RC_ASSERT(simplify_points(points, options)->simplified.mesh.positions == simplified.mesh.positions);
}

PointSet hills(int count) {
  PointSet points = testing::random_points(7, count, Scatter::kUtm, Heights::kReal);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = points.x[i] - 500000, y = points.y[i] - 4649000;
    points.z[i] = 40 * std::sin(0.01 * x) * std::cos(0.014 * y) + 10 * std::sin(0.04 * x + 0.026 * y);
  }
  return points;
}

TEST(point_squares, fall_against_the_mesh_of_the_least_max_error) {
  const PointSet points = hills(testing::kIsSanitized ? 3000 : 20000);
  PointOptions options{.max_triangles = 600};
  for (const auto& [effort, share] : {std::pair{Effort::kNormal, 0.95}, {Effort::kHigh, 0.93}}) {
    options.quality.effort = effort;
    options.objective = Objective::kMax;
    const auto max = simplify_points(points, options)->simplified;
    options.objective = Objective::kRms;
    const auto rms = simplify_points(points, options)->simplified;
    EXPECT_LE(rms.mesh.triangle_count(), 600u);
    EXPECT_LT(rms.measurement.rmse, share * max.measurement.rmse);
    EXPECT_EQ(rms.stop, StopReason::kMaxTriangles);
  }
}

TEST(point_squares, stay_within_a_max_error_for_which_the_budget_has_room) {
  const PointSet points = hills(testing::fewer(6000, 4));
  PointOptions options{.max_triangles = 500};
  for (const Effort effort : {Effort::kNormal, Effort::kHigh}) {
    if (testing::kIsSanitized && effort == Effort::kHigh) continue;
    options.quality.effort = effort;
    options.objective = Objective::kMax;
    options.max_error = std::nullopt;
    options.max_error = 1.05 * simplify_points(points, options)->simplified.measurement.max_error;
    EXPECT_EQ(simplify_points(points, options)->simplified.stop, StopReason::kMaxError);
    options.objective = Objective::kRms;
    const auto made = simplify_points(points, options)->simplified;
    EXPECT_EQ(made.stop, StopReason::kMaxError);
    EXPECT_LE(made.measurement.max_error, *options.max_error);
    EXPECT_LE(made.mesh.triangle_count(), 500u);
  }
}

TEST(point_squares, need_a_budget_and_more_than_fast_effort) {
  const PointSet points = hills(20);
  PointOptions options{.max_error = 1, .objective = Objective::kRms};
  EXPECT_EQ(simplify_points(points, options).error().message, "the objective rms needs max_triangles or max_vertices");
  options.max_triangles = 30;
  options.quality.effort = Effort::kFast;
  EXPECT_EQ(simplify_points(points, options).error().message, "the objective rms needs more than fast effort");
}

}  // namespace
}  // namespace scarp::point_squares_laws_test
