// Frames in space: the judge's results for meshes on a round earth, and the guarantee of simplify() there.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "laws/ball.h"
#include "laws/fields.h"
#include "laws/sanitized.h"
#include "scarp/simplify.h"

namespace scarp::space_laws_test {
namespace {

using testing::Field;

constexpr double kDegree = std::numbers::pi / 180;

/// The four corners of a field of one height, as two triangles in space.
Mesh corners_of(const HeightField& field, double height) {
  std::vector<double> x, y, z(4, height);
  for (const auto& [col, row] :
       {std::pair{0, 0}, {field.cols - 1, 0}, {0, field.rows - 1}, {field.cols - 1, field.rows - 1}}) {
    const auto at = field.frame.apply_affine(col, row);
    x.push_back(at[0]);
    y.push_back(at[1]);
  }
  field.frame.space->to_space(x, y, z);
  Mesh mesh;
  for (std::size_t k = 0; k < 4; ++k) mesh.positions.insert(mesh.positions.end(), {x[k], y[k], z[k]});
  mesh.triangles = {0, 2, 1, 1, 2, 3};
  return mesh;
}

Field level(int cols, int rows, float height) {
  return {cols, rows, std::vector<float>(static_cast<std::size_t>(cols) * static_cast<std::size_t>(rows), height)};
}

HeightField on_ball(const Field& field, double longitude, double latitude, double cell) {
  HeightField view = field.view();
  view.frame = testing::ball_frame(longitude, latitude, cell, field.cols, field.rows);
  return view;
}

TEST(space, straight_triangles_sag_below_the_round_earth) {
  const Field field = level(101, 101, 250);
  const HeightField view = on_ball(field, -0.5, 0.5, 0.01);  // a degree across the equator
  const auto measured = measure(view, corners_of(view, 250));
  ASSERT_TRUE(measured) << measured.error().message;
  EXPECT_EQ(measured->uncovered, 0u);
  EXPECT_EQ(measured->samples, 101u * 101u);
  EXPECT_TRUE(measured->is_sound());
  // The four corners lie on a plane, at this distance from the earth's centre.
  const double half = 0.5 * kDegree, r = testing::kBallRadius + 250;
  EXPECT_NEAR(measured->max_error, r - r * std::cos(half) * std::cos(half), 1e-6);
  EXPECT_EQ(measured->max_error_at, (std::array<std::int32_t, 2>{50, 50}));
  EXPECT_LT(measured->mean_error, 0);
}

TEST(space, heights_along_the_vertical_are_errors) {
  const Field field = level(11, 11, 100);
  const HeightField view = on_ball(field, 20, 60, 1e-4);
  const auto measured = measure(view, corners_of(view, 107.5));
  ASSERT_TRUE(measured) << measured.error().message;
  EXPECT_NEAR(measured->max_error, 7.5, 1e-3);
  EXPECT_NEAR(measured->mean_error, 7.5, 1e-3);
}

TEST(space, triangles_that_look_at_the_earth_s_centre_are_told) {
  const Field field = level(21, 21, 0);
  const HeightField view = on_ball(field, -70, -50, 0.01);
  Mesh mesh = corners_of(view, 0);
  std::swap(mesh.triangles[0], mesh.triangles[1]);
  const auto measured = measure(view, mesh);
  ASSERT_TRUE(measured);
  EXPECT_EQ(measured->down_facing, 1u);
  EXPECT_FALSE(measured->is_sound());
}

TEST(space, simplify_keeps_its_promise_on_a_round_earth) {
  // Curved parallels at high latitudes, nodata, and sag of many times the bound.
  for (const double latitude : {1.0, 52.0, 84.0}) {
    if (testing::kIsSanitized && latitude == 1) continue;
    const Field field =
        testing::random_field(31, testing::fewer(160), testing::fewer(120), testing::Relief::kRidges, 0.02);
    const HeightField view = on_ball(field, 12, latitude, 0.01);
    for (const Effort effort : {Effort::kFast, Effort::kNormal, Effort::kHigh}) {
      for (const double goal : {3.0, 60.0}) {
        SimplifyOptions options{.goals = {.max_error = goal}};
        options.quality.effort = effort;
        const auto made = simplify(view, options);
        ASSERT_TRUE(made) << made.error().message;
        const auto judged = measure(view, made->mesh);
        ASSERT_TRUE(judged);
        EXPECT_LE(judged->max_error, goal);
        EXPECT_EQ(judged->max_error, made->measurement.max_error);
        EXPECT_EQ(judged->uncovered, 0u);
        EXPECT_TRUE(judged->is_sound());
        options.run.threads = 1;
        const auto again = simplify(view, options);
        ASSERT_TRUE(again);
        EXPECT_EQ(again->mesh.positions, made->mesh.positions);
        EXPECT_EQ(again->mesh.triangles, made->mesh.triangles);
      }
    }
  }
}

TEST(space, folds_are_told_and_mended) {
  // On a parallel at 60 degrees, the middle of a one-degree chord lies some 100 m to the south, beyond the next row.
  Field field = level(401, 401, 0);
  const double cell = 0.0025 / 4;
  field.samples[399 * 401 + 200] = 200;
  HeightField view = on_ball(field, 10, 60, cell);
  view.frame = testing::ball_frame(10, 60, 4 * cell, 401, 401);
  view.frame.affine[5] = -cell / 2;
  std::vector<double> x, y, z;
  const std::array<std::array<int, 2>, 5> at{{{0, 0}, {400, 0}, {0, 400}, {400, 400}, {200, 399}}};
  for (const auto& [col, row] : at) {
    const auto place = view.frame.apply_affine(col, row);
    x.push_back(place[0]);
    y.push_back(place[1]);
    z.push_back(field.samples[static_cast<std::size_t>(row * 401 + col)]);
  }
  view.frame.space->to_space(x, y, z);
  Mesh mesh;
  for (std::size_t k = 0; k < at.size(); ++k) mesh.positions.insert(mesh.positions.end(), {x[k], y[k], z[k]});
  mesh.triangles = {4, 2, 3, 4, 3, 1, 4, 1, 0, 4, 0, 2};
  const auto folded = measure(view, mesh);
  ASSERT_TRUE(folded) << folded.error().message;
  EXPECT_EQ(folded->down_facing, 1u);
  EXPECT_FALSE(folded->is_sound());
  const auto made = simplify(view, {.goals = {.max_error = 150.0}});
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_TRUE(made->measurement.is_sound());
  EXPECT_LE(made->measurement.max_error, 150);
}

TEST(space, verticals_that_meet_no_triangle_are_judged_at_the_border) {
  const Field field = level(101, 101, 0);
  const HeightField view = on_ball(field, 10, 60, 0.005);
  const auto judged = measure(view, corners_of(view, 0));
  ASSERT_TRUE(judged);
  EXPECT_EQ(judged->samples, 101u * 101u) << "the southern parallel's chord runs north of its samples";
  EXPECT_EQ(judged->uncovered, 0u);
}

TEST(space, a_refiner_sees_the_sag) {
  const Field field = level(101, 101, 0);
  const HeightField view = on_ball(field, 0, 0.5, 0.01);
  auto refiner = Refiner::create(view);
  ASSERT_TRUE(refiner);
  const double half = 0.5 * kDegree;
  EXPECT_NEAR(refiner->max_error(), testing::kBallRadius * (1 - std::cos(half) * std::cos(half)), 1);
  const Mesh mesh = refiner->mesh();
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const auto at = mesh.vertex(v);
    EXPECT_NEAR(std::hypot(at[0], at[1], at[2]), testing::kBallRadius, 0.01);
  }
}

TEST(space, a_smooth_earth_takes_triangles_for_its_own_curve) {
  // 4 degrees of a level sphere; on a map, two triangles would suffice at any bound.
  const Field field = level(401, 401, 0);
  const HeightField view = on_ball(field, 0, 4, 0.01);
  const auto made = simplify(view, {.goals = {.max_error = 20.0}});
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_LE(made->measurement.max_error, 20);
  // An edge of s metres sags s² / 8R. A right triangle's longest edge may have 32 km: 775 triangles of half that
  // height.
  EXPECT_GT(made->mesh.triangle_count(), 500u);
  EXPECT_LT(made->mesh.triangle_count(), 1500u);
}

TEST(space, normals_point_away_from_the_earth) {
  const Field field = level(41, 31, 0);
  const HeightField view = on_ball(field, 130, -30, 0.01);
  SimplifyOptions options{.goals = {.max_error = 2.0}};
  options.output.normals = true;
  const auto made = simplify(view, options);
  ASSERT_TRUE(made) << made.error().message;
  for (std::size_t v = 0; v < made->mesh.vertex_count(); ++v) {
    const auto at = made->mesh.vertex(v);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(made->mesh.normals[3 * v + k], at[k] / testing::kBallRadius, 2e-4);
  }
}

TEST(space, what_float32_cannot_hold_is_refused_with_the_way_out) {
  const Field field = testing::random_field(31, 160, 120, testing::Relief::kRidges);
  const auto made = simplify(on_ball(field, 12, 50, 0.01), {.goals = {.max_error = 1e-5}});
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().kind, ErrorKind::kPromise);
  EXPECT_NE(made.error().message.find("float32"), std::string::npos);
}

}  // namespace
}  // namespace scarp::space_laws_test
