// Budgets with individual bounds of samples: sufficient budgets satisfy the bounds; otherwise every sample satisfies
// its bound times one factor.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "laws/any_field.h"
#include "laws/any_lines.h"
#include "laws/array_bounds.h"
#include "laws/array_source.h"
#include "laws/budgets.h"
#include "laws/fields.h"
#include "scarp/simplify.h"

namespace scarp::tolerance_budget_laws_test {
namespace {

using testing::any_field;
using testing::ArrayBounds;
using testing::ArraySource;
using testing::Field;
using testing::hills;
using testing::is_within;
using testing::kNoBound;
using testing::with_source;

/// Samples with tolerances and a budget, in memory or streamed, with lines or without.
struct Scene {
  Field field = any_field(30);
  std::vector<float> bounds = testing::any_bounds(field.cols, field.rows);
  ArraySource source{field.view()};
  ArrayBounds tolerances{bounds, field.cols};
  bool is_streamed = *rc::gen::arbitrary<bool>();
  SimplifyOptions options;

  Scene() {
    const auto budget = *rc::gen::inRange<std::uint64_t>(2, 500);
    if (*rc::gen::arbitrary<bool>()) options.goals.max_vertices = budget;
    if (!options.goals.max_vertices || *rc::gen::arbitrary<bool>()) options.goals.max_triangles = 2 * budget;
    options.goals.max_error = *rc::gen::element<std::optional<double>>(std::nullopt, std::nullopt, 0.0, 1.0, 30.0);
    if (is_streamed) options.tolerances.source = &tolerances;
    if (!is_streamed) options.tolerances.values = bounds;
    const int kind = *rc::gen::inRange(0, 4);
    if (kind == 0) options.features.breaklines = testing::any_lines(field);
    if (kind == 1) options.quality.shape.min_angle = 15;
    if (kind == 2) options.quality.order = Order::kDominant;
    options.quality.effort = *rc::gen::element(Effort::kAuto, Effort::kFast, Effort::kNormal, Effort::kHigh);
    if (options.quality.effort != Effort::kFast)
      options.goals.objective = *rc::gen::element(Objective::kMax, Objective::kRms);
  }
  Scene(const Scene&) = delete;

  HeightField view() const { return is_streamed ? with_source(field.view(), source) : field.view(); }
};

Field edited(Field field, const Simplified& made) {
  for (const SampleEdit& edit : made.edits)
    field.samples[static_cast<std::size_t>(edit.row) * static_cast<std::size_t>(field.cols) +
                  static_cast<std::size_t>(edit.col)] = edit.after;
  return field;
}

/// Checks independently of how the mesh was made.
void expect_kept(const Scene& scene, const Simplified& made) {
  RC_ASSERT(is_within(made, scene.options));
  RC_ASSERT(made.tolerance_factor >= 1);
  if (made.stop == StopReason::kMaxError) RC_ASSERT(made.tolerance_factor == 1);
  std::vector<float> kept = scene.bounds;
  for (float& bound : kept) {
    const double asked = std::min(double{bound}, scene.options.goals.max_error.value_or(HUGE_VAL));
    // A tolerance of 0 that no factor can satisfy is reported as an infinite factor.
    const double least =
        std::isinf(asked) || std::isinf(made.tolerance_factor) ? HUGE_VAL : made.tolerance_factor * asked;
    bound = static_cast<float>(least * (1 + 1e-7) + 1e-9);
  }
  MeasureOptions judge;
  judge.tolerance = kept;
  const Field land = edited(scene.field, made);
  const Measurement seen = *measure(land.view(), made.mesh, judge);
  RC_ASSERT(seen.over_tolerance == 0u);
  RC_ASSERT(seen.uncovered == 0u);
  RC_ASSERT(seen.is_sound());
  RC_ASSERT(seen.max_error == made.measurement.max_error);
}

RC_GTEST_PROP(tolerance_budget, is_kept_and_its_factor_is_true_of_every_sample, ()) {
  const Scene scene;
  const auto made = simplify(scene.view(), scene.options);
  if (!made) {
    RC_ASSERT(made.error().kind == ErrorKind::kInput || made.error().kind == ErrorKind::kUsage);
    return;
  }
  expect_kept(scene, *made);
}

RC_GTEST_PROP(tolerance_budget, effort_is_never_worse_than_insertion, ()) {
  Scene scene;
  const auto asked = scene.options;
  scene.options.quality.effort = Effort::kFast;
  scene.options.goals.objective = Objective::kMax;
  const auto fast = simplify(scene.view(), scene.options);
  scene.options = asked;
  if (asked.quality.effort == Effort::kFast) scene.options.quality.effort = Effort::kNormal;
  const auto made = simplify(scene.view(), scene.options);
  RC_ASSERT(made.has_value() == fast.has_value());
  if (!made) {
    RC_ASSERT(made.error().message == fast.error().message);
    return;
  }
  if (fast->stop == StopReason::kMaxError) {
    RC_ASSERT(made->stop == StopReason::kMaxError);
    // For the squared error, bounds are only a cap, and the whole budget is useful, unless samples are streamed.
    const bool has_no_more = made->mesh.triangle_count() <= fast->mesh.triangle_count();
    const bool is_better =
        scene.options.goals.objective == Objective::kRms && made->judged_rmse <= fast->judged_rmse;
    RC_ASSERT(has_no_more || is_better);
  } else if (made->stop != StopReason::kMaxError && scene.options.goals.objective == Objective::kMax) {
    RC_ASSERT(made->judged_max_error <= fast->judged_max_error);
  } else if (made->stop != StopReason::kMaxError) {
    RC_ASSERT(made->judged_rmse <= fast->judged_rmse);
  }
}

RC_GTEST_PROP(tolerance_budget, threads_change_nothing, ()) {
  Scene scene;
  scene.options.run.threads = 1;
  const auto one = simplify(scene.view(), scene.options);
  scene.options.run.threads = 3;
  const auto three = simplify(scene.view(), scene.options);
  RC_ASSERT(one.has_value() == three.has_value());
  if (!one) {
    RC_ASSERT(one.error().message == three.error().message);
    return;
  }
  RC_ASSERT(one->mesh.positions == three->mesh.positions);
  RC_ASSERT(one->mesh.triangles == three->mesh.triangles);
  RC_ASSERT(one->tolerance_factor == three->tolerance_factor);
}

/// Smooth, with tolerances that grow from left to right, and none in a corner.
std::vector<float> rising_bounds() {
  std::vector<float> bounds;
  for (int k = 0; k < 200 * 150; ++k)
    bounds.push_back(k % 200 < 20 && k < 3000 ? kNoBound : 0.01f * static_cast<float>(1 + k % 200 / 10));
  return bounds;
}
struct Slope {
  Field field = hills(200, 150);
  std::vector<float> bounds = rising_bounds();
  ArraySource source{field.view()};
  ArrayBounds tolerances{bounds, 200};
};

TEST(tolerance_budget, is_used_and_effort_lowers_the_factor) {
  const Slope slope;
  for (const std::uint64_t budget : {500u, 3000u}) {
    SimplifyOptions options{.goals = {.max_triangles = budget}};
    options.tolerances.values = slope.bounds;
    double before = HUGE_VAL;
    for (const Effort effort : {Effort::kFast, Effort::kNormal, Effort::kHigh}) {
      options.quality.effort = effort;
      const auto made = simplify(slope.field.view(), options);
      ASSERT_TRUE(made) << made.error().message;
      EXPECT_LE(made->mesh.triangle_count(), budget);
      EXPECT_GE(made->mesh.triangle_count(), 97 * budget / 100);
      EXPECT_EQ(made->stop, StopReason::kMaxTriangles);
      EXPECT_GT(made->tolerance_factor, 1);
      EXPECT_LT(made->tolerance_factor, 0.9 * before);
      EXPECT_LE(made->weighted_max_error, made->tolerance_factor);
      before = made->tolerance_factor;
    }
  }
}

TEST(tolerance_budget, is_met_where_rows_come_one_after_the_other_and_beside_lines_and_shapes) {
  const Slope slope;
  SimplifyOptions options{.goals = {.max_triangles = 3000}};
  options.tolerances.values = slope.bounds;
  const double least = simplify(slope.field.view(), options)->tolerance_factor;
  Line line;
  line.points = {{10.3, 5.5, NAN}, {150.2, 120.7, NAN}, {190.4, 11.6, NAN}};
  for (const bool is_streamed : {false, true}) {
    if (is_streamed) options.tolerances.values = {}, options.tolerances.source = &slope.tolerances;
    const HeightField view = is_streamed ? with_source(slope.field.view(), slope.source) : slope.field.view();
    for (const int kind : {0, 1, 2}) {
      SimplifyOptions asked = options;
      asked.features.breaklines.affine = grid_frame(150).affine;
      if (kind == 1) asked.features.breaklines.lines = {line};
      if (kind == 2) asked.quality.shape.max_edge = 30;
      const auto made = simplify(view, asked);
      ASSERT_TRUE(made) << made.error().message;
      EXPECT_EQ(made->effort, Effort::kNormal);
      EXPECT_LE(made->mesh.triangle_count(), 3000u);
      EXPECT_GE(made->mesh.triangle_count(), 2910u);
      EXPECT_LE(made->tolerance_factor, 1.35 * least) << kind;
      if (kind == 1) {
        EXPECT_NEAR(made->lines_for / (made->tolerance_factor * double{0.2f}), 1, 1e-6);
      }
    }
  }
}

TEST(tolerance_budget, finds_the_mesh_of_the_multiplied_tolerances) {
  const Slope slope;
  SimplifyOptions options{.goals = {.max_triangles = 3000}, .quality = {.effort = Effort::kNormal}};
  options.tolerances.values = slope.bounds;
  options.goals.max_error = 0.15;
  const auto made = *simplify(slope.field.view(), options);
  ASSERT_EQ(made.stop, StopReason::kMaxTriangles);
  std::vector<float> multiplied = slope.bounds;
  for (float& bound : multiplied) {
    const double exact = made.tolerance_factor * bound;
    bound = static_cast<float>(exact);
    if (bound > exact) bound = std::nextafter(bound, 0.0f);
  }
  const auto again = *simplify(slope.field.view(), [&] {
    SimplifyOptions towards{.goals = {.max_error = 0.15 * made.tolerance_factor},
                            .quality = {.effort = Effort::kNormal}};
    towards.tolerances.values = multiplied;
    return towards;
  }());
  EXPECT_EQ(again.mesh.positions, made.mesh.positions);
  EXPECT_EQ(again.mesh.triangles, made.mesh.triangles);
}

TEST(tolerance_budget, that_has_room_for_the_tolerances_ends_with_them) {
  const Field field = testing::random_field(3, 60, 60, testing::Relief::kRidges);
  std::vector<float> bounds(3600, 30.0f);
  for (std::size_t k = 0; k < 600; ++k) bounds[k] = 15;
  SimplifyOptions options{.quality = {.effort = Effort::kHigh}};
  options.tolerances.values = bounds;
  const auto bounded = *simplify(field.view(), options);
  options.quality.effort = Effort::kFast;
  // Fewer triangles than insertion needs for the bounds, so that a search is necessary.
  const std::uint64_t budget = bounded.mesh.triangle_count() * 11 / 10;
  ASSERT_LT(budget, simplify(field.view(), options)->mesh.triangle_count());
  options.goals.max_triangles = budget;
  options.quality.effort = Effort::kHigh;
  const auto made = *simplify(field.view(), options);
  EXPECT_EQ(made.stop, StopReason::kMaxError);
  EXPECT_EQ(made.tolerance_factor, 1);
  EXPECT_EQ(made.mesh.positions, bounded.mesh.positions);
}

TEST(tolerance_budget, keeps_a_tolerance_of_0_where_there_is_room_and_tells_where_there_is_none) {
  const Field field = testing::random_field(9, 40, 40, testing::Relief::kRidges);
  std::vector<float> bounds(1600, 1.0f);
  for (std::size_t k = 0; k < 1600; ++k) bounds[k] = k % 40 < 12 && k / 40 < 12 ? 0.0f : 0.25f;
  SimplifyOptions options{.goals = {.max_triangles = 900}};
  options.tolerances.values = bounds;
  const auto made = *simplify(field.view(), options);
  EXPECT_EQ(made.stop, StopReason::kMaxTriangles);
  EXPECT_TRUE(std::isfinite(made.tolerance_factor));
  for (const Effort effort : {Effort::kFast, Effort::kNormal}) {
    options.goals.max_triangles = 60;
    options.quality.effort = effort;
    const auto few = *simplify(field.view(), options);
    EXPECT_LE(few.mesh.triangle_count(), 60u);
    EXPECT_TRUE(std::isinf(few.tolerance_factor));
  }
  const ArraySource source(field.view());
  const ArrayBounds tolerances(bounds, 40);
  options.tolerances.values = {};
  options.tolerances.source = &tolerances;
  const auto refused = simplify(with_source(field.view(), source), options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::kUsage);
  EXPECT_NE(refused.error().message.find("and the samples with a tolerance of 0 alone need"), std::string::npos)
      << refused.error().message;
}

TEST(tolerance_budget, judges_the_samples_with_a_bound) {
  Field field = hills(60, 50);
  SimplifyOptions options{.goals = {.max_triangles = 400}};
  const SampleAt ignored[] = {{20, 20}, {41, 30}, {7, 44}};
  for (const auto& [col, row] : ignored) field.samples[static_cast<std::size_t>(row * 60 + col)] += 5000;
  options.tolerances.ignored = ignored;
  options.quality.effort = Effort::kFast;
  const auto fast = *simplify(field.view(), options);
  options.quality.effort = Effort::kHigh;
  const auto high = *simplify(field.view(), options);
  options.goals.objective = Objective::kRms;
  const auto rms = *simplify(field.view(), options);
  for (const Simplified* made : {&fast, &high, &rms}) {
    EXPECT_LE(made->mesh.triangle_count(), 400u);
    EXPECT_GT(made->measurement.max_error, 4000);
    EXPECT_LT(made->judged_max_error, 60);
    EXPECT_EQ(made->tolerance_factor, 1);
  }
  EXPECT_LT(high.judged_max_error, 0.8 * fast.judged_max_error);
  EXPECT_LE(rms.judged_rmse, high.judged_rmse);
}

TEST(tolerance_budget, of_a_mask_is_met_beside_lines) {
  const Field field = hills(100, 80);
  std::vector<float> mask;
  for (std::size_t k = 0; k < field.samples.size(); ++k) mask.push_back(k % 100 < 50 ? 1.0f : 0.125f);
  SimplifyOptions options{.goals = {.max_triangles = 900}};
  options.tolerances.weights = mask;
  options.features.breaklines.affine = grid_frame(80).affine;
  Line line;
  line.points = {{10.3, 5.5, NAN}, {90.2, 70.7, NAN}};
  options.features.breaklines.lines = {line};
  double before = HUGE_VAL;
  for (const Effort effort : {Effort::kFast, Effort::kNormal}) {
    options.quality.effort = effort;
    const auto made = simplify(field.view(), options);
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_LE(made->mesh.triangle_count(), 900u);
    EXPECT_GE(made->mesh.triangle_count(), 873u);
    EXPECT_EQ(made->judged_max_error, made->weighted_max_error);
    EXPECT_LE(made->weighted_max_error, made->lines_for * (1 + 1e-6));
    EXPECT_LT(made->weighted_max_error, before);
    before = made->weighted_max_error;
  }
}

}  // namespace
}  // namespace scarp::tolerance_budget_laws_test
