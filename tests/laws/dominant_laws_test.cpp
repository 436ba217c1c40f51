// The locally dominant order against its definition, and its promise on one tile.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <limits>
#include <optional>

#include "laws/started_tiles.h"
#include "refine/coarse_start.h"
#include "refine/dominant.h"

namespace scarp::dominant_laws_test {
namespace {

using testing::Field;
using testing::Relief;
using testing::start;
using Started = testing::StartedTile;

std::vector<geom::TilePoint> refine(const Field& field, double threshold, const geom::ScanKernels& kernels,
                                    tin::TileMesh& mesh) {
  Started started;
  if (!start(field, started)) return {};
  refine::TileScanner scanner(started.tile.view(), threshold, kernels);
  std::vector<geom::TilePoint> inserted;
  const refine::DominantRun run = refine::refine_dominant(started.mesh, scanner, SIZE_MAX, &inserted);
  EXPECT_TRUE(run.finished);
  EXPECT_EQ(run.insertions, inserted.size());
  mesh = std::move(started.mesh);
  return inserted;
}

RC_GTEST_PROP(dominant, ends_with_every_sample_within_the_bound, ()) {
  const Field field = testing::any_tile_field(48);
  const double threshold = testing::any_tile_threshold();
  Started started;
  RC_PRE(start(field, started));
  refine::TileScanner scanner(started.tile.view(), threshold);
  refine::refine_dominant(started.mesh, scanner);
  RC_ASSERT(!scanner.has_given_up());
  const std::string unsound = testing::verify_tile_mesh(started.mesh, field.cols, field.rows);
  RC_ASSERT(unsound == "");
  const std::string broken = testing::find_broken_bound(field.raster(), started.mesh, threshold);
  RC_ASSERT(broken == "");
}

// Only rounding errors occur; errors that float32 computes as 0 still count.
RC_GTEST_PROP(dominant, reproduces_slopes_that_float32_cannot_hold, ()) {
  const Field field =
      testing::sloping_field(*rc::gen::arbitrary<std::uint32_t>(), *rc::gen::inRange(2, 40), *rc::gen::inRange(2, 40));
  const double threshold = *rc::gen::element(0.0, 0x1p-60, 0x1p-40, 0x1p-30, 0x1p-26);
  tin::TileMesh mesh;
  refine(field, threshold, geom::scan_kernels(), mesh);
  const std::string broken = testing::find_broken_bound(field.raster(), mesh, threshold);
  RC_ASSERT(broken == "");
}

RC_GTEST_PROP(dominant, gives_the_same_mesh_by_every_kernel_and_every_time, ()) {
  const Field field = testing::any_tile_field(90);
  const double threshold = testing::any_tile_threshold();
  tin::TileMesh first;
  const auto inserted = refine(field, threshold, geom::scan_kernels(), first);
  for (const geom::ScanKernels& kernels : geom::available_kernels()) {
    tin::TileMesh again;
    RC_ASSERT(refine(field, threshold, kernels, again) == inserted);
    RC_ASSERT(testing::triangles_of(again) == testing::triangles_of(first));
  }
}

/// True if no triangle that the candidate of t removes, nor one beyond them, has a larger key.
bool is_local_maximum(tin::TileMesh& mesh, tin::TileMesh::Id t) {
  const std::int64_t key = mesh[t].key;
  const tin::TileMesh::Cavity cavity = mesh.find_cavity(t, refine::candidate_of(key));
  bool is_largest = true;
  for (const tin::TileMesh::Id removed : cavity.removed) is_largest = is_largest && mesh[removed].key <= key;
  for (const auto& side : cavity.sides)
    is_largest = is_largest &&
                 (side.beyond == tin::TileMesh::kBorder || mesh[tin::TileMesh::triangle_of(side.beyond)].key <= key);
  return is_largest;
}

void scan_all(tin::TileMesh& mesh, refine::TileScanner& scanner) {
  std::vector<tin::TileMesh::Id> all(mesh.triangle_count());
  std::iota(all.begin(), all.end(), 0u);
  scanner.scan(mesh, all, {});
}

/// A triangle whose candidate is p and a local maximum.
std::optional<tin::TileMesh::Id> find_maximum(tin::TileMesh& mesh, std::optional<geom::TilePoint> p) {
  for (tin::TileMesh::Id t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh[t].key > 0 && (!p || refine::candidate_of(mesh[t].key) == *p) && is_local_maximum(mesh, t)) return t;
  }
  return std::nullopt;
}

// The definition: each inserted sample was, in a mesh scanned from scratch, the worst candidate near it.
RC_GTEST_PROP(dominant, inserts_local_maxima_only_and_leaves_none, ()) {
  const Field field = testing::any_tile_field(22);
  const double threshold = testing::any_tile_threshold();
  tin::TileMesh refined;
  const auto inserted = refine(field, threshold, geom::scan_kernels(), refined);
  Started slow;
  RC_PRE(start(field, slow));
  refine::TileScanner scanner(slow.tile.view(), threshold, geom::available_kernels().back());
  scan_all(slow.mesh, scanner);
  for (const geom::TilePoint p : inserted) {
    const auto t = find_maximum(slow.mesh, p);
    RC_ASSERT(t.has_value());
    slow.mesh.find_cavity(*t, p);
    slow.mesh.fill_cavity(p);
    scan_all(slow.mesh, scanner);
  }
  RC_ASSERT(!find_maximum(slow.mesh, std::nullopt).has_value());
  if (testing::triangles_of(slow.mesh) != testing::triangles_of(refined))
    RC_ASSERT(slow.mesh.vertex_count() == refined.vertex_count());  // cocircular ties
}

// Any order of local maxima is valid: uses the first one found instead of the end of a walk.
TEST(dominant, another_order_of_local_maxima_keeps_the_bound_with_as_many_vertices) {
  for (const Relief relief : testing::kReliefs) {
    for (const double threshold : {0.5, 4.0}) {
      const Field field = testing::random_field(77, 48, 40, relief, 0.02);
      tin::TileMesh refined;
      refine(field, threshold, geom::scan_kernels(), refined);
      Started twin;
      ASSERT_TRUE(start(field, twin));
      refine::TileScanner scanner(twin.tile.view(), threshold);
      scan_all(twin.mesh, scanner);
      while (const auto t = find_maximum(twin.mesh, std::nullopt)) {
        const geom::TilePoint p = refine::candidate_of(twin.mesh[*t].key);
        twin.mesh.find_cavity(*t, p);
        scanner.scan(twin.mesh, twin.mesh.fill_cavity(p), {});
      }
      EXPECT_EQ(testing::verify_tile_mesh(twin.mesh, field.cols, field.rows), "");
      EXPECT_EQ(testing::find_broken_bound(field.raster(), twin.mesh, threshold), "");
      EXPECT_NEAR(static_cast<double>(twin.mesh.vertex_count()), static_cast<double>(refined.vertex_count()),
                  0.05 * static_cast<double>(refined.vertex_count()) + 8);
    }
  }
}

TEST(dominant, stops_at_the_most_vertices_allowed) {
  const Field field = testing::random_field(3, 60, 60, Relief::kReal);
  for (const std::size_t most : {4u, 5u, 100u}) {
    Started started;
    ASSERT_TRUE(start(field, started));
    refine::TileScanner scanner(started.tile.view(), 0.5);
    EXPECT_FALSE(refine::refine_dominant(started.mesh, scanner, most).finished);
    EXPECT_EQ(started.mesh.vertex_count(), most);
  }
}

TEST(dominant, a_plane_needs_no_vertex_but_the_corners) {
  Field field{40, 30, {}};
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x) field.samples.push_back(static_cast<float>(3 * x - 7 * y) / 4.0f);
  tin::TileMesh mesh;
  EXPECT_TRUE(refine(field, 0, geom::scan_kernels(), mesh).empty());
}

RC_GTEST_PROP(tile_scanner, ranks_what_breaks_the_bound_and_nothing_else, ()) {
  const Field field = testing::any_tile_field(30);
  const double threshold = testing::any_tile_threshold();
  Started started;
  RC_PRE(start(field, started));
  tin::TileMesh& mesh = started.mesh;
  refine::TileScanner scanner(started.tile.view(), threshold);
  refine::refine_dominant(mesh, scanner, 4 + *rc::gen::inRange<std::size_t>(0, 40));
  scan_all(mesh, scanner);
  for (tin::TileMesh::Id t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.is_outside(t)) continue;
    std::array<Point, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = geom::point_of(mesh[t].corners[k]);
    const bool breaks = testing::find_broken_bound(field.raster(), corners, threshold) != "";
    RC_ASSERT((mesh[t].key > 0) == breaks);
    if (breaks)
      RC_ASSERT(std::find(corners.begin(), corners.end(), geom::point_of(refine::candidate_of(mesh[t].key))) ==
                corners.end());
  }
}

/// Hills of some 200 samples.
Field hills(std::int32_t cols, std::int32_t rows) {
  Field field{cols, rows, {}};
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < cols; ++x)
      field.samples.push_back(static_cast<float>(100 * std::sin(x * 0.031) * std::cos(y * 0.027) + (x * y) % 3));
  return field;
}

TEST(coarse_start, puts_no_vertex_on_a_shared_side_and_leaves_a_sound_mesh) {
  constexpr double kBound = 20;
  for (const auto& [cols, rows] : {std::pair{257, 257}, {300, 199}, {129, 131}, {40, 400}}) {
    const Field field = hills(cols, rows);
    for (const refine::SharedSides shared : {refine::SharedSides{}, refine::SharedSides{true, true, true, true},
                                             refine::SharedSides{true, false, false, true}}) {
      Started started;
      ASSERT_TRUE(start(field, started));
      refine::CoarseStart coarse;
      coarse.insert(started.tile, shared, kBound, 0, false, started.mesh);
      EXPECT_EQ(testing::verify_tile_mesh(started.mesh, cols, rows), "");
      EXPECT_EQ(started.mesh.vertex_count() > 4, std::min(cols, rows) > 64);
      for (tin::TileMesh::Id t = 0; t < started.mesh.triangle_count(); ++t) {
        for (const geom::TilePoint p : started.mesh[t].corners) {
          const std::int32_t x = geom::tile_x(p), y = geom::tile_y(p);
          const bool is_corner = (x == 0 || x == cols - 1) && (y == 0 || y == rows - 1);
          EXPECT_TRUE(is_corner || !((shared.left && x == 0) || (shared.top && y == 0) ||
                                     (shared.right && x == cols - 1) || (shared.bottom && y == rows - 1)));
        }
      }
      refine::TileScanner scanner(started.tile.view(), kBound);
      refine::refine_dominant(started.mesh, scanner);
      EXPECT_EQ(testing::find_broken_bound(field.raster(), started.mesh, kBound), "");
    }
  }
}

TEST(coarse_start, is_left_out_where_the_mesh_will_be_dense) {
  const Field field = hills(257, 257);
  Started started;
  ASSERT_TRUE(start(field, started));
  refine::CoarseStart coarse;
  coarse.insert(started.tile, {}, 5, 0.5, true, started.mesh);
  EXPECT_EQ(started.mesh.vertex_count(), 4u);
  EXPECT_EQ(coarse.work().triangles_scanned, 0u);
}

}  // namespace
}  // namespace scarp::dominant_laws_test
