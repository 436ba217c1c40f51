// Lines through points: contours that become chains of edges.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "scarp/measure.h"
#include "scarp/points.h"
#include "unit/raster_files.h"

namespace scarp {
namespace {

using testing::contains;

void add_line(PointSet& points, const std::string& name, const std::vector<std::array<double, 3>>& vertices,
              bool is_ring = false) {
  PointLine line;
  line.name = name;
  for (const auto& [x, y, z] : vertices) {
    line.points.push_back(static_cast<std::uint32_t>(points.size()));
    points.x.push_back(x);
    points.y.push_back(y);
    points.z.push_back(z);
  }
  if (is_ring) line.points.push_back(line.points.front());
  points.lines.push_back(std::move(line));
}

/// Rings around a star-shaped hill, highest in the middle.
PointSet hill() {
  PointSet points;
  for (int level = 0; level < 12; ++level) {
    std::vector<std::array<double, 3>> ring;
    for (int k = 0; k < 300; ++k) {
      const double angle = 2 * std::numbers::pi * k / 300,
                   radius = (1200 - 90 * level) * (1 + 0.2 * std::sin(7 * angle));
      ring.push_back({500000 + radius * std::cos(angle), 4e6 + radius * std::sin(angle), 10.0 * level});
    }
    add_line(points, "ring " + std::to_string(level), ring, true);
  }
  return points;
}

std::set<std::pair<std::uint32_t, std::uint32_t>> edges_of(const Mesh& mesh) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (std::size_t h = 0; h < mesh.triangles.size(); ++h) {
    const std::uint32_t a = mesh.triangles[h], b = mesh.triangles[h % 3 == 2 ? h - 2 : h + 1];
    edges.insert({std::min(a, b), std::max(a, b)});
  }
  return edges;
}

std::uint64_t count_flat(const Mesh& mesh) {
  std::uint64_t count = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const auto z = [&](std::size_t k) { return mesh.vertex(mesh.triangles[3 * t + k])[2]; };
    count += z(0) == z(1) && z(1) == z(2);
  }
  return count;
}

TEST(contours, are_chains_of_edges_that_keep_the_bound) {
  const PointSet points = hill();
  for (const double goal : {0.0, 1.0, 4.0}) {
    const auto result = simplify_points(points, {.max_error = goal, .float32_positions = false});
    ASSERT_TRUE(result) << result.error().message;
    const Mesh& mesh = result->simplified.mesh;
    const auto edges = edges_of(mesh);
    EXPECT_EQ(result->loose, 0u);
    for (const PointLine& line : points.lines) {
      std::vector<std::uint32_t> chain;
      for (const std::uint32_t point : line.points) {
        for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
          if (std::hypot(mesh.vertex(v)[0] - points.x[point], mesh.vertex(v)[1] - points.y[point]) < 1e-6)
            chain.push_back(v);
        }
      }
      ASSERT_GE(chain.size(), 4u) << line.name;
      for (std::size_t k = 1; k < chain.size(); ++k)
        EXPECT_TRUE(edges.contains({std::min(chain[k - 1], chain[k]), std::max(chain[k - 1], chain[k])})) << line.name;
    }
    const auto judged = *measure_points(points, mesh, DuplicatePolicy::kFirst);
    EXPECT_LE(judged.max_error, goal + 1e-9);
    EXPECT_EQ(judged.uncovered, 0u);
    EXPECT_TRUE(judged.is_sound());
    EXPECT_EQ(judged.samples, points.size());
    EXPECT_EQ(result->flat, count_flat(mesh));
    if (goal == 4) {
      EXPECT_LT(mesh.vertex_count(), points.size() / 3);
    }
  }
}

TEST(contours, keep_the_bound_in_float32_where_their_points_are_crowded) {
  PointSet points = hill();
  // Like contours of a raster: two vertices a micrometre apart.
  for (PointLine& line : points.lines) {
    const std::uint32_t point = line.points[7];
    line.points.insert(line.points.begin() + 8, static_cast<std::uint32_t>(points.size()));
    points.x.push_back(points.x[point] + 1e-7);
    points.y.push_back(points.y[point] + 1e-7);
    points.z.push_back(points.z[point]);
  }
  const auto result = simplify_points(points, {.max_error = 0.5});
  ASSERT_TRUE(result) << result.error().message;
  const auto judged = *measure_points(points, result->simplified.mesh, DuplicatePolicy::kFirst);
  EXPECT_LE(judged.max_error, 0.5 + 1e-9);
  EXPECT_EQ(judged.samples, points.size());
  for (const double position : result->simplified.mesh.positions)
    EXPECT_EQ(position, double{static_cast<float>(position)});
}

TEST(contours, give_up_flat_triangles_in_bends) {
  PointSet points;
  add_line(points, "bend", {{0, 0, 10}, {5, 8, 10}, {10, 0, 10}});
  add_line(points, "below", {{-5, -6, 0}, {5, -6, -1}, {15, -6, 0}});
  const auto lined = *simplify_points(points, {.max_error = 0.0, .float32_positions = false});
  EXPECT_EQ(lined.flat, 0u);
  EXPECT_EQ(count_flat(lined.simplified.mesh), 0u);
  PointSet scattered = points;
  scattered.lines.clear();
  const auto plain = *simplify_points(scattered, {.max_error = 0.0, .float32_positions = false});
  EXPECT_EQ(count_flat(plain.simplified.mesh), 1u);
  EXPECT_EQ(plain.simplified.mesh.triangle_count(), lined.simplified.mesh.triangle_count());
}

TEST(contours, that_meet_with_unlike_heights_are_refused_by_name) {
  PointSet crossing;
  add_line(crossing, "c.gpkg feature 3", {{0, 0, 10}, {10, 10, 10}});
  add_line(crossing, "c.gpkg feature 8", {{0, 10, 20}, {10, 0, 20}});
  const auto refused = simplify_points(crossing, {.max_error = 1.0});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::kInput);
  EXPECT_TRUE(contains(refused.error().message,
                       "c.gpkg feature 3 and c.gpkg feature 8 meet at (5, 5) with the heights 10 and 20"))
      << refused.error().message;
  PointSet touching;
  add_line(touching, "a", {{0, 0, 10}, {10, 10, 10}});
  add_line(touching, "b", {{5, 5, 20}, {10, 0, 20}});
  EXPECT_TRUE(contains(simplify_points(touching, {.max_error = 1.0}).error().message, "meet at (5, 5)"));
  PointSet corner;
  add_line(corner, "a", {{0, 0, 10}, {10, 10, 10}});
  add_line(corner, "b", {{10, 10, 20}, {10, 0, 20}});
  EXPECT_TRUE(contains(simplify_points(corner, {.max_error = 1.0}).error().message, "a and b meet at (10, 10)"));
}

TEST(contours, that_cross_at_one_height_are_counted) {
  PointSet points;
  add_line(points, "a", {{0, 0, 10}, {10, 10, 10}});
  add_line(points, "b", {{0, 10, 10}, {10, 0, 10}});
  const auto result = *simplify_points(points, {.max_error = 0.0});
  EXPECT_EQ(result.loose, 1u);
  EXPECT_EQ(simplify_points(points, {.max_triangles = 5}).error().kind, ErrorKind::kUsage);
}

}  // namespace
}  // namespace scarp
