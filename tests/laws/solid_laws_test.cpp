// Solids and print tiles of random terrains: closed for readers of positions only, with the volume below the surface,
// and within the bound.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "any_field.h"
#include "mesh/print_tiles.h"
#include "scarp/io.h"
#include "scarp/mesh.h"
#include "scarp/simplify.h"

namespace scarp::solid_laws_test {
namespace {

using testing::any_field;

double volume_over(const Mesh& terrain, double base) {
  double volume = 0;
  for (std::size_t t = 0; t < terrain.triangles.size(); t += 3) {
    const auto a = terrain.vertex(terrain.triangles[t]), b = terrain.vertex(terrain.triangles[t + 1]),
               c = terrain.vertex(terrain.triangles[t + 2]);
    const double area = ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
    volume += area * ((a[2] - base) + (b[2] - base) + (c[2] - base)) / 3;
  }
  return volume;
}

double lowest_of(const Mesh& terrain) {
  double lowest = terrain.vertex(0)[2];
  for (std::size_t v = 0; v < terrain.vertex_count(); ++v) lowest = std::min(lowest, terrain.vertex(v)[2]);
  return lowest;
}

/// The part above `base`, placed on a print with a few millimetres per cell.
Placement any_placement(double base) {
  const double scale = *rc::gen::element(0.25, 1.0, 0.3, 1.7);
  return {{0, 0, base}, {scale, scale, scale * *rc::gen::element(1.0, 0.1, 2.5)}};
}

RC_GTEST_PROP(SolidLaws, ClosedAndAsLargeAsWhatLiesUnderTheSurface, ()) {
  const auto field = any_field(14);
  const auto simplified = simplify(field.view(), {.goals = {.max_error = *rc::gen::element(0.0, 0.7, 20.0)}});
  if (!simplified) RC_DISCARD("no valid cell");
  Mesh terrain = simplified->mesh;
  const double base = lowest_of(terrain) - *rc::gen::element(0.5, 3.0, 100.0);
  const Placement placement = any_placement(base);
  const double expected = volume_over(terrain, base) * placement.scale[0] * placement.scale[1] * placement.scale[2];
  place_mesh(terrain, placement);
  const auto solid = build_solid(terrain, 0);
  RC_ASSERT(solid.has_value());
  const SolidFacts facts = measure_solid(*solid);
  RC_ASSERT(facts.is_solid());
  RC_ASSERT(std::abs(facts.volume - expected) <= 1e-5 * expected);
  // The files contain the same solid and its position.
  for (const MeshFormat format : {MeshFormat::kStl, MeshFormat::k3mf}) {
    const auto bytes = encode_mesh(*solid, format);
    RC_ASSERT(bytes.has_value());
    auto back = decode_mesh(*bytes, "solid");
    RC_ASSERT(back.has_value());
    RC_ASSERT(back->triangle_count() == solid->triangle_count());
    const SolidFacts again = measure_solid(*back);
    RC_ASSERT(again.is_solid());
    RC_ASSERT(again.volume == facts.volume);
    RC_ASSERT(back->metadata.at("placement") == solid->metadata.at("placement"));
    RC_ASSERT(undo_placement(*back));
    const auto judged = measure(field.view(), *back);
    RC_ASSERT(judged.has_value());
    RC_ASSERT(judged->closed);
    RC_ASSERT(judged->uncovered == 0u);
    RC_ASSERT(judged->max_error <= simplified->measurement.max_error + 1e-2);
  }
}

RC_GTEST_PROP(SolidLaws, PrintTilesAreTheWholeAndKeepTheBound, ()) {
  auto field = any_field(40);
  const double bound = *rc::gen::element(0.5, 5.0, 30.0);
  mesh::PrintTileOptions options;
  options.columns = *rc::gen::inRange(1, 4);
  options.rows = *rc::gen::inRange(1, 4);
  options.dovetail = *rc::gen::arbitrary<bool>();
  options.gap = *rc::gen::element(0.0, 0.0, 0.11);
  const auto plan = mesh::PrintTilePlan::make(field.cols, field.rows, options);
  if (!plan) RC_DISCARD("too few samples");
  SimplifyOptions simplify_options{.goals = {.max_error = bound}, .output = {.float32_positions = false}};
  simplify_options.features.breaklines.lines = plan->lines(simplify_options.features.breaklines.affine);
  const HeightField view = field.view();
  const auto simplified = simplify(view, simplify_options);
  if (!simplified) RC_DISCARD("no valid cell");
  const double base = lowest_of(simplified->mesh) - 1;
  const Placement placement{{0, 0, base}, {1, 1, 1}};
  double volume = 0;
  Mesh tops;
  std::size_t triangles = 0;
  for (Mesh& tile : mesh::cut_print_tiles(simplified->mesh, view.frame, *plan)) {
    if (tile.triangles.empty()) continue;
    place_mesh(tile, placement);
    const std::size_t corners = tile.triangles.size();
    triangles += corners / 3;
    const auto solid = build_solid(std::move(tile), 0);
    RC_ASSERT(solid.has_value());
    const SolidFacts facts = measure_solid(*solid);
    RC_ASSERT(facts.is_solid());
    volume += facts.volume;
    Mesh back = *solid;
    RC_ASSERT(undo_placement(back));
    const auto first = static_cast<std::uint32_t>(tops.vertex_count());
    tops.origin = back.origin;
    tops.positions.insert(tops.positions.end(), back.positions.begin(), back.positions.end());
    for (std::size_t i = 0; i < corners; ++i) tops.triangles.push_back(first + back.triangles[i]);
  }
  const double whole = volume_over(simplified->mesh, base);
  const auto judged = measure(view, tops);
  RC_ASSERT(judged.has_value());
  RC_ASSERT(judged->overlaps == 0u);
  RC_ASSERT(judged->max_error <= bound + 1e-2);
  if (options.gap == 0) {
    RC_ASSERT(triangles == simplified->mesh.triangle_count());
    RC_ASSERT(std::abs(volume - whole) <= 1e-5 * whole);
    RC_ASSERT(judged->uncovered == 0u);
  } else {
    RC_ASSERT(volume < whole * (1 + 1e-5));
  }
}

TEST(PrintTilePlan, EverySampleIsInOnePrintTileAndTabsReachOver) {
  mesh::PrintTileOptions options;
  options.columns = 2;
  options.rows = 3;
  options.dovetail = true;
  const auto plan = mesh::PrintTilePlan::make(101, 121, options);
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->lines({0, 1, 0, 0, 0, 1}).size(), 3u);
  EXPECT_EQ(plan->tile_at(0.5, 0.5), 0);
  EXPECT_EQ(plan->tile_at(99.5, 0.5), 1);
  EXPECT_EQ(plan->tile_at(0.5, 119.5), 4);
  EXPECT_EQ(plan->tile_at(52, 20.5), 0) << "the tab in the middle of the first row of print tiles";
  EXPECT_EQ(plan->tile_at(52, 3), 1);
  EXPECT_EQ(plan->tile_at(25, 42), 0);
  EXPECT_EQ(plan->tile_at(3, 42), 2);
  options.gap = 0.5;
  const auto apart = mesh::PrintTilePlan::make(101, 121, options);
  ASSERT_TRUE(apart);
  EXPECT_EQ(apart->lines({0, 1, 0, 0, 0, 1}).size(), 6u);
  EXPECT_EQ(apart->tile_at(50.2, 3), std::nullopt);
  EXPECT_EQ(apart->tile_at(50.3, 3), 1);
  EXPECT_EQ(apart->tile_at(49.7, 3), 0);
}

TEST(PrintTilePlan, RefusesWhatIsTooNarrow) {
  mesh::PrintTileOptions options;
  options.columns = 5;
  EXPECT_FALSE(mesh::PrintTilePlan::make(8, 8, options));
  EXPECT_TRUE(mesh::PrintTilePlan::make(11, 8, options));
  options.dovetail = true;
  const auto narrow = mesh::PrintTilePlan::make(50, 50, options);
  ASSERT_FALSE(narrow);
  EXPECT_EQ(narrow.error().kind, ErrorKind::kUsage);
  EXPECT_NE(narrow.error().message.find("12 cells"), std::string::npos);
  options.gap = 10;
  EXPECT_FALSE(mesh::PrintTilePlan::make(500, 500, options));
}

}  // namespace
}  // namespace scarp::solid_laws_test
