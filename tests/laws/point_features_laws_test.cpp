// Laws of scattered points with lines and a boundary: the survey.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "point_sets.h"
#include "scarp/measure.h"
#include "scarp/points.h"

namespace scarp {

namespace {

constexpr double kNoHeight = std::numeric_limits<double>::quiet_NaN();

double land(double x, double y) { return 30 * std::sin(x / 130) + 20 * std::cos(y / 90 + x / 300); }

PointSet survey(std::mt19937& random, int count) {
  PointSet points;
  const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
  for (int i = 0; i < count; ++i) {
    points.x.push_back(std::round(uniform() * 1e5) / 100);
    points.y.push_back(std::round(uniform() * 1e5) / 100);
    points.z.push_back(land(points.x.back(), points.y.back()) + 4 * uniform());
  }
  return points;
}

/// A ring around (500, 500) whose corners are between two distances from it.
Line star(std::mt19937& random, int corners, double nearest, double farthest, LineRole role) {
  Line ring;
  ring.role = role;
  ring.polygon = 0;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    const double reach = nearest + (farthest - nearest) * static_cast<double>(random()) / 4294967296.0;
    ring.points.push_back({500 + reach * std::cos(angle), 500 + reach * std::sin(angle), kNoHeight});
  }
  ring.points.push_back(ring.points.front());
  return ring;
}

double area_of(const Line& ring) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < ring.points.size(); ++i)
    sum += ring.points[i][0] * ring.points[i + 1][1] - ring.points[i + 1][0] * ring.points[i][1];
  return std::abs(sum) / 2;
}

double area_of(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const auto a = mesh.vertex(mesh.triangles[3 * t]), b = mesh.vertex(mesh.triangles[3 * t + 1]),
               c = mesh.vertex(mesh.triangles[3 * t + 2]);
    sum += (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }
  return sum / 2;
}

/// A line from west to east through the middle, which crosses every boundary.
Line dike(std::mt19937& random, bool is_soft) {
  Line line;
  line.name = "dike";
  for (int i = 0; i <= 6; ++i) {
    const double x = 20 + 160.0 * i, y = 500 + static_cast<double>(random() % 60);
    line.points.push_back({x, y, is_soft ? kNoHeight : land(x, y) + 6});
  }
  return line;
}

RC_GTEST_PROP(point_features, keep_the_promise_within_a_boundary_with_holes_and_a_line, ()) {
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  PointSet points = survey(random, *rc::gen::inRange(60, 300));
  if (*rc::gen::arbitrary<bool>()) *add_lines(std::vector{dike(random, *rc::gen::arbitrary<bool>())}, points);
  std::vector<Line> rings{star(random, *rc::gen::inRange(4, 20), 180, 450, LineRole::kOuter)};
  const bool has_hole = *rc::gen::arbitrary<bool>();
  if (has_hole) rings.push_back(star(random, *rc::gen::inRange(3, 9), 30, 100, LineRole::kHole));
  const auto cut = cut_to_boundary(rings, *rc::gen::element(0.0, 1.0, 100.0), points);
  if (!cut) RC_FAIL(cut.error().message);
  const double goal = *rc::gen::element(0.0, 0.5, 2.0, 10.0);
  const Effort effort = *rc::gen::element(Effort::kFast, Effort::kNormal, Effort::kHigh);
  const auto made =
      simplify_points(points, {.max_error = goal, .float32_positions = false, .quality = {.effort = effort}});
  if (!made) RC_FAIL(made.error().message);
  const Mesh& mesh = made->simplified.mesh;
  const Measurement& m = made->simplified.measurement;
  RC_ASSERT(m.is_sound());
  RC_ASSERT(m.uncovered == 0u);
  RC_ASSERT(m.border_loops == (has_hole ? 2u : 1u));
  RC_ASSERT(m.max_error <= goal + 1e-9);
  const auto [missed, worst] = testing::judge_by_brute_force(points, mesh);
  RC_ASSERT(missed == 0);
  RC_ASSERT(worst <= goal + 1e-5);
  const double expected = area_of(rings[0]) - (has_hole ? area_of(rings[1]) : 0);
  RC_ASSERT(std::abs(area_of(mesh) - expected) < 1e-4 * expected);
}

RC_GTEST_PROP(point_features, have_the_shapes_that_were_asked_for, ()) {
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  PointSet points = survey(random, *rc::gen::inRange(60, 300));
  if (*rc::gen::arbitrary<bool>()) *add_lines(std::vector{dike(random, *rc::gen::arbitrary<bool>())}, points);
  if (*rc::gen::arbitrary<bool>()) {
    const std::vector rings{star(random, *rc::gen::inRange(4, 20), 180, 450, LineRole::kOuter),
                            star(random, *rc::gen::inRange(3, 9), 30, 100, LineRole::kHole)};
    if (!cut_to_boundary(rings, 1, points)) RC_FAIL("not cut");
  }
  PointOptions options{.max_error = *rc::gen::element(0.5, 2.0, 10.0),
                       .float32_positions = *rc::gen::arbitrary<bool>(),
                       .quality = {.effort = *rc::gen::element(Effort::kFast, Effort::kNormal, Effort::kHigh)}};
  ShapeGoals& goals = options.quality.shape;
  goals.min_angle = *rc::gen::element(0.0, 15.0, 28.0);
  if (*rc::gen::arbitrary<bool>()) goals.max_edge = *rc::gen::element(40.0, 150.0);
  if (*rc::gen::inRange(0, 3) == 0) goals.grade = *rc::gen::element(0.2, 1.0);
  if (goals.max_edge && *rc::gen::inRange(0, 3) == 0) goals.min_edge = *goals.max_edge / 4;
  RC_PRE(goals.any());
  const auto made = simplify_points(points, options);
  if (!made) RC_FAIL(made.error().message);
  const Mesh& mesh = made->simplified.mesh;
  const auto judged = *measure_points(points, mesh, DuplicatePolicy::kFirst);
  RC_ASSERT(judged.is_sound());
  RC_ASSERT(judged.uncovered == 0u);
  RC_ASSERT(judged.max_error <= *options.max_error + 1e-9);
  const ShapeReport& shape = made->simplified.shape.value();
  RC_ASSERT(std::abs(shape.min_angle - judged.min_angle) < 1e-6);
  std::uint64_t small = 0;
  double longest = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    std::array<std::array<double, 3>, 3> at{};
    for (std::size_t k = 0; k < 3; ++k) at[k] = mesh.vertex(mesh.triangles[3 * t + k]);
    double least = 180;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto &a = at[k], &b = at[(k + 1) % 3], &c = at[(k + 2) % 3];
      const double ux = b[0] - a[0], uy = b[1] - a[1], vx = c[0] - a[0], vy = c[1] - a[1];
      longest = std::max(longest, std::hypot(ux, uy));
      least = std::min(least, std::atan2(std::abs(ux * vy - uy * vx), ux * vx + uy * vy) * 180 / std::numbers::pi);
    }
    small += least < goals.min_angle;
  }
  if (goals.max_edge) RC_ASSERT(longest <= *goals.max_edge * (1 + 1e-9));
  RC_ASSERT(small == shape.below);
}

RC_GTEST_PROP(point_features, keep_a_budget_with_lines_and_shapes, ()) {
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  PointSet points = survey(random, *rc::gen::inRange(60, 300));
  if (*rc::gen::arbitrary<bool>()) *add_lines(std::vector{dike(random, *rc::gen::arbitrary<bool>())}, points);
  if (*rc::gen::arbitrary<bool>() &&
      !cut_to_boundary(std::vector{star(random, 12, 180, 450, LineRole::kOuter)}, 1, points))
    RC_FAIL("not cut");
  PointOptions options{.float32_positions = *rc::gen::arbitrary<bool>(),
                       .quality = {.effort = *rc::gen::element(Effort::kFast, Effort::kNormal, Effort::kHigh)}};
  options.quality.shape.min_angle = *rc::gen::element(0.0, 15.0, 28.0);
  RC_PRE(!points.lines.empty() || options.quality.shape.any());
  const std::uint64_t budget = *rc::gen::inRange<std::uint64_t>(20, 900);
  if (*rc::gen::arbitrary<bool>()) {
    options.max_triangles = budget;
  } else {
    options.max_vertices = budget;
  }
  if (*rc::gen::inRange(0, 3) == 0) options.max_error = *rc::gen::element(0.5, 10.0);
  const auto made = simplify_points(points, options);
  if (!made) {
    RC_ASSERT(made.error().kind == ErrorKind::kUsage);
    RC_ASSERT(made.error().message.find("too few") != std::string::npos);
    return;
  }
  const Mesh& mesh = made->simplified.mesh;
  RC_ASSERT((options.max_triangles ? mesh.triangle_count() : mesh.vertex_count()) <= budget);
  const auto judged = *measure_points(points, mesh, DuplicatePolicy::kFirst);
  RC_ASSERT(judged.is_sound());
  RC_ASSERT(judged.uncovered == 0u);
  RC_ASSERT(std::abs(judged.max_error - made->simplified.measurement.max_error) < 1e-9);
  // The mesh of that error without a budget is the same, with its lines.
  if (made->simplified.stop != StopReason::kMaxError) return;
  RC_ASSERT(judged.max_error <= *options.max_error + 1e-9);
  options.max_triangles = options.max_vertices = std::nullopt;
  const auto alone = simplify_points(points, options);
  if (!alone) RC_FAIL(alone.error().message);
  if (alone->simplified.mesh.positions == mesh.positions)
    RC_ASSERT(alone->flat == made->flat && alone->loose == made->loose);
}

RC_GTEST_PROP(point_features, keep_the_promise_in_float32, ()) {
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  PointSet points = survey(random, *rc::gen::inRange(60, 300));
  *add_lines(std::vector{dike(random, *rc::gen::arbitrary<bool>())}, points);
  if (!cut_to_boundary(std::vector{star(random, 12, 180, 450, LineRole::kOuter)}, 1, points)) RC_FAIL("not cut");
  const double goal = *rc::gen::element(0.5, 2.0, 10.0);
  const Effort effort = *rc::gen::element(Effort::kFast, Effort::kNormal, Effort::kHigh);
  const auto made = simplify_points(points, {.max_error = goal, .quality = {.effort = effort}});
  if (!made) RC_FAIL(made.error().message);
  RC_ASSERT(made->simplified.measurement.max_error <= goal + 1e-9);
  RC_ASSERT(made->simplified.measurement.uncovered == 0u);
  RC_ASSERT(made->simplified.measurement.is_sound());
}

TEST(point_features, soft_lines_follow_the_points_and_corners_beyond_them_are_counted) {
  PointSet points;
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {100.0, 0.0}, {100.0, 100.0}, {0.0, 100.0}}) {
    points.x.push_back(x);
    points.y.push_back(y);
    points.z.push_back(x / 10);
  }
  Line line;
  line.points = {{10, 20, kNoHeight}, {90, 60, kNoHeight}};
  EXPECT_EQ(*add_lines(std::vector{line}, points), 0u);
  EXPECT_NEAR(points.z[4], 1, 1e-6);
  EXPECT_NEAR(points.z[5], 9, 1e-6);
  ASSERT_EQ(points.lines.size(), 1u);
  Line ring;
  ring.role = LineRole::kOuter;
  ring.points = {{-20, 0, 0}, {50, 0, 0}, {50, 100, 0}, {-20, 100, 0}, {-20, 0, 0}};
  const auto cut = *cut_to_boundary(std::vector{ring}, 1, points);
  EXPECT_EQ(cut.points_outside, 3u);
  EXPECT_EQ(cut.corners_beyond, 2u);
  EXPECT_DOUBLE_EQ(cut.farthest, 20);
  const auto made = *simplify_points(points, {.max_error = 1.0, .float32_positions = false});
  EXPECT_NEAR(area_of(made.simplified.mesh), 7000, 1e-6);
  EXPECT_EQ(made.simplified.measurement.uncovered, 0u);
}

TEST(point_features, lines_keep_their_vertices_and_their_heights_along_the_boundary) {
  PointSet ground;
  for (int i = 0; i <= 100; i += 5) {
    for (int j = 0; j <= 100; j += 5) {
      ground.x.push_back(i + 1.5);
      ground.y.push_back(j + 1.5);
      ground.z.push_back(97.5 + 0.001 * i);
    }
  }
  Line kerb;
  for (int i = 0; i <= 6; ++i) kerb.points.push_back({20.0 + 10 * i, 20, 105 + 0.1 * i});
  for (int i = 1; i <= 3; ++i) kerb.points.push_back({80, 20.0 + 10 * i, 105.6});
  const std::array<std::array<double, 3>, 4> corners{{{20, 20, 0}, {80, 20, 0}, {80, 80, 0}, {20, 80, 0}}};
  for (std::size_t first = 0; first < 4; ++first) {  // the kerb runs along any edges of the ring, also the last
    PointSet points = ground;
    EXPECT_EQ(*add_lines(std::vector{kerb}, points), 0u);
    Line ring;
    ring.role = LineRole::kOuter;
    for (std::size_t k = 0; k <= 4; ++k) ring.points.push_back(corners[(first + k) % 4]);
    ASSERT_TRUE(cut_to_boundary(std::vector{ring}, 0.25, points));
    const auto made = *simplify_points(points, {.max_error = 0.5, .float32_positions = false});
    const Mesh& mesh = made.simplified.mesh;
    const auto has = [&](double x, double y, double z) {
      for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
        const auto [a, b, c] = mesh.vertex(v);
        if (std::hypot(a - x, b - y) < 1e-6 && std::abs(c - z) < 1e-9) return true;
      }
      return false;
    };
    for (const auto& [x, y, z] : kerb.points) EXPECT_TRUE(has(x, y, z)) << x << " " << y;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
      const auto [x, y, z] = mesh.vertex(v);
      const bool is_between = std::abs(y - 20) < 1e-6 && x > 20 && x < 80;
      EXPECT_TRUE(!is_between || z > 104.9) << x;  // no corner in between has the height of the ground
    }
    EXPECT_EQ(made.simplified.measurement.uncovered, 0u);
  }
}

TEST(point_features, surface_is_found_beyond_points_that_line_up) {
  for (int size = 2; size < 6; ++size) {
    PointSet points;
    for (int i = 0; i < size; ++i) {
      for (int j = 0; j < size; ++j) {
        if (i + j >= size) continue;
        points.x.push_back(i);
        points.y.push_back(j);
        points.z.push_back(i + 2 * j);
      }
    }
    Line line;
    for (int x = -2; x <= size + 1; ++x) {
      for (int y = -2; y <= size + 1; ++y) line.points.push_back({0.5 * x + 0.01 * y, 1.0 * y, kNoHeight});
    }
    ASSERT_TRUE(add_lines(std::vector{line}, points));
    for (const double z : points.z) EXPECT_TRUE(z >= 0 && z <= 2 * size);
  }
}

TEST(point_features, refuse_rings_that_cross) {
  std::mt19937 random(3);
  PointSet points = survey(random, 50);
  Line ring;
  ring.role = LineRole::kOuter;
  ring.points = {{100, 100, 0}, {900, 900, 0}, {900, 100, 0}, {100, 900, 0}, {100, 100, 0}};
  ASSERT_TRUE(cut_to_boundary(std::vector{ring}, 1, points));
  const auto made = simplify_points(points, {.max_error = 1.0});
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().kind, ErrorKind::kInput);
  EXPECT_NE(made.error().message.find("edges of the boundary cross near ("), std::string::npos);
}

}  // namespace

}  // namespace scarp
