// Laws of lakes in points and of their normals: level lakes, islands of land, and planes.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "laws/point_sets.h"
#include "scarp/points.h"

namespace scarp::point_lakes_laws_test {
namespace {

using testing::Heights;
using testing::Scatter;

/// A bumpy square of 1000 units.
PointSet any_land(int count) {
  PointSet points =
      testing::random_points(*rc::gen::arbitrary<std::uint32_t>(), count, Scatter::kFloats, Heights::kReal);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points.x[i] *= 1000;
    points.y[i] *= 1000;
    points.z[i] = 0.1 * points.z[i] + 20 * std::sin(points.x[i] / 200) + points.y[i] / 50;
  }
  return points;
}

Line ring_around(double x, double y, double reach, LineRole role) {
  Line ring;
  ring.role = role;
  ring.polygon = 0;
  ring.name = "pond";
  ring.points = {{x - reach, y - reach, 0},
                 {x + reach, y - reach, 0},
                 {x + reach, y + reach, 0},
                 {x - reach, y + reach, 0},
                 {x - reach, y - reach, 0}};
  return ring;
}

bool holds(const Line& ring, double x, double y) {
  return ring.points[0][0] <= x && x <= ring.points[2][0] && ring.points[0][1] <= y && y <= ring.points[2][1];
}

RC_GTEST_PROP(point_lakes, are_level_and_islands_stay_land, ()) {
  PointSet points = any_land(*rc::gen::inRange(60, 400));
  const double x = *rc::gen::inRange(300, 700), y = *rc::gen::inRange(300, 700);
  const Line shore = ring_around(x, y, 150, LineRole::kOuter), island = ring_around(x, y, 60, LineRole::kHole);
  std::size_t on_island = 0, in_lake = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool is_on_island = holds(island, points.x[i], points.y[i]);
    on_island += is_on_island;
    in_lake += !is_on_island && holds(shore, points.x[i], points.y[i]);
  }
  const std::size_t given = points.size();
  const auto lakes = level_lakes(std::vector{shore, island}, *rc::gen::element(0.0, 5.0, 50.0, 100.0), points);
  RC_ASSERT(lakes.has_value() && lakes->size() == 1);
  RC_ASSERT(lakes->front().dropped == in_lake);
  RC_ASSERT(points.size() == given - in_lake + 8 && points.lines.size() == 2);
  PointOptions options{.max_error = *rc::gen::element(0.5, 4.0), .float32_positions = false};
  options.quality.effort = *rc::gen::element(Effort::kFast, Effort::kNormal, Effort::kHigh);
  if (*rc::gen::arbitrary<bool>()) options.max_error = std::nullopt, options.max_triangles = 200;
  const auto made = simplify_points(points, options);
  RC_ASSERT(made.has_value());
  // Places in the lake, between shore and island, and on land.
  PointSet places;
  for (int k = 0; k < 40; ++k) {
    const double px = x - 149 + *rc::gen::inRange(0, 298), py = y - 149 + *rc::gen::inRange(0, 298);
    if (holds(island, px, py)) continue;
    places.x.push_back(px);
    places.y.push_back(py);
    places.z.push_back(lakes->front().level);
  }
  const auto [missed, uneven] = testing::judge_by_brute_force(places, made->simplified.mesh);
  RC_ASSERT(missed == 0 && uneven < 1e-9);
  RC_ASSERT(testing::judge_by_brute_force(points, made->simplified.mesh).second <=
            options.max_error.value_or(made->simplified.measurement.max_error) + 1e-6);
  if (options.max_triangles) RC_ASSERT(made->simplified.mesh.triangle_count() <= *options.max_triangles);
}

RC_GTEST_PROP(point_lakes, have_the_percentile_of_their_shore, ()) {
  // On a slope in x, the surface along the shore is known.
  PointSet points = any_land(400);
  for (const auto& [px, py] : {std::pair{0, 0}, {1000, 0}, {1000, 1000}, {0, 1000}}) {
    points.x.push_back(px);
    points.y.push_back(py);
    points.z.push_back(0);
  }
  for (std::size_t i = 0; i < points.size(); ++i) points.z[i] = points.x[i];
  const Line shore = ring_around(500, 500, 100, LineRole::kOuter);
  const double percentile = *rc::gen::element(0.0, 10.0, 100.0);
  const auto lakes = *level_lakes(std::vector{shore}, percentile, points);
  // A quarter of the shore is its western side, at 400.
  RC_ASSERT(std::abs(lakes.front().level - (percentile == 100 ? 600 : 400)) < 1e-3);
}

TEST(point_lakes, with_lines_of_other_heights_or_around_all_points_are_refused) {
  const PointSet land = testing::random_points(3, 50, Scatter::kFloats, Heights::kReal);
  const auto refused = [](const Line& shore, PointSet points) {
    const auto lakes = level_lakes(std::vector{shore}, 5, points);
    return lakes ? "" : lakes.error().message;
  };
  PointSet with_line = land;
  Line pier;
  pier.name = "pier";
  pier.points = {{0.45, 0.5, 900}, {0.55, 0.5, 900}};
  ASSERT_TRUE(add_lines(std::vector{pier}, with_line).has_value());
  const Line pond = ring_around(0.5, 0.5, 0.2, LineRole::kOuter);
  EXPECT_EQ(refused(pond, land), "");
  EXPECT_NE(refused(pond, with_line).find("pier runs through a lake: at (0.45, 0.5) its height is 900"),
            std::string::npos);
  EXPECT_NE(refused(ring_around(0.5, 0.5, 5, LineRole::kOuter), land).find("no shore among the points"),
            std::string::npos);
}

RC_GTEST_PROP(point_lakes, boundaries_and_normals_do_not_depend_on_the_order_of_points, ()) {
  PointSet points = any_land(*rc::gen::inRange(60, 200));
  for (std::size_t i = 0; i < 40; ++i) {
    points.x.push_back(points.x[i]);
    points.y.push_back(points.y[i]);
    points.z.push_back(points.z[i] + *rc::gen::inRange(-9, 9));
  }
  PointSet shuffled = points;
  for (auto* values : {&shuffled.x, &shuffled.y, &shuffled.z}) std::reverse(values->begin(), values->end());
  const auto policy = *rc::gen::element(DuplicatePolicy::kHighest, DuplicatePolicy::kLowest);
  const std::vector rings{ring_around(500, 500, 200, LineRole::kOuter)};
  const bool has_boundary = *rc::gen::arbitrary<bool>(), has_lake = *rc::gen::arbitrary<bool>();
  const auto make = [&](PointSet set) {
    if (has_lake) RC_ASSERT(level_lakes(rings, 20, set, policy).has_value());
    if (has_boundary)
      RC_ASSERT(cut_to_boundary(std::vector{ring_around(500, 500, 400, LineRole::kOuter)}, 1, set, policy).has_value());
    auto made = simplify_points(set, {.max_error = 2.0, .float32_positions = false, .duplicates = policy});
    RC_ASSERT(made.has_value());
    made->simplified.mesh.normals = *point_normals(set, made->simplified.mesh, policy);
    return made->simplified.mesh;
  };
  const Mesh one = make(points), other = make(shuffled);
  RC_ASSERT(one.positions == other.positions);
  RC_ASSERT(one.triangles == other.triangles);
  RC_ASSERT(one.normals == other.normals);
}

TEST(point_lakes, beyond_all_points_change_nothing) {
  PointSet points = testing::random_points(3, 50, Scatter::kFloats, Heights::kReal);
  const std::vector<double> before = points.z;
  const auto lakes = *level_lakes(std::vector{ring_around(9000, 9000, 10, LineRole::kOuter)}, 5, points);
  EXPECT_TRUE(std::isnan(lakes.front().level));
  EXPECT_EQ(points.z, before);
  EXPECT_TRUE(points.lines.empty());
}

RC_GTEST_PROP(point_normals, of_a_plane_are_its_normal_up_to_the_hull, ()) {
  PointSet points = any_land(*rc::gen::inRange(10, 200));
  const double a = *rc::gen::inRange(-20, 20) / 10.0, b = *rc::gen::inRange(-20, 20) / 10.0;
  for (std::size_t i = 0; i < points.size(); ++i) points.z[i] = a * points.x[i] + b * points.y[i] + 7;
  const auto made = simplify_points(points, {.max_error = 0.01, .float32_positions = false});
  RC_ASSERT(made.has_value());
  const Mesh& mesh = made->simplified.mesh;
  const auto normals = *point_normals(points, mesh);
  RC_ASSERT(normals.size() == 3 * mesh.vertex_count());
  const double length = std::sqrt(a * a + b * b + 1);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const double expected[] = {-a / length, -b / length, 1 / length};
    for (std::size_t k = 0; k < 3; ++k) RC_ASSERT(std::abs(double{normals[3 * v + k]} - expected[k]) < 1e-3);
  }
}

}  // namespace
}  // namespace scarp::point_lakes_laws_test
