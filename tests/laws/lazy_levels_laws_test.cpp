// The lazy order satisfies the dominant order's guarantee for any estimates.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <limits>

#include "laws/started_tiles.h"
#include "refine/dominant.h"
#include "refine/lazy_levels.h"

namespace scarp::lazy_levels_laws_test {
namespace {

using testing::Field;
using testing::Relief;
using testing::StartedTile;

constexpr refine::AreaPower kPowers[] = {refine::AreaPower::kHalf, refine::AreaPower::kOne};

refine::AreaPower any_power() { return *rc::gen::element(refine::AreaPower::kHalf, refine::AreaPower::kOne); }

std::size_t refine(const Field& field, double threshold, refine::AreaPower power, tin::TileMesh& mesh,
                   const geom::ScanKernels& kernels = geom::scan_kernels()) {
  StartedTile started;
  if (!testing::start(field, started)) return 0;
  refine::TileScanner scanner(started.tile.view(), threshold, kernels);
  const std::size_t before = started.mesh.vertex_count();
  const refine::DominantRun run = refine::refine_lazily(started.mesh, scanner, power);
  EXPECT_TRUE(run.finished);
  EXPECT_EQ(before + run.insertions, started.mesh.vertex_count());
  mesh = std::move(started.mesh);
  return mesh.vertex_count();
}

std::size_t count_waiting(const tin::TileMesh& mesh) {
  std::size_t waiting = 0;
  for (tin::TileMesh::Id t = 0; t < mesh.triangle_count(); ++t) waiting += mesh[t].key > 0;
  return waiting;
}

RC_GTEST_PROP(lazy_levels, ends_with_every_sample_within_the_bound_and_every_triangle_scanned, ()) {
  const Field field = testing::any_tile_field(48);
  const double threshold = testing::any_tile_threshold();
  StartedTile started;
  RC_PRE(testing::start(field, started));
  refine::TileScanner scanner(started.tile.view(), threshold);
  RC_ASSERT(refine::refine_lazily(started.mesh, scanner, any_power()).finished);
  RC_ASSERT(!scanner.has_given_up());
  RC_ASSERT(count_waiting(started.mesh) == 0u);
  const std::string unsound = testing::verify_tile_mesh(started.mesh, field.cols, field.rows);
  RC_ASSERT(unsound == "");
  const std::string broken = testing::find_broken_bound(field.raster(), started.mesh, threshold);
  RC_ASSERT(broken == "");
  // The guarantee of the dominant order: it finds nothing to insert.
  RC_ASSERT(refine::refine_dominant(started.mesh, scanner).insertions == 0u);
}

// A threshold of 0, or below the smallest normal float, must not cause estimates that mean "clean".
RC_GTEST_PROP(lazy_levels, keeps_thresholds_that_float32_holds_as_zero, ()) {
  const Field field = *rc::gen::element(false, true)
                          ? testing::sloping_field(*rc::gen::arbitrary<std::uint32_t>(), *rc::gen::inRange(2, 40),
                                                   *rc::gen::inRange(2, 40))
                          : testing::any_tile_field(32);
  const double threshold = *rc::gen::element(0.0, 1e-300, 0x1p-149, 0x1p-126, 0x1p-60, 0x1p-40, 0x1p-30, 0x1p-26);
  StartedTile started;
  RC_PRE(testing::start(field, started));
  refine::TileScanner scanner(started.tile.view(), threshold);
  refine::refine_lazily(started.mesh, scanner, any_power());
  RC_ASSERT(count_waiting(started.mesh) == 0u);
  RC_ASSERT(refine::refine_dominant(started.mesh, scanner).insertions == 0u);
  if (threshold > 0 && threshold < 0x1p-60) return;  // beyond the exact arithmetic of find_broken_bound()
  const std::string broken = testing::find_broken_bound(field.raster(), started.mesh, threshold);
  RC_ASSERT(broken == "");
}

RC_GTEST_PROP(lazy_levels, gives_the_same_mesh_by_every_kernel_and_every_time, ()) {
  const Field field = testing::any_tile_field(90);
  const double threshold = testing::any_tile_threshold();
  const refine::AreaPower power = any_power();
  tin::TileMesh first;
  const std::size_t vertices = refine(field, threshold, power, first);
  for (const geom::ScanKernels& kernels : geom::available_kernels()) {
    tin::TileMesh again;
    RC_ASSERT(refine(field, threshold, power, again, kernels) == vertices);
    RC_ASSERT(testing::triangles_of(again) == testing::triangles_of(first));
  }
}

TEST(lazy_levels, heights_and_thresholds_of_any_magnitude) {
  for (const float scale : {1e-30f, 1e-12f, 1e12f, 1e30f}) {
    Field field = testing::random_field(5, 40, 33, Relief::kReal);
    for (float& sample : field.samples) sample *= scale;
    if (!(*std::max_element(field.samples.begin(), field.samples.end()) <= geom::kMaxScanHeight)) continue;
    for (const double threshold : {0.0, 2.0 * scale, 1e300}) {
      for (const refine::AreaPower power : kPowers) {
        tin::TileMesh mesh;
        refine(field, threshold, power, mesh);
        EXPECT_EQ(testing::find_broken_bound(field.raster(), mesh, threshold), "") << scale << " " << threshold;
      }
    }
  }
}

TEST(lazy_levels, tiles_of_two_samples_a_side) {
  for (const auto& [cols, rows] : {std::pair{2, 2}, {2, 3}, {3, 2}, {2, 97}, {97, 2}, {3, 3}}) {
    for (const Relief relief : testing::kReliefs) {
      const Field field = testing::random_field(9, cols, rows, relief);
      for (const refine::AreaPower power : kPowers) {
        tin::TileMesh mesh;
        refine(field, 0, power, mesh);
        EXPECT_EQ(testing::verify_tile_mesh(mesh, cols, rows), "");
        EXPECT_EQ(testing::find_broken_bound(field.raster(), mesh, 0), "");
      }
    }
  }
}

TEST(lazy_levels, a_tile_without_surface_stays_as_it_is) {
  Field field = testing::random_field(3, 20, 20, Relief::kReal);
  for (float& sample : field.samples) sample = std::numeric_limits<float>::quiet_NaN();
  refine::Tile tile;
  tin::TileMesh mesh;
  ASSERT_TRUE(tile.load(field.view(), {0, 0, 20, 20}));
  ASSERT_TRUE(refine::start_tile(tile, {}, mesh));
  refine::TileScanner scanner(tile.view(), 1);
  EXPECT_EQ(refine::refine_lazily(mesh, scanner, refine::AreaPower::kOne).insertions, 0u);
}

TEST(lazy_levels, stops_at_the_most_vertices_allowed) {
  const Field field = testing::random_field(3, 60, 60, Relief::kReal);
  for (const refine::AreaPower power : kPowers) {
    for (const std::size_t most : {4u, 5u, 100u}) {
      StartedTile started;
      ASSERT_TRUE(testing::start(field, started));
      refine::TileScanner scanner(started.tile.view(), 0.5);
      EXPECT_FALSE(refine::refine_lazily(started.mesh, scanner, power, most).finished);
      EXPECT_EQ(started.mesh.vertex_count(), most);
    }
  }
}

TEST(lazy_levels, a_plane_needs_no_vertex_but_the_corners) {
  Field field{40, 30, {}};
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x) field.samples.push_back(static_cast<float>(3 * x - 7 * y) / 4.0f);
  for (const refine::AreaPower power : kPowers) {
    tin::TileMesh mesh;
    EXPECT_EQ(refine(field, 0, power, mesh), 4u);
  }
}

TEST(lazy_levels, takes_about_as_many_vertices_as_the_dominant_order_and_fewer_scans) {
  const Field field = testing::random_field(77, 200, 180, Relief::kReal);
  StartedTile started;
  ASSERT_TRUE(testing::start(field, started));
  refine::TileScanner scanner(started.tile.view(), 2);
  refine::refine_dominant(started.mesh, scanner);
  for (const refine::AreaPower power : kPowers) {
    StartedTile again;
    ASSERT_TRUE(testing::start(field, again));
    refine::TileScanner lazy_scanner(again.tile.view(), 2);
    refine::refine_lazily(again.mesh, lazy_scanner, power);
    EXPECT_NEAR(static_cast<double>(again.mesh.vertex_count()), static_cast<double>(started.mesh.vertex_count()),
                0.05 * static_cast<double>(started.mesh.vertex_count()));
    EXPECT_LT(lazy_scanner.triangles_scanned(), scanner.triangles_scanned());
  }
}

}  // namespace
}  // namespace scarp::lazy_levels_laws_test
