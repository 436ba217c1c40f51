// Planted faults: the corresponding number detects each fault.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "laws/sanitized.h"
#include "scarp/measure.h"
#include "unit/measure_meshes.h"

namespace scarp::testing {
namespace {

class Faults : public ::testing::Test {
 protected:
  Measurement judge() const {
    const auto result = measure(terrain_.view(), mesh_);
    EXPECT_TRUE(result.has_value());
    return result ? *result : Measurement{};
  }
  std::uint32_t vertex(int i, int j) const { return static_cast<std::uint32_t>(j * 9 + i); }

  Terrain terrain_ = wavy_terrain(33, 33);
  Mesh mesh_ = grid_mesh(terrain_, 4);  // 9 × 9 vertices, 128 triangles
};

TEST_F(Faults, NoneInAGoodMesh) {
  const Measurement m = judge();
  EXPECT_TRUE(m.is_sound());
  EXPECT_EQ(m.vertices, 81u);
  EXPECT_EQ(m.triangles, 128u);
  EXPECT_EQ(m.open_edges, 32u);
  EXPECT_EQ(m.border_loops, 1u);
  EXPECT_FALSE(m.closed);
  EXPECT_DOUBLE_EQ(m.min_angle, 45);
  EXPECT_DOUBLE_EQ(m.angle_percentiles[2], 45);
  EXPECT_EQ(m.uncovered, 0u);
}

TEST_F(Faults, VertexMovedInZ) {
  mesh_.positions[3 * vertex(4, 4) + 2] += 1000;
  const Measurement m = judge();
  EXPECT_EQ(m.max_error, 1000);
  EXPECT_EQ(m.max_error_at, (std::array<std::int32_t, 2>{16, 16}));
  EXPECT_TRUE(m.is_sound());
}

TEST_F(Faults, VertexMovedInXy) {
  const double before = judge().max_error;
  mesh_.positions[3 * vertex(4, 4)] += 7;  // beyond its neighbour: triangles flip
  const Measurement m = judge();
  EXPECT_GT(m.max_error, before);
  EXPECT_GT(m.down_facing, 0u);
  EXPECT_GT(m.overlaps, 0u);
  EXPECT_FALSE(m.is_sound());
}

TEST_F(Faults, TriangleDropped) {
  mesh_.triangles.erase(mesh_.triangles.begin() + 3 * 60, mesh_.triangles.begin() + 3 * 61);
  const Measurement m = judge();
  EXPECT_EQ(m.open_edges, 35u);
  EXPECT_EQ(m.border_loops, 2u);
  EXPECT_EQ(m.uncovered, 3u);  // the samples inside it
  EXPECT_EQ(m.gaps, 3u);
  EXPECT_FALSE(m.is_sound());
}

/// Removes each triangle that shares an edge with another in turn: a mesh with a hole never passes.
void expect_every_hole_seen(const Terrain& terrain, const Mesh& whole) {
  const auto sound = measure(terrain.view(), whole);
  ASSERT_TRUE(sound);
  EXPECT_TRUE(sound->is_sound()) << sound->gaps;
  EXPECT_EQ(sound->gaps, 0u);
  for (std::size_t t = 0; t < whole.triangle_count(); ++t) {
    Mesh mesh = whole;
    const auto at = mesh.triangles.begin() + static_cast<std::ptrdiff_t>(3 * t);
    mesh.triangles.erase(at, at + 3);
    const auto judged = measure(terrain.view(), mesh);
    ASSERT_TRUE(judged);
    if (judged->open_edges + 3 == sound->open_edges) continue;  // connected to the rest by corners only
    EXPECT_GT(judged->gaps, 0u) << t;
    EXPECT_FALSE(judged->is_sound()) << t;
  }
}

TEST(Holes, OfAnyTriangleOfTheFullGridAreSeen) {
  Terrain terrain = wavy_terrain(7, 6);
  expect_every_hole_seen(terrain, grid_mesh(terrain, 1));
  const double c = std::cos(0.3), s = std::sin(0.3);
  terrain.frame.affine = {5e5, 30 * c, 30 * s, 4e6, 30 * s, -30 * c};
  expect_every_hole_seen(terrain, grid_mesh(terrain, 1));
  terrain.frame.affine = {5e5, 30, 0, 4e6, 0, 30};  // south-up
  expect_every_hole_seen(terrain, grid_mesh(terrain, 1));
  const Mesh mesh = grid_mesh(terrain, 1);
  terrain.frame = dress_up(terrain.frame);
  expect_every_hole_seen(terrain, mesh);
}

TEST(Holes, BesideNodataAndHalfCellsAreSeen) {
  std::mt19937 random(3);
  for (int round = 0; round < 20; ++round) {
    const Terrain terrain = random_terrain(9, 8, 0.12, random);
    Mesh mesh;
    for (int r = 0; r < terrain.rows; ++r) {
      for (int c = 0; c < terrain.cols; ++c) {
        const float sample = terrain.samples[static_cast<std::size_t>(r * terrain.cols + c)];
        add_vertex(mesh, terrain.frame, c, r, std::isnan(sample) ? 0 : sample);
      }
    }
    // Corners counter-clockwise around a cell, from its upper left corner; three if one is nodata.
    for (int r = 0; r + 1 < terrain.rows; ++r) {
      for (int c = 0; c + 1 < terrain.cols; ++c) {
        std::vector<std::uint32_t> ring;
        for (const auto& [dc, dr] : {std::pair{0, 0}, {0, 1}, {1, 1}, {1, 0}}) {
          const auto v = static_cast<std::uint32_t>((r + dr) * terrain.cols + c + dc);
          if (!std::isnan(terrain.samples[v])) ring.push_back(v);
        }
        for (std::size_t k = 2; k < ring.size(); ++k) {
          mesh.triangles.insert(mesh.triangles.end(), {ring[0], ring[k - 1], ring[k]});
        }
      }
    }
    expect_every_hole_seen(terrain, mesh);
  }
}

TEST(Holes, OfSliversAndLongEdgesAreSeen) {
  // Holes thinner than the step with which the judge tests beyond an edge.
  const Terrain terrain = wavy_terrain(201, 3);
  Mesh mesh;
  for (int r = 0; r < 3; r += 2) {
    add_vertex(mesh, terrain.frame, 0, r, 0);
    add_vertex(mesh, terrain.frame, 200, r, 0);
  }
  add_vertex(mesh, terrain.frame, 99, 1, 0);
  add_vertex(mesh, terrain.frame, 101, 1, 0);
  add_vertex(mesh, terrain.frame, 100, 1, 0);
  // Fans around the middle: 0 and 1 above, 2 and 3 below, 4 6 5 from left to right.
  mesh.triangles = {0, 4, 1, 4, 6, 1, 6, 5, 1, 0, 2, 4, 2, 3, 4, 4, 3, 6, 6, 3, 5, 5, 3, 1};
  expect_every_hole_seen(terrain, mesh);
}

TEST_F(Faults, TriangleFlipped) {
  std::swap(mesh_.triangles[3 * 60], mesh_.triangles[3 * 60 + 1]);
  const Measurement m = judge();
  EXPECT_EQ(m.down_facing, 1u);
  EXPECT_EQ(m.misoriented_edges, 3u);
  EXPECT_EQ(m.border_loops, 1u);
  EXPECT_EQ(m.overlaps, 0u);
  EXPECT_FALSE(m.is_sound());
}

TEST_F(Faults, TriangleDuplicated) {
  const std::vector<std::uint32_t> copy(mesh_.triangles.begin() + 180, mesh_.triangles.begin() + 183);
  mesh_.triangles.insert(mesh_.triangles.end(), copy.begin(), copy.end());
  const Measurement m = judge();
  EXPECT_EQ(m.overlaps, 1u);
  EXPECT_EQ(m.non_manifold_edges, 3u);
  EXPECT_FALSE(m.is_sound());
}

TEST_F(Faults, TrianglesOverlapping) {
  const auto first = static_cast<std::uint32_t>(mesh_.vertex_count());
  add_vertex(mesh_, terrain_.frame, 8.25, 8.25, 0);
  add_vertex(mesh_, terrain_.frame, 8.25, 9.25, 0);
  add_vertex(mesh_, terrain_.frame, 9.25, 8.25, 0);
  mesh_.triangles.insert(mesh_.triangles.end(), {first, first + 1, first + 2});
  const Measurement m = judge();
  EXPECT_EQ(m.overlaps, 1u);
  EXPECT_EQ(m.border_loops, 2u);
  EXPECT_FALSE(m.is_sound());
}

TEST_F(Faults, TJunction) {
  // One side's triangle is split at the middle of an inner edge, the other's is not.
  const std::uint32_t a = mesh_.triangles[180], b = mesh_.triangles[181], c = mesh_.triangles[182];
  const auto m_id = static_cast<std::uint32_t>(mesh_.vertex_count());
  for (std::size_t k = 0; k < 3; ++k) {
    mesh_.positions.push_back((mesh_.positions[3 * b + k] + mesh_.positions[3 * c + k]) / 2);
  }
  mesh_.triangles[182] = m_id;
  mesh_.triangles.insert(mesh_.triangles.end(), {a, m_id, c});
  const Measurement m = judge();
  EXPECT_EQ(m.t_junctions, 1u);
  EXPECT_EQ(m.open_edges, 32u + 3);
  EXPECT_EQ(m.overlaps, 0u);
  EXPECT_EQ(m.uncovered, 0u);
  EXPECT_FALSE(m.is_sound());
}

TEST_F(Faults, Crack) {
  // The right half is shifted by a thousandth of a cell.
  const auto split = [&](int j) {
    const auto copy = static_cast<std::uint32_t>(mesh_.vertex_count());
    const std::size_t v = vertex(4, j);
    for (std::size_t k = 0; k < 3; ++k) mesh_.positions.push_back(mesh_.positions[3 * v + k] + (k == 0 ? 1e-3 : 0));
    return copy;
  };
  std::vector<std::uint32_t> copies;
  for (int j = 0; j < 9; ++j) copies.push_back(split(j));
  for (std::size_t t = 0; t < mesh_.triangle_count(); ++t) {
    std::uint32_t* corner = &mesh_.triangles[3 * t];
    const bool is_right = std::any_of(corner, corner + 3, [](std::uint32_t v) { return v < 81 && v % 9 > 4; });
    for (int k = 0; is_right && k < 3; ++k) {
      if (corner[k] < 81 && corner[k] % 9 == 4) corner[k] = copies[corner[k] / 9];
    }
  }
  const Measurement m = judge();
  EXPECT_EQ(m.open_edges, 32u + 16);
  EXPECT_EQ(m.border_loops, 2u);
  EXPECT_EQ(m.overlaps, 0u);
  EXPECT_EQ(m.uncovered, 0u);
}

TEST_F(Faults, Degenerate) {
  const std::uint32_t a = vertex(0, 0);
  mesh_.triangles.insert(mesh_.triangles.end(), {a, a, vertex(1, 0)});
  const Measurement m = judge();
  EXPECT_EQ(m.degenerate, 1u);
  EXPECT_FALSE(m.is_sound());
}

TEST_F(Faults, ManyCopiesDoNotBlowUp) {
  const std::vector<std::uint32_t> all = mesh_.triangles;
  constexpr int kCopies = testing::fewer(150, 3);
  for (int copy = 0; copy < kCopies; ++copy) mesh_.triangles.insert(mesh_.triangles.end(), all.begin(), all.end());
  EXPECT_EQ(judge().overlaps, std::min<std::size_t>(1000000, all.size() / 3 * kCopies * (kCopies + 1) / 2));
}

TEST(Topology, WeldsVerticesOfOnePosition) {
  const Terrain terrain = wavy_terrain(9, 9);
  const Mesh mesh = grid_mesh(terrain, 2);
  Mesh soup;
  for (const std::uint32_t v : mesh.triangles) {
    soup.triangles.push_back(static_cast<std::uint32_t>(soup.vertex_count()));
    soup.positions.insert(soup.positions.end(), mesh.positions.begin() + 3 * v, mesh.positions.begin() + 3 * v + 3);
  }
  const auto m = measure(terrain.view(), soup);
  EXPECT_EQ(m->open_edges, 16u);
  EXPECT_EQ(m->border_loops, 1u);
  EXPECT_TRUE(m->is_sound());
}

TEST(Topology, CountsLoopsThatTouchInAVertex) {
  Terrain terrain = wavy_terrain(5, 5);
  Mesh mesh = grid_mesh(terrain, 1);
  // Two cells that share one vertex are removed: seen from the surface, one border surrounds both.
  const auto is_cut = [](std::size_t cell) { return cell == 5 || cell == 10; };
  std::vector<std::uint32_t> kept;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    if (!is_cut(t / 2)) kept.insert(kept.end(), mesh.triangles.begin() + 3 * t, mesh.triangles.begin() + 3 * t + 3);
  }
  mesh.triangles = kept;
  const auto m = measure(terrain.view(), mesh);
  EXPECT_EQ(m->open_edges, 16u + 8);
  EXPECT_EQ(m->uncovered, 0u);
  EXPECT_EQ(m->border_loops, 2u);
  EXPECT_EQ(m->gaps, 8u);
  EXPECT_FALSE(m->is_sound());
}

class Solids : public ::testing::Test {
 protected:
  /// A box over the whole terrain: flat top at `top`, flat bottom.
  static Mesh box(double x0, double y0, double x1, double y1, double bottom, double top) {
    Mesh mesh;
    for (const double z : {bottom, top}) {
      mesh.positions.insert(mesh.positions.end(), {x0, y0, z, x1, y0, z, x1, y1, z, x0, y1, z});
    }
    mesh.triangles = {4, 5, 6, 4, 6, 7, 0, 2, 1, 0, 3, 2, 0, 1, 5, 0, 5, 4,
                      1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};
    return mesh;
  }
  static void append(Mesh& mesh, const Mesh& other) {
    const auto first = static_cast<std::uint32_t>(mesh.vertex_count());
    mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
    for (const std::uint32_t v : other.triangles) mesh.triangles.push_back(first + v);
  }
  static Terrain flat(int cols, int rows, float height) {
    return {std::vector<float>(static_cast<std::size_t>(cols * rows), height), cols, rows, grid_frame(rows)};
  }
};

TEST_F(Solids, BoxIsJudgedOnItsTop) {
  const Terrain terrain = flat(6, 5, 3.0f);
  for (const bool topology : {true, false}) {
    MeasureOptions options;
    options.topology = topology;
    const auto m = measure(terrain.view(), box(0, 0, 5, 4, -10, 3.5), options);
    EXPECT_TRUE(m->closed);
    EXPECT_EQ(m->max_error, 0.5);
    EXPECT_EQ(m->samples, 30u);
    EXPECT_EQ(m->open_edges, 0u);
    EXPECT_EQ(m->overlaps, 0u);
    EXPECT_TRUE(m->is_sound());
    EXPECT_EQ(m->down_facing, topology ? 2u : 0u);
  }
}

TEST_F(Solids, MayTouchInAnEdge) {
  Terrain terrain = flat(5, 5, 1.0f);
  Mesh mesh = box(0, 0, 2, 2, -1, 1);
  append(mesh, box(2, 2, 4, 4, -1, 1));
  const auto m = measure(terrain.view(), mesh);
  EXPECT_TRUE(m->closed);
  EXPECT_EQ(m->non_manifold_edges, 0u);
  EXPECT_TRUE(m->is_sound());
}

TEST_F(Solids, AreNotClosedWithAHole) {
  Mesh mesh = box(0, 0, 5, 4, -10, 3);
  mesh.triangles.resize(mesh.triangles.size() - 3);
  const auto m = measure(flat(6, 5, 3.0f).view(), mesh);
  EXPECT_FALSE(m->closed);
  EXPECT_EQ(m->open_edges, 3u);
  EXPECT_GT(m->overlaps, 0u);  // top over bottom
  EXPECT_FALSE(m->is_sound());
}

}  // namespace
}  // namespace scarp::testing
