// Laws of the public interface: goals, budgets, nodata, frames, determinism.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "laws/any_field.h"
#include "laws/fields.h"
#include "laws/sanitized.h"
#include "scarp/io.h"
#include "scarp/simplify.h"

namespace scarp::simplify_laws_test {
namespace {

using testing::any_field;
using testing::Field;
using testing::Relief;

Measurement judge(const HeightField& field, const Mesh& mesh) { return *measure(field, mesh); }

RC_GTEST_PROP(simplify, keeps_the_promise_in_the_eyes_of_the_judge, ()) {
  const Field field = any_field(40);
  const double goal = *rc::gen::element(0.0, 0.5, 1.0, 3.0, 20.0);
  const auto result = simplify(field.view(), {.goals = {.max_error = goal}});
  RC_PRE(result.has_value() || result.error().kind != ErrorKind::kInput);
  RC_ASSERT(result.has_value());
  const Measurement m = judge(field.view(), result->mesh);
  RC_ASSERT(m.max_error <= goal + 1e-9);
  if (goal == 0) RC_ASSERT(m.max_error <= 1e-9);
  RC_ASSERT(m.uncovered == 0u);
  RC_ASSERT(m.nodata_cells_covered == 0u);
  RC_ASSERT(m.is_sound());
  RC_ASSERT(result->stop == StopReason::kMaxError);
  RC_ASSERT(m.max_error == result->measurement.max_error);
}

RC_GTEST_PROP(simplify, budgets_are_upper_bounds, ()) {
  const Field field = any_field(30);
  const auto budget = *rc::gen::inRange<std::uint64_t>(4, 500);
  const bool count_triangles = *rc::gen::arbitrary<bool>();
  SimplifyOptions options;
  (count_triangles ? options.goals.max_triangles : options.goals.max_vertices) = budget;
  const auto result = simplify(field.view(), options);
  if (!result) {
    RC_ASSERT(result.error().kind == ErrorKind::kInput || result.error().kind == ErrorKind::kUsage);
    return;
  }
  RC_ASSERT((count_triangles ? result->mesh.triangle_count() : result->mesh.vertex_count()) <= budget);
  RC_ASSERT(judge(field.view(), result->mesh).uncovered == 0u);
}

TEST(simplify, a_budget_takes_the_best_of_the_last_stretch_not_a_spike) {
  const Field field = testing::random_field(11, 120, 90, Relief::kRidges);
  for (const std::uint64_t budget : {200u, 333u, 500u, 777u}) {
    const auto result =
        simplify(field.view(), {.goals = {.max_vertices = budget}, .quality = {.effort = Effort::kFast}});
    ASSERT_TRUE(result);
    Refiner refiner = *Refiner::create(field.view());
    double best = std::numeric_limits<double>::infinity();
    while (refiner.vertex_count() < budget && refiner.insert_worst()) {
      if (static_cast<double>(refiner.vertex_count()) >= 0.95 * static_cast<double>(budget))
        best = std::min(best, refiner.max_error());
    }
    EXPECT_NEAR(result->measurement.max_error, best, 1e-9) << budget;
    EXPECT_EQ(result->stop, StopReason::kMaxVertices);
  }
}

TEST(simplify, the_first_goal_that_is_reached_ends_the_run) {
  const Field field = testing::random_field(3, 60, 60, Relief::kRidges);
  EXPECT_EQ(simplify(field.view(), {.max_error = 30.0, .max_vertices = 100000})->stop, StopReason::kMaxError);
  EXPECT_EQ(simplify(field.view(), {.max_error = 0.01, .max_vertices = 100})->stop, StopReason::kMaxVertices);
  EXPECT_EQ(simplify(field.view(), {.max_error = 0.01, .max_triangles = 100})->stop, StopReason::kMaxTriangles);
  EXPECT_EQ(simplify(field.view(), {.max_vertices = 100000})->stop, StopReason::kExact);
}

TEST(simplify, refuses_goals_that_make_no_sense) {
  const Field field = testing::random_field(3, 9, 9, Relief::kReal);
  const auto kind = [&](const SimplifyOptions& options) { return simplify(field.view(), options).error().kind; };
  EXPECT_EQ(kind({}), ErrorKind::kUsage);
  EXPECT_EQ(kind({.goals = {.max_error = -1.0}}), ErrorKind::kUsage);
  EXPECT_EQ(kind({.goals = {.max_error = std::nan("")}}), ErrorKind::kUsage);
  EXPECT_EQ(kind({.goals = {.max_error = std::numeric_limits<double>::infinity()}}), ErrorKind::kUsage);
  EXPECT_EQ(kind({.goals = {.max_vertices = 3}}), ErrorKind::kUsage);
  EXPECT_EQ(kind({.goals = {.max_triangles = 1}}), ErrorKind::kUsage);
  SimplifyOptions negative_tolerance{.goals = {.max_error = 1.0}};
  negative_tolerance.domain.outline_tolerance = -1;
  EXPECT_EQ(kind(negative_tolerance), ErrorKind::kUsage);
}

TEST(simplify, refuses_fields_without_a_surface) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> samples{1, nan, nan, 2};
  const HeightField diagonal{samples.data(), 2, 2};
  EXPECT_EQ(simplify(diagonal, {.max_error = 1.0}).error().kind, ErrorKind::kInput);
  EXPECT_EQ(simplify({samples.data(), 4, 1}, {.max_error = 1.0}).error().kind, ErrorKind::kInput);
  EXPECT_EQ(simplify({nullptr, 4, 4}, {.max_error = 1.0}).error().kind, ErrorKind::kInput);
}

TEST(simplify, three_valid_corners_make_one_triangle) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> samples{1, 2, 3, nan};
  const auto result = simplify({samples.data(), 2, 2}, {.goals = {.max_error = 0.0}});
  ASSERT_TRUE(result);
  EXPECT_EQ(result->mesh.triangle_count(), 1u);
  EXPECT_EQ(result->mesh.vertex_count(), 3u);
}

TEST(simplify, nodata_and_infinities_are_never_heights) {
  Field field = testing::random_field(5, 30, 30, Relief::kRidges);
  Field nodata = field;
  for (const std::size_t k : {0u, 29u, 333u, 334u, 500u}) {
    field.samples[k] = k % 2 ? -9999.0f : std::numeric_limits<float>::infinity();
    nodata.samples[k] = std::numeric_limits<float>::quiet_NaN();
  }
  HeightField declared = field.view();
  declared.nodata = -9999.0f;
  const auto a = simplify(declared, {.goals = {.max_error = 2.0}}),
             b = simplify(nodata.view(), {.goals = {.max_error = 2.0}});
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->mesh.positions, b->mesh.positions);
  EXPECT_EQ(a->mesh.triangles, b->mesh.triangles);
  for (std::size_t v = 0; v < a->mesh.vertex_count(); ++v) EXPECT_LT(std::abs(a->mesh.vertex(v)[2]), 1000);
}

TEST(simplify, heights_times_a_power_of_two_give_the_same_triangles) {
  Field field = testing::random_field(6, 50, 40, Relief::kRidges, 0.1);
  const auto one = simplify(field.view(), {.goals = {.max_error = 3.0}});
  for (float& z : field.samples) z *= 1024;
  const auto two = simplify(field.view(), {.goals = {.max_error = 3.0 * 1024}});
  ASSERT_TRUE(one && two);
  EXPECT_EQ(one->mesh.triangles, two->mesh.triangles);
}

// Without ties in height, the rule cannot prefer rows: a transposed raster has the same first vertices.
TEST(simplify, the_first_vertices_do_not_depend_on_transposition) {
  const Field field = testing::random_field(8, 24, 31, Relief::kReal);
  Field transposed{31, 24, std::vector<float>(field.samples.size())};
  for (std::size_t y = 0; y < 31; ++y)
    for (std::size_t x = 0; x < 24; ++x) transposed.samples[31 * x + y] = field.samples[24 * y + x];
  Refiner a = *Refiner::create(field.view()), b = *Refiner::create(transposed.view());
  EXPECT_EQ(a.max_error(), b.max_error());
  a.insert_worst(), b.insert_worst();
  const Mesh p = a.mesh(), q = b.mesh();
  ASSERT_EQ(p.vertex_count(), 5u);
  EXPECT_EQ(p.positions[14], q.positions[14]);
}

TEST(simplify, threads_and_repetition_never_change_a_bit) {
  const Field field = testing::random_field(9, 150, 130, Relief::kRidges, 0.05);
  const auto first = simplify(field.view(), {.goals = {.max_error = 2.0}, .run = {.threads = 1}});
  for (const int threads : {1, 2, 7}) {
    const auto again = simplify(field.view(), {.goals = {.max_error = 2.0}, .run = {.threads = threads}});
    EXPECT_EQ(again->mesh.positions, first->mesh.positions);
    EXPECT_EQ(again->mesh.triangles, first->mesh.triangles);
    EXPECT_EQ(again->measurement.rmse, first->measurement.rmse);
    EXPECT_EQ(again->measurement.max_error, first->measurement.max_error);
  }
}

RC_GTEST_PROP(simplify, both_orders_keep_the_promise_and_threads_change_neither, ()) {
  const Field field = any_field(60);
  SimplifyOptions options{.goals = {.max_error = *rc::gen::element(0.0, 0.5, 3.0, 20.0)}};
  options.quality.order = *rc::gen::element(Order::kDominant, Order::kGreedy);
  options.run.threads = 1;
  const auto first = simplify(field.view(), options);
  RC_PRE(first.has_value() || first.error().kind != ErrorKind::kInput);
  RC_ASSERT(first.has_value());
  RC_ASSERT(first->order == options.quality.order);
  RC_ASSERT(first->measurement.max_error <= *options.goals.max_error);
  for (const int threads : {2, 3, 8}) {
    options.run.threads = threads;
    const auto again = simplify(field.view(), options);
    RC_ASSERT(again.has_value());
    RC_ASSERT(again->mesh.positions == first->mesh.positions);
    RC_ASSERT(again->mesh.triangles == first->mesh.triangles);
    RC_ASSERT(again->work.samples_scanned == first->work.samples_scanned);
  }
}

TEST(simplify, takes_the_dominant_order_towards_an_error_and_the_greedy_one_within_a_budget) {
  const Field field = testing::random_field(9, 40, 30, Relief::kRidges);
  const auto order = [&](SimplifyOptions options) {
    options.quality.effort = Effort::kFast;
    return simplify(field.view(), options)->order;
  };
  EXPECT_EQ(order({.goals = {.max_error = 2.0}}), Order::kDominant);
  EXPECT_EQ(order({.goals = {.max_vertices = 50}}), Order::kGreedy);
  EXPECT_EQ(order({.goals = {.max_error = 2.0, .max_vertices = 50}}), Order::kGreedy);
}

TEST(simplify, is_cancelled_by_its_callback) {
  const Field field = testing::random_field(10, 700, 700, Relief::kReal);
  SimplifyOptions options{.goals = {.max_error = 0.0}};
  options.run.progress = [](const Progress&) { return false; };
  const auto result = simplify(field.view(), options);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, ErrorKind::kCancelled);
}

TEST(simplify, long_rasters_are_exact_beyond_the_limits_of_32_bits) {
  for (const std::int32_t cols : {29700, 46400, 70000}) {
    Field field{cols, 3, std::vector<float>(static_cast<std::size_t>(cols) * 3)};
    for (std::int32_t x = 0; x < cols; ++x)
      for (std::int32_t y = 0; y < 3; ++y)
        field.samples[static_cast<std::size_t>(y) * static_cast<std::size_t>(cols) + static_cast<std::size_t>(x)] =
            static_cast<float>((x / 900) % 2 ? x % 900 : 900 - x % 900) + static_cast<float>(y);
    const auto result = simplify(field.view(), {.goals = {.max_error = 1.0}});
    ASSERT_TRUE(result) << result.error().message;
    const Measurement m = judge(field.view(), result->mesh);
    EXPECT_LE(m.max_error, 1.0 + 1e-9);
    EXPECT_TRUE(m.is_sound());
    EXPECT_LT(result->mesh.triangle_count(), 1500u);
  }
}

/// A frame whose cells have no exact float32 offsets.
HeightField odd_cells(const Field& field, double cell) {
  HeightField view = field.view();
  view.frame.kind = Frame::Kind::kSource;
  view.frame.affine = {4321987.123, cell, 0, 5123456.789, 0, -cell};
  return view;
}

TEST(simplify, rounded_positions_keep_the_promise_too) {
  const Field field = testing::random_field(12, testing::fewer(300), testing::fewer(200), Relief::kRidges, 0.02);
  const HeightField view = odd_cells(field, 6.7218131);
  ASSERT_FALSE(offsets_are_exact(view.frame, view.cols, view.rows));
  for (const double goal : {0.05, 1.0, 10.0}) {
    const auto result = simplify(view, {.goals = {.max_error = goal}});
    ASSERT_TRUE(result) << result.error().message;
    const Measurement m = judge(view, result->mesh);
    EXPECT_LE(m.max_error, goal);
    EXPECT_EQ(m.uncovered, 0u);
  }
}

TEST(simplify, double_positions_reproduce_every_sample_at_any_cell_size) {
  const Field field = testing::random_field(12, 100, 80, Relief::kRidges, 0.02);
  SimplifyOptions options{.goals = {.max_error = 0.0}};
  options.output.float32_positions = false;
  const auto result = simplify(odd_cells(field, 6.7218131), options);
  ASSERT_TRUE(result) << result.error().message;
  for (const MeshFormatTraits* traits : mesh_formats()) {
    if (!traits->is_read || traits->is_float32) continue;
    const Mesh read = *decode_mesh(*encode_mesh(result->mesh, traits->format), "mesh");
    const Measurement m = judge(odd_cells(field, 6.7218131), read);
    EXPECT_LE(m.max_error, 1e-9) << traits->name;
    EXPECT_EQ(m.uncovered, 0u) << traits->name;
  }
}

TEST(simplify, a_bound_below_what_rounding_costs_is_refused_with_the_figure) {
  const Field field = testing::random_field(12, testing::fewer(300), testing::fewer(200), Relief::kRidges);
  const auto result = simplify(odd_cells(field, 6.7218131), {.goals = {.max_error = 1e-9}});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, ErrorKind::kPromise);
  EXPECT_NE(result.error().message.find("float32"), std::string::npos);
}

TEST(simplify, rotated_and_south_up_frames_face_up) {
  const Field field = testing::random_field(13, 40, 50, Relief::kRidges);
  for (const std::array<double, 6> affine :
       {std::array<double, 6>{100, 0.5, 0.25, -7, 0.25, -0.5}, {100, 2, 0, -7, 0, 2}, {0, 0, 3, 0, 3, 0}}) {
    HeightField view = field.view();
    view.frame.affine = affine;
    const auto result = simplify(view, {.goals = {.max_error = 2.0}});
    ASSERT_TRUE(result);
    const Measurement m = judge(view, result->mesh);
    EXPECT_EQ(m.down_facing, 0u);
    EXPECT_TRUE(m.is_sound());
    EXPECT_LE(m.max_error, 2.0 + 1e-9);
  }
}

/// A pseudo-projection: bends straight lines, preserves orientation.
class Bend : public PointTransform {
 public:
  bool apply(std::span<double> x, std::span<double> y) const override {
    for (std::size_t k = 0; k < x.size(); ++k) {
      const double u = x[k], v = y[k];
      x[k] = 10 * u + 1e-3 * v * v;
      y[k] = 10 * v - 2e-3 * u * u + 1e-3 * u * v;
    }
    return true;
  }
};

TEST(simplify, a_curved_frame_keeps_the_promise_and_covers_its_border) {
  const Field field = testing::random_field(14, 220, 160, Relief::kRidges, 0.02);
  HeightField view = field.view();
  view.frame.kind = Frame::Kind::kProjected;
  view.frame.transform = std::make_shared<Bend>();
  for (const double goal : {1.0, 15.0}) {
    const auto result = simplify(view, {.goals = {.max_error = goal}});
    ASSERT_TRUE(result) << result.error().message;
    const Measurement m = judge(view, result->mesh);
    EXPECT_LE(m.max_error, goal);
    EXPECT_EQ(m.uncovered, 0u);
    EXPECT_TRUE(m.is_sound());
  }
}

HeightField bent(const Field& field) {
  HeightField view = field.view();
  view.frame.kind = Frame::Kind::kProjected;
  view.frame.transform = std::make_shared<Bend>();
  return view;
}

TEST(simplify, budgets_hold_where_the_judge_asks_for_more_vertices) {
  const Field field = testing::random_field(16, 120, 90, Relief::kRidges);
  const auto free_run = simplify(bent(field), {.goals = {.max_error = 12.0}});
  ASSERT_TRUE(free_run);
  const std::uint64_t triangles = free_run->mesh.triangle_count();
  constexpr std::uint64_t kStep = testing::kIsSanitized ? 32 : 3;
  for (std::uint64_t budget = triangles - 60; budget < triangles + 4; budget += kStep) {
    const auto result = simplify(bent(field), {.goals = {.max_error = 12.0, .max_triangles = budget}});
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_LE(result->mesh.triangle_count(), budget);
    if (result->stop == StopReason::kMaxError) {
      EXPECT_LE(result->measurement.max_error, 12.0);
    }
  }
}

TEST(simplify, a_simplified_outline_in_a_curved_frame_has_no_nodata_vertices) {
  Field field = testing::random_field(17, 90, 90, Relief::kRidges);
  for (std::int32_t y = 0; y < 90; ++y)
    for (std::int32_t x = 0; x < 90; ++x)
      if (3 * x + y % 3 > 200 - y) field.samples[static_cast<std::size_t>(90 * y + x)] = std::nanf("");
  const auto result = simplify(bent(field), {.goals = {.max_error = 10.0}, .domain = {.outline_tolerance = 2.0}});
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(judge(bent(field), result->mesh).uncovered, 0u);
}

TEST(simplify, the_best_prefix_may_be_the_outline_alone) {
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    const Field field = testing::random_field(seed, 20, 20, Relief::kReal, 0.3);
    Refiner refiner = *Refiner::create(field.view());
    const std::uint64_t seeds = refiner.vertex_count();
    const double outline_error = refiner.max_error();
    if (!refiner.insert_worst()) continue;
    const auto result =
        simplify(field.view(), {.goals = {.max_vertices = seeds + 1}, .quality = {.effort = Effort::kFast}});
    ASSERT_TRUE(result);
    EXPECT_NEAR(result->measurement.max_error, std::min(outline_error, refiner.max_error()), 1e-9) << seed;
  }
}

TEST(simplify, a_level_plane_is_judged_exactly) {
  // 2^24 − (−10⁻¹⁰) is more than 2^24, but not in double.
  std::vector<float> samples(9, 16777216.0f);
  samples[4] = -1e-10f;
  const auto result = simplify({samples.data(), 3, 3}, {.goals = {.max_error = 16777216.0}});
  ASSERT_TRUE(result);
  EXPECT_EQ(result->mesh.vertex_count(), 5u);
}

TEST(simplify, values_that_were_rounded_keep_their_reserve) {
  const Field field = testing::random_field(18, 60, 60, Relief::kRidges);
  HeightField view = field.view();
  view.sample_rounding = 0.25;
  const auto result = simplify(view, {.goals = {.max_error = 2.0}});
  ASSERT_TRUE(result);
  EXPECT_LE(result->measurement.max_error, 1.75);
  EXPECT_EQ(simplify(view, {.max_error = 0.2}).error().kind, ErrorKind::kPromise);
}

TEST(simplify, normals_are_those_of_the_samples) {
  Field field{20, 20, std::vector<float>(400)};
  for (std::size_t y = 0; y < 20; ++y)
    for (std::size_t x = 0; x < 20; ++x) field.samples[20 * y + x] = static_cast<float>(0.75 * static_cast<double>(x));
  const auto result = simplify(field.view(), {.goals = {.max_error = 1.0}, .output = {.normals = true}});
  ASSERT_TRUE(result);
  ASSERT_EQ(result->mesh.normals.size(), 3 * result->mesh.vertex_count());
  for (std::size_t v = 0; v < result->mesh.vertex_count(); ++v) {
    EXPECT_NEAR(result->mesh.normals[3 * v], -0.6, 1e-6);
    EXPECT_NEAR(result->mesh.normals[3 * v + 1], 0, 1e-6);
    EXPECT_NEAR(result->mesh.normals[3 * v + 2], 0.8, 1e-6);
  }
}

TEST(simplify, a_simplified_outline_loses_no_sample) {
  // Smooth terrain, so that the outline causes the triangles.
  Field field = testing::random_field(15, 80, 80, Relief::kRidges, 0.3);
  for (std::size_t k = 0; k < field.samples.size(); ++k) {
    if (!std::isnan(field.samples[k])) field.samples[k] = static_cast<float>(k % 80) / 4;
  }
  const auto exact = simplify(field.view(), {.goals = {.max_error = 5.0}}),
             loose = simplify(field.view(), {.goals = {.max_error = 5.0}, .domain = {.outline_tolerance = 2.0}});
  ASSERT_TRUE(exact && loose);
  const Measurement m = judge(field.view(), loose->mesh);
  EXPECT_EQ(m.uncovered, 0u);
  EXPECT_LE(m.max_error, 5.0 + 1e-9);
  EXPECT_LT(loose->mesh.triangle_count(), exact->mesh.triangle_count());
}

TEST(simplify, scattered_missing_samples_close_within_the_outline_tolerance) {
  Field field{60, 60, std::vector<float>(3600, 7.0f)};
  for (const std::size_t k : {605u, 1330u, 1331u, 2222u, 3000u}) field.samples[k] = std::nanf("");
  const auto result = simplify(field.view(), {.goals = {.max_error = 1.0}, .domain = {.outline_tolerance = 1.0}});
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(result->mesh.triangle_count(), 2u);
  EXPECT_EQ(judge(field.view(), result->mesh).uncovered, 0u);
}

TEST(simplify, what_an_outline_tolerance_of_one_would_take_is_what_it_takes) {
  Field field = testing::random_field(16, 80, 80, Relief::kRidges, 0.3);
  for (std::size_t k = 0; k < field.samples.size(); ++k) {
    if (!std::isnan(field.samples[k])) field.samples[k] = static_cast<float>(k % 80) / 4;
  }
  const auto exact = simplify(field.view(), {.goals = {.max_error = 5.0}}),
             loose = simplify(field.view(), {.goals = {.max_error = 5.0}, .domain = {.outline_tolerance = 1.0}}),
             fine = simplify(testing::random_field(16, 80, 80, Relief::kRidges, 0.01).view(), {.max_error = 0.01});
  ASSERT_TRUE(exact && loose && fine);
  EXPECT_GT(exact->outline_triangles, 0u);
  EXPECT_EQ(exact->outline_triangles_at_one, loose->outline_triangles);
  EXPECT_LT(loose->outline_triangles, exact->outline_triangles);
  EXPECT_EQ(loose->outline_triangles_at_one, 0u);
  EXPECT_GT(fine->outline_triangles, 0u);
  EXPECT_EQ(fine->outline_triangles_at_one, 0u) << "the outline is a small part of the mesh";
}

}  // namespace
}  // namespace scarp::simplify_laws_test
