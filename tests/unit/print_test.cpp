// Prints: the written solid is closed and satisfies the bound.
#include "scarp/print.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "laws/fields.h"
#include "laws/point_sets.h"
#include "scarp/measure.h"

namespace scarp::testing {
namespace {

OwnedHeightField owned(const Field& field) {
  OwnedHeightField held;
  held.samples = field.samples;
  held.cols = field.cols;
  held.rows = field.rows;
  held.frame = grid_frame(field.rows);
  return held;
}

TEST(Print, KeepsItsBoundAsItIsWritten) {
  const Field field = random_field(6, 80, 60, Relief::kRidges);
  for (const double error : {0.5, 5.0}) {
    OwnedHeightField held = owned(field);
    PrintOptions print;
    print.size = 120;
    print.exaggerate = 1.5;
    SimplifyOptions options;
    options.goals.max_error = error;
    const auto printed = simplify_for_print(held, print, options);
    ASSERT_TRUE(printed) << printed.error().message;
    ASSERT_EQ(printed->print.tiles.size(), 1u);
    const PrintTile& tile = printed->print.tiles.front();
    EXPECT_TRUE(tile.facts.is_solid()) << tile.facts.list_faults();
    EXPECT_LE(printed->print.max_error, error);
    EXPECT_EQ(printed->print.uncovered, 0u);
    EXPECT_EQ(printed->print.vertices(), tile.mesh.vertex_count());
    const double longest = std::max(tile.facts.high[0] - tile.facts.low[0], tile.facts.high[1] - tile.facts.low[1]);
    EXPECT_LE(longest, 120.001);
    EXPECT_GE(longest, 119.99);
    EXPECT_EQ(tile.facts.low[2], 0);
    EXPECT_EQ(printed->print.placement.scale[2], 1.5 * printed->print.placement.scale[0]);

    Mesh back = tile.mesh;
    ASSERT_TRUE(undo_placement(back));
    const auto judged = measure(held, back, {.topology = false});
    ASSERT_TRUE(judged);
    EXPECT_LE(judged->max_error, error * (1 + 1e-9));
  }
}

TEST(Print, OfPointsKeepsItsBoundAsItIsWrittenByBruteForce) {
  for (const Scatter scatter : {Scatter::kWhole, Scatter::kUtm, Scatter::kTiny, Scatter::kStreets}) {
    const PointSet points = random_points(11, 300, scatter, Heights::kReal);
    for (const bool is_placed : {true, false}) {
      PrintOptions print;
      if (is_placed) print.size = 120;
      PointOptions options{.max_error = 8};
      options.quality.effort = is_placed ? Effort::kHigh : Effort::kNormal;
      const auto printed = simplify_for_print(points, print, options);
      ASSERT_TRUE(printed) << printed.error().message;
      ASSERT_EQ(printed->print.tiles.size(), 1u);
      const PrintTile& tile = printed->print.tiles.front();
      EXPECT_TRUE(tile.facts.is_solid()) << tile.facts.list_faults();
      EXPECT_LE(printed->print.max_error, 8);
      const double longest = std::max(tile.facts.high[0] - tile.facts.low[0], tile.facts.high[1] - tile.facts.low[1]);
      if (is_placed) {
        EXPECT_NEAR(longest, 120, 0.01);
      }

      Mesh tops = tile.mesh;
      EXPECT_EQ(undo_placement(tops), is_placed);
      tops.triangles.resize(3 * printed->made.simplified.mesh.triangle_count());
      for (std::size_t v = 0; v < tops.vertex_count(); ++v) tops.positions[3 * v + 2] += tops.origin[2];
      PointSet distinct;  // duplicates are no samples
      for (std::size_t i = 0; i < points.size(); ++i) {
        bool is_first = true;
        for (std::size_t k = 0; k < i; ++k) is_first &= points.x[k] != points.x[i] || points.y[k] != points.y[i];
        if (!is_first) continue;
        distinct.x.push_back(points.x[i]);
        distinct.y.push_back(points.y[i]);
        distinct.z.push_back(points.z[i]);
      }
      EXPECT_LE(judge_by_brute_force(distinct, tops).second, 8 + 1e-6);
    }
  }
}

TEST(Print, OfPointsIsNotSplit) {
  PrintOptions print;
  print.columns = 2;
  const auto printed =
      simplify_for_print(random_points(1, 30, Scatter::kUtm, Heights::kReal), print, PointOptions{.max_error = 8});
  ASSERT_FALSE(printed);
  EXPECT_EQ(printed.error().kind, ErrorKind::kUsage);
}

TEST(Print, IsCutIntoPrintTiles) {
  const Field field = random_field(7, 100, 80, Relief::kRidges);
  OwnedHeightField held = owned(field);
  PrintOptions print;
  print.size = 200;
  print.columns = 2;
  print.rows = 2;
  print.dovetail = true;
  SimplifyOptions options;
  options.goals.max_error = 4;
  const auto printed = simplify_for_print(held, print, options);
  ASSERT_TRUE(printed) << printed.error().message;
  ASSERT_EQ(printed->print.tiles.size(), 4u);
  EXPECT_EQ(printed->print.empty_tiles, 0);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(printed->print.tiles[k].row, static_cast<int>(k) / 2 + 1);
    EXPECT_EQ(printed->print.tiles[k].column, static_cast<int>(k) % 2 + 1);
    EXPECT_TRUE(printed->print.tiles[k].facts.is_solid());
  }
  EXPECT_EQ(printed->print.uncovered, 0u);
  EXPECT_LE(printed->print.max_error, 4);
  EXPECT_EQ(printed->simplified.lines_inserted, 0u) << "cuts are no lines of the caller's";
  print.gap = 2;
  const auto gapped = simplify_for_print(held, print, options);
  ASSERT_TRUE(gapped) << gapped.error().message;
  EXPECT_GT(gapped->print.uncovered, 0u);
}

TEST(Print, HasItsUndersideWhereItIsAsked) {
  const Field field = random_field(8, 30, 30, Relief::kReal);
  OwnedHeightField held = owned(field);
  SimplifyOptions options;
  options.goals.max_error = 1;
  PrintOptions print;
  print.base = -80.25;
  const auto low = simplify_for_print(held, print, options);
  ASSERT_TRUE(low) << low.error().message;
  EXPECT_EQ(low->print.tiles.front().facts.low[2], -80.25);
  print.base.reset();
  print.size = 100;
  print.printed_thickness = 3;
  const auto thick = simplify_for_print(held, print, options);
  ASSERT_TRUE(thick);
  const double lowest = low->print.heights.min;
  EXPECT_NEAR((lowest - thick->print.base) * thick->print.placement.scale[2], 3, 0.01);
}

TEST(Print, RefusesWhatCannotBe) {
  const Field field = random_field(9, 30, 30, Relief::kReal);
  OwnedHeightField held = owned(field);
  SimplifyOptions options;
  options.goals.max_error = 1;
  const auto message = [&](const PrintOptions& print) {
    const auto printed = simplify_for_print(held, print, options);
    EXPECT_FALSE(printed);
    if (printed) return std::string();
    EXPECT_EQ(printed.error().kind, ErrorKind::kUsage) << printed.error().message;
    return printed.error().message;
  };
  EXPECT_TRUE(message({.base = 300}).starts_with("base=300 is not below the lowest vertex"));
  EXPECT_TRUE(message({.base = 0, .thickness = 1}).starts_with("base cannot be combined with thickness"));
  EXPECT_TRUE(message({.size = 0}).starts_with("size=0 is not above 0"));
  EXPECT_TRUE(message({.exaggerate = -1}).starts_with("exaggerate=-1"));
  EXPECT_TRUE(message({.columns = 90, .rows = 1}).starts_with("print tiles: "));
  EXPECT_TRUE(message({.columns = 0}).starts_with("print tiles: "));
  EXPECT_TRUE(message({.gap = 1}).starts_with("print tiles: "));
  PrintOptions fine;
  fine.size = 1e-3;
  options.goals.max_error = 0;
  const auto none = simplify_for_print(held, fine, options);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().kind, ErrorKind::kPromise);
}

}  // namespace
}  // namespace scarp::testing
