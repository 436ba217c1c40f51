// Laws of efforts in the public interface: with all removals and moves, the guarantee is that of refinement.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>

#include "laws/any_field.h"
#include "laws/fields.h"
#include "laws/sanitized.h"
#include "scarp/io.h"
#include "scarp/simplify.h"

namespace scarp::effort_laws_test {
namespace {

using testing::any_field;
using testing::Field;
using testing::Relief;

SimplifyOptions with_effort(double max_error, Effort effort, Vertices vertices = Vertices::kAuto) {
  SimplifyOptions options;
  options.goals.max_error = max_error;
  options.quality.effort = effort;
  options.quality.vertices = vertices;
  return options;
}

/// A frame whose cells have no exact float32 offsets.
HeightField odd_cells(const Field& field) {
  HeightField view = field.view();
  view.frame.kind = Frame::Kind::kSource;
  view.frame.affine = {4321987.123, 6.7218131, 0, 5123456.789, 0, -6.7218131};
  return view;
}

RC_GTEST_PROP(effort, keeps_the_promise_in_the_eyes_of_the_judge, ()) {
  const Field field = any_field(40);
  const HeightField view = *rc::gen::arbitrary<bool>() ? field.view() : odd_cells(field);
  const double goal = *rc::gen::element(0.0, 0.5, 1.0, 3.0, 20.0);
  auto options = with_effort(goal, *rc::gen::element(Effort::kNormal, Effort::kHigh, Effort::kMax),
                             *rc::gen::element(Vertices::kAuto, Vertices::kSamples, Vertices::kFree));
  options.quality.order = *rc::gen::element(Order::kAuto, Order::kGreedy);
  options.output.float32_positions = *rc::gen::arbitrary<bool>();
  const auto result = simplify(view, options);
  if (!result) {
    RC_ASSERT(result.error().kind == ErrorKind::kInput || result.error().kind == ErrorKind::kPromise);
    RC_ASSERT(result.error().kind == ErrorKind::kInput ||
              ((goal == 0 || options.quality.vertices == Vertices::kFree) && options.output.float32_positions));
    return;
  }
  const Measurement m = *measure(view, result->mesh);
  RC_ASSERT(m.max_error <= goal + 1e-9);
  RC_ASSERT(m.uncovered == 0u);
  RC_ASSERT(m.nodata_cells_covered == 0u);
  RC_ASSERT(m.is_sound());
  RC_ASSERT(m.max_error == result->measurement.max_error);
}

TEST(effort, errors_that_equal_the_bound_are_kept_by_free_vertices_far_from_the_origin) {
  for (int seed = 0; seed < testing::fewer(40, 20); ++seed) {
    const Field field = testing::random_field(static_cast<std::uint32_t>(seed), 30, 25, Relief::kTies);
    const HeightField view = odd_cells(field);
    auto options = with_effort(1, seed % 2 == 0 ? Effort::kHigh : Effort::kMax);
    options.output.float32_positions = false;
    const auto result = simplify(view, options);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_EQ(result->vertices, Vertices::kFree);
    EXPECT_LE(measure(view, result->mesh)->max_error, 1 + 1e-11);
  }
}

RC_GTEST_PROP(effort, free_vertices_are_on_the_lattice_with_float32_heights, ()) {
  const Field field = any_field(40);
  const auto effort = *rc::gen::element(Effort::kAuto, Effort::kNormal, Effort::kHigh);
  const auto result = simplify(field.view(), with_effort(3, effort, Vertices::kFree));
  RC_PRE(result.has_value());
  RC_ASSERT(result->vertices == Vertices::kFree);
  const Mesh& mesh = result->mesh;
  for (const double p : mesh.positions) RC_ASSERT(static_cast<double>(static_cast<float>(p)) == p);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const double x = 8 * mesh.vertex(v)[0], y = 8 * mesh.vertex(v)[1];
    RC_ASSERT(x == std::round(x) && y == std::round(y));
  }
}

RC_GTEST_PROP(effort, vertices_on_samples_have_the_heights_of_samples, ()) {
  const Field field = any_field(40);
  const auto effort = *rc::gen::element(Effort::kNormal, Effort::kHigh);
  const auto result = simplify(field.view(), with_effort(2, effort, Vertices::kSamples));
  RC_PRE(result.has_value());
  RC_ASSERT(result->vertices == Vertices::kSamples);
  for (std::size_t v = 0; v < result->mesh.vertex_count(); ++v) {
    const auto [x, y, z] = result->mesh.vertex(v);
    const auto col = static_cast<std::size_t>(x), row = static_cast<std::size_t>(field.rows - 1 - y);
    RC_ASSERT(double{field.samples[row * static_cast<std::size_t>(field.cols) + col]} == z);
  }
}

// Energies of the fit overflow float32 for large heights.
RC_GTEST_PROP(effort, heights_of_any_magnitude_keep_the_promise, ()) {
  Field field{*rc::gen::inRange(2, 7), *rc::gen::inRange(2, 7), {}};
  double largest = 0;
  for (std::int32_t k = 0; k < field.cols * field.rows; ++k) {
    const double height = *rc::gen::inRange(-9, 10) * std::pow(10.0, *rc::gen::element(-20, 0, 23, 27, 30));
    field.samples.push_back(static_cast<float>(height));
    largest = std::max(largest, std::abs(height));
  }
  const double goal = std::pow(10.0, *rc::gen::inRange(-6, 24));
  const auto made = simplify(field.view(), with_effort(goal, *rc::gen::element(Effort::kNormal, Effort::kHigh)));
  if (made) RC_ASSERT(measure(field.view(), made->mesh)->max_error <= goal + 1e-12 * largest);
}

TEST(effort, hopeless_contrasts_end) {
  Field field{4, 4, {}};
  field.samples = {0, 2e23f, 1e23f, 0, 3e23f, 2e27f, 2e27f, 3e27f, 3e23f, 2e23f, 1e27f, 3e27f, 2e27f, 2e27f, 1e27f, 0};
  const auto made = simplify(field.view(), with_effort(1, Effort::kNormal));
  ASSERT_TRUE(made.has_value());
  EXPECT_LE(measure(field.view(), made->mesh)->max_error, 1);
}

TEST(effort, each_level_takes_fewer_triangles) {
  const Field field = testing::random_field(21, testing::fewer(210), testing::fewer(140), Relief::kRidges, 0.02);
  std::size_t before = SIZE_MAX;
  for (const auto& [effort, vertices] : {std::pair{Effort::kFast, Vertices::kSamples},
                                         {Effort::kNormal, Vertices::kSamples},
                                         {Effort::kHigh, Vertices::kSamples},
                                         {Effort::kHigh, Vertices::kFree},
                                         {Effort::kMax, Vertices::kFree}}) {
    auto options = with_effort(4, effort, vertices);
    if (effort != Effort::kFast) options.quality.min_shape = 0;  // like normal effort
    const auto result = simplify(field.view(), options);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_LT(result->mesh.triangle_count(), before);
    before = result->mesh.triangle_count();
  }
}

TEST(effort, rounded_positions_of_free_vertices_keep_the_promise_or_stay_on_samples) {
  const Field field = testing::random_field(22, testing::fewer(210), testing::fewer(140), Relief::kRidges, 0.02);
  const HeightField view = odd_cells(field);
  for (const double goal : {1e-3, 0.05, 1.0, 10.0}) {
    const auto result = simplify(view, with_effort(goal, Effort::kHigh));
    ASSERT_TRUE(result) << result.error().message;
    const Measurement m = *measure(view, result->mesh);
    EXPECT_LE(m.max_error, goal);
    EXPECT_EQ(m.uncovered, 0u);
    EXPECT_TRUE(m.is_sound());
    if (goal >= 1) {
      EXPECT_EQ(result->vertices, Vertices::kFree);
    }
  }
}

TEST(effort, normals_and_uvs_of_free_vertices_are_those_of_their_lattice_points) {
  Field field{60, 50, std::vector<float>(3000)};
  for (std::size_t y = 0; y < 50; ++y)
    for (std::size_t x = 0; x < 60; ++x)
      field.samples[60 * y + x] = static_cast<float>(0.75 * static_cast<double>(x)) + (x * y % 7 == 0 ? 0.01f : 0.0f);
  auto options = with_effort(0.02, Effort::kHigh, Vertices::kFree);
  options.output.normals = options.output.uvs = true;
  const auto result = simplify(field.view(), options);
  ASSERT_TRUE(result) << result.error().message;
  const Mesh& mesh = result->mesh;
  ASSERT_EQ(mesh.normals.size(), 3 * mesh.vertex_count());
  ASSERT_EQ(mesh.uvs.size(), 2 * mesh.vertex_count());
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    EXPECT_NEAR(mesh.normals[3 * v], -0.6, 0.02);
    EXPECT_NEAR(mesh.normals[3 * v + 2], 0.8, 0.02);
    EXPECT_NEAR(mesh.uvs[2 * v], (mesh.vertex(v)[0] + 0.5) / 60, 1e-6);
    EXPECT_NEAR(mesh.uvs[2 * v + 1], (49 - mesh.vertex(v)[1] + 0.5) / 50, 1e-6);
  }
}

TEST(effort, free_vertices_survive_every_format) {
  const Field field = testing::random_field(23, 120, 90, Relief::kRidges, 0.02);
  const auto result = simplify(field.view(), with_effort(4, Effort::kHigh, Vertices::kFree));
  ASSERT_TRUE(result) << result.error().message;
  for (const MeshFormatTraits* traits : mesh_formats()) {
    if (!traits->is_read || traits->holds_solids_only) continue;
    const auto read = decode_mesh(*encode_mesh(result->mesh, traits->format), "mesh");
    ASSERT_TRUE(read) << read.error().message;
    const Measurement m = *measure(field.view(), *read);
    EXPECT_LE(m.max_error, 4 + 1e-9) << traits->name;
    EXPECT_EQ(m.uncovered, 0u) << traits->name;
  }
}

TEST(effort, threads_change_nothing) {
  const Field field = testing::random_field(24, testing::fewer(320), testing::fewer(240), Relief::kRidges, 0.02);
  std::optional<Mesh> first;
  for (const int threads : {1, 2, 5}) {
    if (testing::kIsSanitized && threads == 2) continue;
    auto options = with_effort(1, Effort::kHigh);
    options.run.threads = threads;
    const auto result = simplify(field.view(), options);
    ASSERT_TRUE(result);
    if (!first) first = result->mesh;
    EXPECT_EQ(first->positions, result->mesh.positions);
    EXPECT_EQ(first->triangles, result->mesh.triangles);
  }
}

TEST(effort, a_run_whose_time_is_up_keeps_the_promise) {
  const Field field = testing::random_field(26, 200, 150, Relief::kRidges, 0.02);
  for (const int questions : {0, 1, 40, 1000}) {
    std::atomic<int> asked = 0;
    auto options = with_effort(2, Effort::kMax);
    options.run.is_time_up = [&] { return asked++ >= questions; };
    const auto result = simplify(field.view(), options);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_TRUE(result->is_cut_short || questions == 1000);
    const Measurement m = *measure(field.view(), result->mesh);
    EXPECT_LE(m.max_error, 2 + 1e-9);
    EXPECT_EQ(m.uncovered, 0u);
    EXPECT_TRUE(m.is_sound());
  }
}

TEST(effort, somebody_who_has_enough_ends_it_and_else_changes_nothing) {
  const Field field = testing::random_field(26, testing::fewer(120), testing::fewer(90), Relief::kRidges, 0.02);
  const auto with = [&](const std::function<bool()>& is_enough) {
    auto options = with_effort(2, Effort::kMax);
    options.run.is_enough = is_enough;
    return *simplify(field.view(), options);
  };
  const Simplified whole = with({}), waited = with([] { return false; }), cut = with([] { return true; });
  EXPECT_EQ(waited.mesh.positions, whole.mesh.positions);
  EXPECT_FALSE(waited.is_cut_short);
  EXPECT_TRUE(cut.is_cut_short);
  EXPECT_EQ(cut.mesh.triangle_count(), simplify(field.view(), with_effort(2, Effort::kFast))->mesh.triangle_count());
  EXPECT_LE(measure(field.view(), cut.mesh)->max_error, 2 + 1e-9);
}

TEST(effort, what_needs_more_than_fast_effort_is_refused_with_it) {
  const Field field = testing::random_field(25, 20, 20, Relief::kRidges);
  auto shaped = with_effort(4, Effort::kFast), timed = shaped, thin = with_effort(4, Effort::kHigh);
  shaped.quality.min_shape = 0.1;
  timed.run.is_time_up = [] { return false; };
  thin.quality.min_shape = 0.6;
  for (const SimplifyOptions& options : {shaped, timed, thin}) {
    const auto result = simplify(field.view(), options);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().kind, ErrorKind::kUsage);
  }
}

TEST(effort, normal_leaves_fewer_triangles_if_vertices_are_free) {
  Field bowl{200, 160, {}};
  for (int y = 0; y < 160; ++y)
    for (int x = 0; x < 200; ++x) bowl.samples.push_back(0.01f * static_cast<float>(x * x + 2 * y * y));
  const auto free = simplify(bowl.view(), with_effort(1, Effort::kNormal, Vertices::kFree));
  const auto on_samples = simplify(bowl.view(), with_effort(1, Effort::kNormal));
  ASSERT_TRUE(free && on_samples);
  EXPECT_LE(measure(bowl.view(), free->mesh)->max_error, 1);
  EXPECT_LT(static_cast<double>(free->mesh.triangle_count()),
            0.8 * static_cast<double>(on_samples->mesh.triangle_count()));
}

TEST(effort, free_vertices_that_cannot_be_are_refused) {
  const Field field = testing::random_field(25, 20, 20, Relief::kRidges);
  const auto result = simplify(field.view(), with_effort(4, Effort::kFast, Vertices::kFree));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, ErrorKind::kUsage);
}

}  // namespace
}  // namespace scarp::effort_laws_test
