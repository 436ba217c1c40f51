// Facts about solids, their placement, and solids for readers that use only positions.
#include <gtest/gtest.h>

#include <cmath>

#include "mesh_samples.h"
#include "scarp/mesh.h"

namespace scarp::solid_facts_test {
namespace {

using test::grid_mesh;

Mesh tetrahedron() {
  Mesh mesh;
  mesh.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 6};
  mesh.triangles = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
  return mesh;
}

TEST(MeasureSolid, TellsVolumePartsAndExtent) {
  Mesh mesh = tetrahedron();
  mesh.origin = {10, 20, 30};
  const SolidFacts facts = measure_solid(mesh);
  EXPECT_TRUE(facts.is_solid()) << facts.list_faults();
  EXPECT_EQ(facts.list_faults(), "");
  EXPECT_EQ(facts.triangles, 4u);
  EXPECT_EQ(facts.parts, 1u);
  EXPECT_DOUBLE_EQ(facts.volume, 1);
  EXPECT_EQ(facts.low, (std::array<double, 3>{10, 20, 30}));
  EXPECT_EQ(facts.high, (std::array<double, 3>{11, 21, 36}));
}

TEST(MeasureSolid, FindsEveryFault) {
  EXPECT_EQ(measure_solid({}).list_faults(), "no triangles");
  Mesh open = tetrahedron();
  open.triangles.resize(9);
  EXPECT_EQ(measure_solid(open).faulty_edges, 3u);
  Mesh inverted = tetrahedron();
  for (std::size_t t = 0; t < 4; ++t) std::swap(inverted.triangles[3 * t], inverted.triangles[3 * t + 1]);
  EXPECT_EQ(measure_solid(inverted).list_faults(), "1 part inside out");
  // Two tetrahedra that share a place but no edge.
  Mesh pinched = tetrahedron();
  for (const double x : {0, 0, 0, -1, 0, 0, 0, -1, 0, 0, 0, -6}) pinched.positions.push_back(x);
  for (const std::uint32_t v : {0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0}) pinched.triangles.push_back(4 + v);
  EXPECT_EQ(measure_solid(pinched).list_faults(), "1 pinched vertex");
  EXPECT_EQ(measure_solid(pinched).parts, 2u);
  // Corners that are distinct only in double.
  Mesh small = tetrahedron();
  small.positions[3] = 1e-60;
  const SolidFacts facts = measure_solid(small);
  EXPECT_FALSE(facts.is_solid());
  EXPECT_EQ(facts.degenerate, 2u);
}

TEST(BuildSolid, PartsThatTouchInAPointAreApart) {
  for (const double far : {0.0, 123456.0}) {
    Mesh board = grid_mesh(8, 8, [](int i, int j) { return (i + j) % 2 == 0; });
    for (std::size_t i = 0; i < board.positions.size(); i += 3) board.positions[i] += far;
    const auto solid = build_solid(board, -2);
    ASSERT_TRUE(solid) << solid.error().message;
    const SolidFacts facts = measure_solid(*solid);
    EXPECT_EQ(facts.parts, 32u);
    EXPECT_EQ(facts.triangles, board.triangle_count() + 32 * (4 + 4 + 2));
    // add_base() leaves vertices at one place, which readers of positions cannot distinguish.
    ASSERT_TRUE(add_base(board, -2));
    EXPECT_GT(measure_solid(board).faulty_edges, 0u);
  }
}

TEST(BuildSolid, RefusesWhatIsNoSolid) {
  const Mesh board = grid_mesh(3, 3, [](int, int) { return true; });
  const auto high = build_solid(board, 1e6);
  ASSERT_FALSE(high);
  EXPECT_EQ(high.error().kind, ErrorKind::kUsage);
  EXPECT_NE(high.error().message.find("is not below the lowest vertex"), std::string::npos);
  Mesh fine = board;
  for (double& coordinate : fine.positions) coordinate = 1e9 + coordinate;  // ulp 64
  const auto collapsed = build_solid(fine, 0);
  ASSERT_FALSE(collapsed);
  EXPECT_EQ(collapsed.error().kind, ErrorKind::kPromise);
  EXPECT_NE(collapsed.error().message.find("degenerate"), std::string::npos) << collapsed.error().message;
}

TEST(PlaceMesh, ComesBackAsTheRoundedPositionsSay) {
  Mesh mesh = tetrahedron();
  mesh.origin = {500000, 4000000, 0};
  mesh.positions[0] = 0.1;
  const Mesh before = mesh;
  const Placement placement{{500000.5, 4000000, -2}, {0.3, 0.3, 0.75}};
  place_mesh(mesh, placement);
  EXPECT_EQ(mesh.origin, (std::array<double, 3>{0, 0, 0}));
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    EXPECT_EQ(mesh.positions[i], double{static_cast<float>(mesh.positions[i])});
    EXPECT_NEAR(mesh.positions[i], (before.vertex(i / 3)[i % 3] - placement.origin[i % 3]) * placement.scale[i % 3],
                1e-6);
  }
  EXPECT_EQ(mesh.metadata["placement"], "500000.5 4000000 -2 0.3 0.3 0.75");
  ASSERT_TRUE(undo_placement(mesh));
  EXPECT_FALSE(mesh.metadata.contains("placement"));
  for (std::size_t v = 0; v < 4; ++v) {
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(mesh.vertex(v)[k], before.vertex(v)[k], 1e-6);
  }
  EXPECT_FALSE(undo_placement(mesh));
  for (const char* wrong : {"", "1 2 3 4 5", "1 2 3 1 1 0", "1 2 3 1 1 x", "0 0 0 1 -1 1"}) {
    mesh.metadata["placement"] = wrong;
    EXPECT_FALSE(undo_placement(mesh)) << wrong;
  }
}

}  // namespace
}  // namespace scarp::solid_facts_test
