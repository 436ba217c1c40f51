#include "pieces/freeze.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "laws/sanitized.h"

namespace scarp {
namespace {

constexpr std::int32_t kCols = 400, kRows = 300;

/// A map whose offsets are not exact in float32.
class Bent final : public PointTransform {
 public:
  bool apply(std::span<double> x, std::span<double> y) const override {
    for (std::size_t k = 0; k < x.size(); ++k) {
      const double bent = x[k] * 30.1 + y[k] * y[k] / 3e3;
      y[k] = y[k] * 30.3 + x[k] / 7;
      x[k] = bent;
    }
    return true;
  }
};

struct Scene {
  std::vector<float> samples;
  tin::Triangulation tin{kCols, kRows};

  /// `with_outside`: marks the left part outside, including corners of the rectangle.
  explicit Scene(bool with_outside) {
    for (std::int32_t i = 0; i < kCols * kRows; ++i) samples.push_back(std::sin(static_cast<float>(i)) * 50);
    std::mt19937 random(7);
    for (int i = 0; i < 50'000; ++i) {
      const Point p{static_cast<std::int32_t>(random() % kCols), static_cast<std::int32_t>(random() % kRows)};
      tin.insert(p, tin.locate(p, tin.last_touched()));
    }
    for (tin::Triangle t = 0; with_outside && t < tin.triangle_count(); ++t) {
      const auto [a, b, c] = tin.corners(t);
      if (a.x + b.x + c.x < 150) tin.set_outside(t, true);
    }
  }
  pieces::SampleHeights heights() const { return pieces::SampleHeights(grid::Raster{samples.data(), kCols, kRows}); }
  /// Arrays cannot be copied.
  tin::Triangulation copy() const {
    tin::Triangulation::Arrays arrays;
    for (tin::Vertex v = 0; v < tin.vertex_count(); ++v) arrays.points.push_back(tin.point(v));
    for (tin::HalfEdge h = 0; h < 3 * tin.triangle_count(); ++h) {
      arrays.corners.push_back(tin.origin(h));
      arrays.twins.push_back(tin.twin(h));
    }
    for (tin::Triangle t = 0; t < tin.triangle_count(); ++t)
      arrays.flags.push_back(tin.is_outside(t) ? tin::Triangulation::Arrays::kOutside : std::uint8_t{0});
    return tin::Triangulation(std::move(arrays));
  }
};

/// In metres or thirds of metres: offsets are not exact in float32.
std::vector<Frame> frames() {
  Frame plain = grid_frame(kRows);
  plain.affine[1] = 1 / 3.0;
  Frame mirrored = plain, bent = plain;
  mirrored.affine[5] = 30.7;
  bent.transform = std::make_shared<Bent>();
  return {plain, mirrored, bent};
}

void expect_same(const Mesh& a, const Mesh& b) {
  EXPECT_EQ(a.origin, b.origin);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.positions, b.positions);
}

TEST(freeze, melts_down_to_the_same_mesh_for_any_number_of_threads) {
  for (const bool with_outside : {false, true}) {
    if (testing::kIsSanitized && !with_outside) continue;
    const Scene scene(with_outside);
    const pieces::SampleHeights heights = scene.heights();
    const grid::VertexLattice lattice;
    for (const Frame& frame : frames()) {
      for (const bool rounds : {false, true}) {
        const pieces::VertexPositions way{heights, lattice, frame, rounds};
        Mesh frozen = pieces::freeze(scene.tin, way);
        expect_same(pieces::freeze(scene.tin, way, 4), frozen);
        expect_same(pieces::MeltDown(scene.copy(), way, 4).finish(), frozen);
        optimize_order(frozen);
        for (const int threads : {1, 4}) {
          pieces::MeltDown melting(scene.copy(), way, threads);
          melting.order();
          EXPECT_EQ(melting.vertex_count(), frozen.vertex_count());
          EXPECT_EQ(melting.triangle_count(), frozen.triangle_count());
          expect_same(melting.finish(), frozen);
        }
      }
    }
  }
}

TEST(freeze, rounds_every_coordinate_to_float32) {
  const Scene scene(false);
  const pieces::SampleHeights heights = scene.heights();
  const grid::VertexLattice lattice;
  for (const Frame& frame : frames()) {
    const auto count_rounded = [&](const Mesh& mesh) {
      std::array<std::size_t, 3> counts{};
      for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        counts[i % 3] += double{static_cast<float>(mesh.positions[i])} == mesh.positions[i];
      return counts;
    };
    const std::size_t all = scene.tin.vertex_count();
    const std::array<std::size_t, 3> every{all, all, all};
    EXPECT_EQ(count_rounded(pieces::freeze(scene.tin, {heights, lattice, frame, true})), every);
    EXPECT_EQ(count_rounded(pieces::MeltDown(scene.copy(), {heights, lattice, frame, true}, 1).finish()), every);
    EXPECT_LT(count_rounded(pieces::freeze(scene.tin, {heights, lattice, frame, false}))[0], all);
  }
}

TEST(freeze, knows_the_points_of_its_vertices) {
  const Scene scene(true);
  const pieces::SampleHeights heights = scene.heights();
  const grid::VertexLattice lattice;
  const Frame frame = grid_frame(kRows);
  const pieces::VertexPositions way{heights, lattice, frame, true};
  pieces::MeltDown melting(scene.copy(), way, 1);
  melting.order();
  const Mesh ordered = melting.finish(), frozen = pieces::freeze(scene.tin, way);
  for (const auto& [mesh, at] :
       {std::pair(ordered, melting.points()), std::pair(frozen, pieces::frozen_points(scene.tin, lattice))}) {
    ASSERT_EQ(at.points.size(), mesh.vertex_count());
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
      const std::array<double, 3> place = mesh.vertex(v);
      EXPECT_EQ(place[0], at.points[v].x);
      EXPECT_EQ(place[1], kRows - 1 - at.points[v].y);
    }
  }
}

}  // namespace
}  // namespace scarp
