#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "mesh_samples.h"
#include "scarp/mesh.h"

namespace scarp::mesh_contours_test {
namespace {

using Point = std::array<double, 2>;
using Segment = std::pair<Point, Point>;

/// A grid of squares with heights row by row, from the north.
Mesh land(const std::vector<std::vector<double>>& rows) {
  const int cols = static_cast<int>(rows[0].size()) - 1;
  Mesh mesh;
  for (std::size_t j = 0; j < rows.size(); ++j) {
    for (std::size_t i = 0; i < rows[j].size(); ++i)
      mesh.positions.insert(mesh.positions.end(), {static_cast<double>(i), -static_cast<double>(j), rows[j][i]});
  }
  const auto id = [&](int i, int j) { return static_cast<std::uint32_t>(j * (cols + 1) + i); };
  for (int j = 0; j + 1 < static_cast<int>(rows.size()); ++j) {
    for (int i = 0; i < cols; ++i)
      mesh.triangles.insert(mesh.triangles.end(),
                            {id(i, j + 1), id(i + 1, j + 1), id(i + 1, j), id(i, j + 1), id(i + 1, j), id(i, j)});
  }
  return mesh;
}

/// Hills with heights in multiples of 0.5, so that many vertices are exactly at a height.
Mesh random_land(unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::vector<double>> rows(9, std::vector<double>(8));
  for (auto& row : rows) {
    for (double& z : row) z = 0.5 * static_cast<double>(random() % 9) - 2;
  }
  return land(rows);
}

/// The pieces of a height in each triangle, from the low side's left; a vertex at the height counts as above it. An
/// independent implementation without half-edges.
std::multiset<Segment> segments_by_triangle(const Mesh& mesh, double height) {
  std::multiset<Segment> segments;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    std::array<Point, 2> ends;
    bool is_crossed = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = mesh.vertex(mesh.triangles[3 * t + k]), b = mesh.vertex(mesh.triangles[3 * t + (k + 1) % 3]);
      if ((a[2] >= height) == (b[2] >= height)) continue;
      const auto& low = a[2] < b[2] ? a : b;
      const auto& high = a[2] < b[2] ? b : a;
      const double part = (height - low[2]) / (high[2] - low[2]);
      const Point point = high[2] == height
                              ? Point{high[0], high[1]}
                              : Point{low[0] + (high[0] - low[0]) * part, low[1] + (high[1] - low[1]) * part};
      ends[a[2] < height] = point;
      is_crossed = true;
    }
    if (is_crossed && ends[0] != ends[1]) segments.insert({ends[0], ends[1]});
  }
  return segments;
}

TEST(MeshContours, AreThePiecesOfAllTriangles) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    const Mesh mesh = random_land(seed);
    const double interval = seed % 3 == 0 ? 0.5 : seed % 3 == 1 ? 0.75 : 1;
    const auto contours = find_contours(mesh, interval);
    ASSERT_TRUE(contours);
    std::map<double, std::multiset<Segment>> found;
    for (const Contour& line : *contours) {
      ASSERT_GE(line.points.size(), line.is_closed ? 3u : 2u);
      for (std::size_t k = 1; k < line.points.size(); ++k)
        found[line.height].insert({line.points[k - 1], line.points[k]});
      if (line.is_closed) found[line.height].insert({line.points.back(), line.points.front()});
      const auto is_on_border = [](const Point& p) { return p[0] == 0 || p[0] == 7 || p[1] == 0 || p[1] == -8; };
      EXPECT_TRUE(line.is_closed || (is_on_border(line.points.front()) && is_on_border(line.points.back())));
    }
    for (int k = -8; k <= 8; ++k) {
      auto wanted = segments_by_triangle(mesh, k * interval);
      // A single edge at the height, with lower ground around it, occurs in both directions.
      for (auto segment = wanted.begin(); segment != wanted.end();) {
        const auto back = wanted.find({segment->second, segment->first});
        const bool is_omitted = back != wanted.end() && found[k * interval].count(*segment) == 0;
        if (is_omitted) wanted.erase(back);
        segment = is_omitted ? wanted.erase(segment) : std::next(segment);
      }
      EXPECT_EQ(found[k * interval], wanted) << "seed " << seed << ", height " << k * interval;
    }
  }
}

TEST(MeshContours, HaveAFixedOrderAndDirection) {
  // A cone of height 2 on a slope that falls to the east.
  const Mesh mesh = land({{3, 0, 0, 0}, {3, 0, 2, 0}, {3, 0, 0, 0}});
  const auto contours = *find_contours(mesh, 1);
  ASSERT_EQ(contours.size(), 4u);
  EXPECT_EQ(contours[0].height, 1);
  EXPECT_TRUE(std::is_sorted(contours.begin(), contours.end(),
                             [](const Contour& a, const Contour& b) { return a.height < b.height; }));
  const Contour &slope = contours[0], &cone = contours[1];
  ASSERT_FALSE(slope.is_closed);
  // The ground rises to the west, on the left when walking north.
  EXPECT_NEAR(slope.points.front()[0], 2.0 / 3, 1e-12);
  EXPECT_EQ(slope.points.front()[1], -2);
  EXPECT_EQ(slope.points.back()[1], 0);
  ASSERT_TRUE(cone.is_closed);
  double twice_area = 0;
  for (std::size_t k = 0; k < cone.points.size(); ++k) {
    const Point &p = cone.points[k], &q = cone.points[(k + 1) % cone.points.size()];
    twice_area += p[0] * q[1] - q[0] * p[1];
  }
  EXPECT_GT(twice_area, 0);  // counter-clockwise: the summit is on the left
  EXPECT_EQ(contours[2].height, 2);
  EXPECT_EQ(contours[3].height, 3);  // the western border, exactly at the height
}

TEST(MeshContours, TreatVerticesAtTheHeightAsAboveIt) {
  const auto at_1 = [](const std::vector<std::vector<double>>& rows) {
    std::vector<Contour> lines = *find_contours(land(rows), 1);
    std::erase_if(lines, [](const Contour& line) { return line.height != 1; });
    return lines;
  };
  const auto plateau = at_1({{0, 0, 0, 0}, {0, 1, 1, 0}, {0, 1, 1, 0}, {0, 0, 0, 0}});
  ASSERT_EQ(plateau.size(), 1u);
  EXPECT_TRUE(plateau[0].is_closed);
  EXPECT_EQ(plateau[0].points.size(), 4u);
  EXPECT_TRUE(at_1({{2, 2, 2, 2}, {2, 1, 1, 2}, {2, 1, 1, 2}, {2, 2, 2, 2}}).empty());  // a hollow
  EXPECT_TRUE(at_1({{0, 0, 0}, {0, 1, 0}, {0, 0, 0}}).empty());                         // a summit
  const auto ridge = at_1({{0, 0, 0, 0, 0}, {0, 1, 1, 1, 0}, {0, 0, 0, 0, 0}});
  ASSERT_EQ(ridge.size(), 1u);
  EXPECT_TRUE(ridge[0].is_closed);
  EXPECT_EQ(ridge[0].points.size(), 4u);  // in both directions
}

TEST(MeshContours, LieWhereTheMeshDoes) {
  Mesh mesh = land({{0, 1}, {0, 1}});
  const auto near = *find_contours(mesh, 0.5);
  mesh.origin = {500000, 4000000, 0};
  const auto far = *find_contours(mesh, 0.5);
  ASSERT_EQ(near.size(), far.size());
  for (std::size_t k = 0; k < near.size(); ++k) {
    for (std::size_t i = 0; i < near[k].points.size(); ++i)
      EXPECT_EQ(far[k].points[i], (Point{near[k].points[i][0] + 500000, near[k].points[i][1] + 4000000}));
  }
}

TEST(MeshContours, RefuseIntervalsWithoutEnd) {
  const Mesh mesh = land({{0, 1}, {0, 1}});
  for (const double interval : {0.0, -1.0, static_cast<double>(NAN), static_cast<double>(INFINITY), 1e-9}) {
    const auto contours = find_contours(mesh, interval);
    ASSERT_FALSE(contours) << interval;
    EXPECT_EQ(contours.error().kind, ErrorKind::kUsage);
  }
  EXPECT_TRUE(find_contours(mesh, 7)->empty());
  EXPECT_TRUE(find_contours(Mesh(), 1)->empty());
}

}  // namespace
}  // namespace scarp::mesh_contours_test
