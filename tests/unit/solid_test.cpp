#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "laws/sanitized.h"
#include "mesh/exact_orient.h"
#include "mesh/half_edges.h"
#include "mesh_samples.h"

namespace scarp {
namespace {

using test::grid_mesh;

/// Every directed edge and its reverse occur once. Every vertex is used, with one fan of triangles around it.
void expect_closed_manifold(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (std::uint32_t h = 0; h < mesh.triangles.size(); ++h) {
    ++edges[{mesh.triangles[h], mesh.triangles[mesh::next_half_edge(h)]}];
  }
  for (const auto& [ends, count] : edges) {
    ASSERT_NE(ends.first, ends.second);
    ASSERT_EQ(count, 1) << ends.first << "→" << ends.second;
    ASSERT_TRUE(edges.contains({ends.second, ends.first})) << ends.first << "→" << ends.second << " is open";
  }
  std::vector<std::size_t> corners(mesh.vertex_count(), 0);
  std::vector<std::uint32_t> first(mesh.vertex_count(), mesh::kNoHalfEdge);
  for (std::uint32_t h = 0; h < mesh.triangles.size(); ++h) {
    ++corners[mesh.triangles[h]];
    first[mesh.triangles[h]] = h;
  }
  const auto twins = mesh::build_twins(mesh.triangles);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    ASSERT_NE(first[v], mesh::kNoHalfEdge) << "vertex " << v << " is unused";
    std::size_t turned = 0;
    std::uint32_t h = first[v];
    do {
      ++turned;
      h = twins[mesh::previous_half_edge(h)];
    } while (h != first[v]);
    ASSERT_EQ(turned, corners[v]) << "vertex " << v << " joins two fans";
  }
}

double signed_volume(const Mesh& mesh) {
  double six = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const double* a = &mesh.positions[3 * std::size_t{mesh.triangles[t]}];
    const double* b = &mesh.positions[3 * std::size_t{mesh.triangles[t + 1]}];
    const double* c = &mesh.positions[3 * std::size_t{mesh.triangles[t + 2]}];
    six += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return six / 6;
}

/// Volume between an open mesh and the plane z = base.
double volume_above(const Mesh& mesh, double base) {
  double volume = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const double* a = &mesh.positions[3 * std::size_t{mesh.triangles[t]}];
    const double* b = &mesh.positions[3 * std::size_t{mesh.triangles[t + 1]}];
    const double* c = &mesh.positions[3 * std::size_t{mesh.triangles[t + 2]}];
    const double area = ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
    volume += area * ((a[2] + b[2] + c[2]) / 3 - base);
  }
  return volume;
}

std::size_t border_edges(const Mesh& mesh) {
  const auto twins = mesh::build_twins(mesh.triangles);
  return static_cast<std::size_t>(std::count(twins.begin(), twins.end(), mesh::kNoHalfEdge));
}

/// Border vertices where the border turns, counted per fan.
std::size_t corners(const Mesh& mesh) {
  const auto twins = mesh::build_twins(mesh.triangles);
  const auto point = [&](std::uint32_t h) {
    const double* p = &mesh.positions[3 * std::size_t{mesh.triangles[h]}];
    return mesh::Point2{p[0], p[1]};
  };
  std::size_t count = 0;
  for (std::uint32_t h = 0; h < twins.size(); ++h) {
    if (twins[h] != mesh::kNoHalfEdge) continue;
    std::uint32_t onward = mesh::next_half_edge(h);
    while (twins[onward] != mesh::kNoHalfEdge) onward = mesh::next_half_edge(twins[onward]);
    count += mesh::exact_orient(point(h), point(onward), point(mesh::next_half_edge(onward))) != 0;
  }
  return count;
}

/// Adds a base at −3.5 and checks closedness and volume. Returns the triangles in floor and walls, minus one for each
/// border edge.
std::size_t check_solid(Mesh mesh, double tolerance = 1e-9) {
  const std::size_t top = mesh.triangle_count(), border = border_edges(mesh);
  const double expected = volume_above(mesh, -3.5);
  mesh.origin = {1000, 2000, 16};
  EXPECT_TRUE(add_base(mesh, 12.5));
  expect_closed_manifold(mesh);
  EXPECT_NEAR(signed_volume(mesh), expected, tolerance * expected);
  EXPECT_GT(signed_volume(mesh), 0);
  return mesh.triangle_count() - top - border;
}

TEST(Solid, RectangleHasAFloorOfTwoTriangles) {
  const Mesh mesh = grid_mesh(7, 5, [](int, int) { return true; });
  EXPECT_EQ(check_solid(mesh), 4 + 2u);
}

TEST(Solid, SingleTriangle) {
  Mesh mesh;
  mesh.positions = {0, 0, 1, 1, 0, 2, 0, 1, 3};
  mesh.triangles = {0, 1, 2};
  EXPECT_EQ(check_solid(mesh), 3 + 1u);
}

TEST(Solid, HolesAndParts) {
  const Mesh ring = grid_mesh(9, 9, [](int i, int j) { return !(i >= 3 && i < 6 && j >= 2 && j < 7); });
  EXPECT_EQ(check_solid(ring), 8 + 8 + 2 - 2u);
  const Mesh parts = grid_mesh(9, 9, [](int i, int j) { return i != 4 && j != 4; });
  EXPECT_EQ(check_solid(parts), 4 * (4 + 2u));
}

TEST(Solid, Checkerboards) {
  const Mesh board = grid_mesh(8, 8, [](int i, int j) { return (i + j) % 2 == 0; });
  EXPECT_EQ(check_solid(board), 32 * (4 + 2u));  // loose squares
  const Mesh coarse = grid_mesh(12, 12, [](int i, int j) { return (i / 3 + j / 3) % 2 == 0; });
  EXPECT_EQ(check_solid(coarse), 8 * (4 + 2u));
  // A frame of cells with a hole that touches the next hole, and also the outer border, in a point.
  const Mesh touching =
      grid_mesh(6, 6, [](int i, int j) { return !((i == 1 && j == 1) || (i == 2 && j == 2) || (i == 0 && j == 3)); });
  check_solid(touching);
}

TEST(Solid, RandomDomains) {
  std::mt19937 random(7);
  for (int round = 0; round < 300; ++round) {
    const int cols = 1 + static_cast<int>(random() % 14), rows = 1 + static_cast<int>(random() % 14);
    const auto share = random() % 11;
    std::vector<bool> cells(static_cast<std::size_t>(cols * rows));
    for (std::size_t c = 0; c < cells.size(); ++c) cells[c] = random() % 10 < share;
    cells[0] = true;
    const Mesh mesh =
        grid_mesh(cols, rows, [&](int i, int j) { return cells[static_cast<std::size_t>(j * cols + i)]; });
    // By Euler: a triangulation of c corners without inner vertices has the terrain's triangles, minus two per inner
    // vertex and one per straight border vertex.
    std::vector<bool> is_used(mesh.vertex_count(), false);
    for (const std::uint32_t v : mesh.triangles) is_used[v] = true;
    const auto twins = mesh::build_twins(mesh.triangles);
    std::vector<bool> on_border(mesh.vertex_count(), false);
    for (std::uint32_t h = 0; h < twins.size(); ++h) {
      if (twins[h] == mesh::kNoHalfEdge) on_border[mesh.triangles[h]] = true;
    }
    std::size_t inner = 0;
    for (std::size_t v = 0; v < is_used.size(); ++v) inner += is_used[v] && !on_border[v];
    const std::size_t straight = border_edges(mesh) - corners(mesh);
    EXPECT_EQ(check_solid(mesh), corners(mesh) + mesh.triangle_count() - 2 * inner - straight);
    if (HasFatalFailure() || HasNonfatalFailure()) FAIL() << "round " << round;
  }
}

TEST(Solid, LargeFloorIsFastAndMinimal) {
  const Mesh mesh =
      grid_mesh(testing::fewer(400), testing::fewer(400), [](int i, int j) { return !(i == 60 && j == 60); });
  EXPECT_EQ(check_solid(mesh), 8 + 8 + 2 - 2u);
}

TEST(Solid, UnevenPositionsStillTriangulate) {
  // Positions off a lattice: a fan of nearly collinear points far from the origin.
  Mesh mesh;
  mesh.positions = {0, 0, 1};
  for (int i = 0; i < 40; ++i) {
    const double angle = 6.283185307179586 * i / 40, r = i % 2 == 0 ? 1e-3 : 1e7;
    mesh.positions.insert(mesh.positions.end(), {static_cast<double>(static_cast<float>(r * std::cos(angle))),
                                                 static_cast<double>(static_cast<float>(r * std::sin(angle))), 1});
    mesh.triangles.insert(mesh.triangles.end(),
                          {0, 1 + static_cast<std::uint32_t>(i), 1 + static_cast<std::uint32_t>((i + 1) % 40)});
  }
  EXPECT_EQ(check_solid(mesh, 1e-6), 40 + 38u);  // its volume is the difference of large terms
}

TEST(Solid, OverlappingInputStaysClosed) {
  Mesh mesh = grid_mesh(3, 3, [](int, int) { return true; });
  mesh.positions[3 * 5] += 70;  // moves a vertex across its neighbours: some triangles flip
  EXPECT_EQ(check_solid(mesh), border_edges(mesh) + mesh.triangle_count());
}

TEST(Solid, RefusesABaseThatIsNotBelow) {
  Mesh mesh = grid_mesh(
      2, 2, [](int, int) { return true; }, true);
  const Mesh before = mesh;
  const double lowest = mesh.positions[2];
  for (const double base :
       {3.5, lowest, static_cast<double>(NAN), static_cast<double>(-INFINITY), std::nextafter(1.0, 2.0) + 1}) {
    EXPECT_FALSE(add_base(mesh, base)) << base;
    EXPECT_TRUE(test::same_geometry(mesh, before));
  }
  EXPECT_TRUE(add_base(mesh, 0));
  EXPECT_TRUE(mesh.normals.empty());
}

TEST(ExactOrient, AgreesWithIntegersAndItsLaws) {
  std::mt19937_64 random(3);
  int flat = 0;
  for (int round = 0; round < 200000; ++round) {
    // Nearly collinear: c lies on the line a→b at t, plus at most one unit.
    const auto number = [&](int bits) {
      return static_cast<std::int64_t>(random() >> (64 - bits)) - (std::int64_t{1} << (bits - 1));
    };
    const std::int64_t ax = number(50), ay = number(50), dx = number(24), dy = number(24), t = number(24);
    const std::int64_t cx = ax + t * dx + number(2) / 2, cy = ay + t * dy + number(2) / 2;
    __extension__ using Wide = __int128;
    const Wide exact = static_cast<Wide>(dx) * (cy - ay) - static_cast<Wide>(dy) * (cx - ax);
    const int sign = (exact > 0) - (exact < 0);
    const auto point = [](std::int64_t x, std::int64_t y) {
      return mesh::Point2{static_cast<double>(x), static_cast<double>(y)};
    };
    const mesh::Point2 a = point(ax, ay), b = point(ax + dx, ay + dy), c = point(cx, cy);
    flat += sign == 0;
    ASSERT_EQ(mesh::exact_orient(a, b, c), sign);
    ASSERT_EQ(mesh::exact_orient(b, c, a), sign);
    ASSERT_EQ(mesh::exact_orient(b, a, c), -sign);
  }
  EXPECT_GT(flat, 1000);
  // One unit in the last place decides, far below the resolution of the rounded determinant.
  EXPECT_EQ(mesh::exact_orient({0.5, 0.5}, {12, 12}, {24, 24}), 0);
  EXPECT_EQ(mesh::exact_orient({0.5, std::nextafter(0.5, 1)}, {12, 12}, {24, 24}), 1);
  EXPECT_EQ(mesh::exact_orient({0.5, std::nextafter(0.5, 0)}, {12, 12}, {24, 24}), -1);
}

TEST(AddBase, GivesNewVerticesTheAttributesOfThoseAbove) {
  // Two cells that touch in a corner: one vertex is duplicated, and all vertices are projected to the base.
  Mesh mesh = grid_mesh(2, 2, [](int i, int j) { return i == j; });
  test::add_attributes(mesh, 4);
  const Mesh open = mesh;
  ASSERT_TRUE(add_base(mesh, -5));
  ASSERT_EQ(mesh.uvs.size(), 2 * mesh.vertex_count());
  ASSERT_EQ(mesh.colors.size(), 3 * mesh.vertex_count());
  ASSERT_EQ(mesh.channels.size(), 4 * mesh.vertex_count());
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    std::size_t above = 0;
    while (open.positions[3 * above] != mesh.positions[3 * v] ||
           open.positions[3 * above + 1] != mesh.positions[3 * v + 1])
      ++above;
    EXPECT_EQ(mesh.uvs[2 * v], open.uvs[2 * above]);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(mesh.colors[3 * v + k], open.colors[3 * above + k]);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(mesh.channels[4 * v + k], open.channels[4 * above + k]);
  }
}

}  // namespace
}  // namespace scarp
