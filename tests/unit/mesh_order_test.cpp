#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "mesh_samples.h"

namespace scarp {
namespace {

/// Positions and attributes of a triangle's corners, rotated so that the smallest comes first.
std::vector<std::vector<double>> described(const Mesh& mesh) {
  std::vector<std::vector<double>> all;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    std::array<std::vector<double>, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t v = mesh.triangles[t + k];
      const auto p = mesh.vertex(v);
      corners[k].assign(p.begin(), p.end());
      for (std::size_t n = 0; n < 3 && !mesh.normals.empty(); ++n)
        corners[k].push_back(double{mesh.normals[3 * v + n]});
      for (std::size_t n = 0; n < 2 && !mesh.uvs.empty(); ++n) corners[k].push_back(double{mesh.uvs[2 * v + n]});
      for (std::size_t n = 0; n < 3 && !mesh.colors.empty(); ++n) corners[k].push_back(mesh.colors[3 * v + n]);
      const auto channels = static_cast<std::size_t>(mesh.channel_count);
      for (std::size_t n = 0; n < channels; ++n) corners[k].push_back(double{mesh.channels[channels * v + n]});
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    all.push_back({});
    for (const auto& corner : corners) all.back().insert(all.back().end(), corner.begin(), corner.end());
  }
  std::sort(all.begin(), all.end());
  return all;
}

Mesh shuffled(bool normals) {
  Mesh mesh = test::grid_mesh(
      30, 20, [](int i, int j) { return (i * j) % 7 != 3; }, normals);
  std::mt19937 random(1);
  for (std::size_t t = mesh.triangle_count() - 1; t > 0; --t) {
    const std::size_t other = random() % (t + 1);
    for (std::size_t k = 0; k < 3; ++k) std::swap(mesh.triangles[3 * t + k], mesh.triangles[3 * other + k]);
  }
  return mesh;
}

TEST(OptimizeOrder, KeepsTrianglesCornersAndWinding) {
  for (const bool normals : {false, true}) {
    Mesh mesh = shuffled(normals);
    mesh.positions.insert(mesh.positions.end(), {1, 2, 3});  // a vertex without triangles
    if (normals) {
      mesh.normals.insert(mesh.normals.end(), {0, 0, 1});
      test::add_attributes(mesh, 5);
    }
    const Mesh before = mesh;
    optimize_order(mesh);
    EXPECT_EQ(described(mesh), described(before));
    EXPECT_EQ(mesh.vertex_count() + 1, before.vertex_count());
    EXPECT_EQ(mesh.normals.size(), normals ? mesh.positions.size() : 0);
  }
}

TEST(OptimizeOrder, IsDeterministicAndNumbersVerticesByFirstUse) {
  Mesh a = shuffled(true), b = shuffled(true);
  optimize_order(a, 1);
  optimize_order(b, 4);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.positions, b.positions);
  std::uint32_t next = 0;
  for (const std::uint32_t vertex : a.triangles) {
    ASSERT_LE(vertex, next);
    if (vertex == next) ++next;
  }
}

TEST(OptimizeOrder, HelpsTheVertexCache) {
  const auto misses = [](const Mesh& mesh) {  // a cache of 16 vertices, first in, first out
    std::vector<std::size_t> entered(mesh.vertex_count(), 0);
    std::size_t clock = 17, count = 0;
    for (const std::uint32_t vertex : mesh.triangles) {
      if (clock - entered[vertex] > 16) {
        entered[vertex] = clock++;
        ++count;
      }
    }
    return static_cast<double>(count) / static_cast<double>(mesh.triangle_count());
  };
  Mesh mesh = shuffled(false);
  EXPECT_GT(misses(mesh), 2.0);
  optimize_order(mesh);
  EXPECT_LT(misses(mesh), 0.9);
}

TEST(OptimizeOrder, IsTheSameForAnyNumberOfThreads) {
  Mesh one = test::grid_mesh(200, 150, [](int i, int j) { return (i * j) % 7 != 3; });
  Mesh four = one;
  const Mesh before = one;
  optimize_order(one, 1);
  optimize_order(four, 4);
  EXPECT_EQ(one.triangles, four.triangles);
  EXPECT_EQ(one.positions, four.positions);
  EXPECT_EQ(described(one), described(before));
}

TEST(OptimizeOrder, TakesAnEmptyMesh) {
  Mesh mesh;
  mesh.positions = {1, 2, 3};
  optimize_order(mesh);
  EXPECT_EQ(mesh.vertex_count(), 0u);
}

}  // namespace
}  // namespace scarp
