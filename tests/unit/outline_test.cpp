#include "grid/outline.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include "laws/fields.h"
#include "tin/triangulation.h"

namespace scarp {
namespace {

/// 'x' is valid, '.' nodata.
testing::Field field_of(const std::vector<std::string>& picture) {
  testing::Field field{static_cast<std::int32_t>(picture[0].size()), static_cast<std::int32_t>(picture.size()), {}};
  for (const auto& row : picture)
    for (char c : row) field.samples.push_back(c == 'x' ? 1.0f : std::numeric_limits<float>::quiet_NaN());
  return field;
}

std::int64_t twice_area(const std::vector<Point>& polygon) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) sum += orient({0, 0}, polygon[i], polygon[(i + 1) % polygon.size()]);
  return sum;
}

std::int64_t twice_area(const grid::Outline& outline) {
  std::int64_t sum = 0;
  for (const auto& polygon : outline) sum += twice_area(polygon);
  return sum;
}

TEST(outline, a_whole_raster_is_its_rectangle) {
  const auto field = field_of({"xxx", "xxx"});
  EXPECT_TRUE(grid::is_whole(field.raster()));
  const grid::Outline outline = grid::trace_outline(field.raster());
  ASSERT_EQ(outline.size(), 1u);
  EXPECT_EQ(outline[0].size(), 4u);
  EXPECT_EQ(twice_area(outline), 4);
}

TEST(outline, a_nodata_corner_leaves_half_a_cell) {
  const grid::Outline outline = grid::trace_outline(field_of({".x", "xx"}).raster());
  ASSERT_EQ(outline.size(), 1u);
  EXPECT_EQ(outline[0].size(), 3u);
  EXPECT_EQ(twice_area(outline), 1);
}

TEST(outline, a_nodata_sample_inside_makes_a_hole_of_half_cells) {
  const grid::Outline outline = grid::trace_outline(field_of({"xxxxx", "xxxxx", "xx.xx", "xxxxx", "xxxxx"}).raster());
  ASSERT_EQ(outline.size(), 2u);
  EXPECT_EQ(twice_area(outline[0]), 32);
  EXPECT_EQ(twice_area(outline[1]), -4) << "a diamond, negative";
}

TEST(outline, parts_that_touch_in_a_sample_are_polygons_of_their_own) {
  const grid::Outline outline = grid::trace_outline(field_of({"xxx", "x.x", "xxx"}).raster());
  ASSERT_EQ(outline.size(), 4u) << "four half cells that meet in the middles of the sides";
  for (const auto& polygon : outline) EXPECT_EQ(twice_area(polygon), 1);
}

TEST(outline, samples_without_a_cell_have_none) {
  EXPECT_TRUE(grid::trace_outline(field_of({"x.x", ".x.", "x.x"}).raster()).empty());
}

RC_GTEST_PROP(outline, encloses_exactly_the_cells, ()) {
  const auto field =
      testing::random_field(*rc::gen::arbitrary<std::uint32_t>(), *rc::gen::inRange(2, 30), *rc::gen::inRange(2, 30),
                            testing::Relief::kTies, *rc::gen::element(0.05, 0.3, 0.7));
  const grid::Raster raster = field.raster();
  std::int64_t cells = 0;
  for (std::int32_t y = 0; y + 1 < raster.rows; ++y) {
    for (std::int32_t x = 0; x + 1 < raster.cols; ++x) {
      const int valid = std::popcount(grid::valid_corners(raster, x, y));
      cells += valid == 4 ? 2 : valid == 3 ? 1 : 0;
    }
  }
  const grid::Outline outline = grid::trace_outline(raster);
  RC_ASSERT(twice_area(outline) == cells);
  std::map<std::pair<int, int>, int> passes;
  for (const auto& polygon : outline)
    for (Point p : polygon) ++passes[{p.x, p.y}];
  for (const auto& polygon : outline) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point p = polygon[(i + 1) % polygon.size()];
      if (passes[{p.x, p.y}] == 1) RC_ASSERT(orient(polygon[i], p, polygon[(i + 2) % polygon.size()]) != 0);
    }
  }
}

RC_GTEST_PROP(outline, simplified_grows_and_has_no_more_vertices, ()) {
  const auto field = testing::random_field(*rc::gen::arbitrary<std::uint32_t>(), 40, 40, testing::Relief::kTies,
                                           *rc::gen::element(0.05, 0.3));
  const grid::Outline exact = grid::trace_outline(field.raster());
  const grid::Outline simple = grid::simplify_outline(field.raster(), exact, *rc::gen::element(0.5, 1.0, 2.5));
  RC_ASSERT(simple.size() == exact.size());
  for (std::size_t k = 0; k < exact.size(); ++k) {
    RC_ASSERT(simple[k].size() <= exact[k].size());
    RC_ASSERT(simple[k].size() >= 3u);
    RC_ASSERT(twice_area(simple[k]) >= twice_area(exact[k]));
  }
  tin::Triangulation tin(40, 40);
  const auto vertex = [&](Point p) { return tin.insert(p, tin.locate(p, tin.last_touched())); };
  for (const auto& polygon : simple)
    for (Point p : polygon) vertex(p);
  for (const auto& polygon : simple) {
    for (std::size_t i = 0; i < polygon.size(); ++i)
      RC_ASSERT(tin.constrain(vertex(polygon[i]), vertex(polygon[(i + 1) % polygon.size()])));
  }
}

TEST(outline, a_diagonal_staircase_becomes_one_edge) {
  // Steps of two by one: the exact outline turns at every step.
  testing::Field field{41, 21, std::vector<float>(41 * 21, 1.0f)};
  for (std::int32_t y = 0; y < 21; ++y)
    for (std::int32_t x = 2 * y + 1; x < 41; ++x)
      field.samples[static_cast<std::size_t>(41 * y + x)] = std::numeric_limits<float>::quiet_NaN();
  const grid::Outline exact = grid::trace_outline(field.raster());
  const grid::Outline simple = grid::simplify_outline(field.raster(), exact, 1);
  ASSERT_EQ(simple.size(), 1u);
  EXPECT_GT(exact[0].size(), 20u);
  EXPECT_LE(simple[0].size(), 6u);
}

TEST(outline, a_round_void_takes_the_fewest_chords) {
  testing::Field field{120, 120, std::vector<float>(14400, 1.0f)};
  for (std::int32_t y = 0; y < 120; ++y) {
    for (std::int32_t x = 0; x < 120; ++x) {
      const bool is_void = (x - 60) * (x - 60) + (y - 60) * (y - 60) < 1400;
      if (is_void) field.samples[static_cast<std::size_t>(120 * y + x)] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  const grid::Outline simple = grid::simplify_outline(field.raster(), grid::trace_outline(field.raster()), 1.5);
  ASSERT_EQ(simple.size(), 2u);
  EXPECT_EQ(simple[0].size(), 4u);
  EXPECT_EQ(simple[1].size(), 16u) << "two in each octant; the farthest corner from each on took 20";
}

std::size_t voids_left(const std::vector<std::string>& picture, double tolerance) {
  const auto field = field_of(picture);
  return grid::close_voids(field.raster(), grid::trace_outline(field.raster()), tolerance).size() - 1;
}

TEST(outline, voids_close_where_they_are_nowhere_farther_from_their_outline) {
  const std::vector<std::string> one{"xxxxx", "xxxxx", "xx.xx", "xxxxx", "xxxxx"};
  EXPECT_EQ(voids_left(one, 0.7), 1u) << "a diamond's centre is 0.707 samples from its sides";
  EXPECT_EQ(voids_left(one, 0.75), 0u);
  const std::vector<std::string> four{"xxxxxx", "xxxxxx", "xx..xx", "xx..xx", "xxxxxx", "xxxxxx"};
  EXPECT_EQ(voids_left(four, 1.4), 1u) << "half a cell more than the missing samples";
  EXPECT_EQ(voids_left(four, 1.5), 0u);
  const std::vector<std::string> line{"xxxxxxxxx", "xxxxxxxxx", "xx.....xx", "xxxxxxxxx", "xxxxxxxxx"};
  EXPECT_EQ(voids_left(line, 1), 0u) << "as long as it may be";
}

TEST(outline, voids_that_hold_a_height_stay) {
  const std::vector<std::string> alone{"xxxxxxx", "xxxxxxx", "xx...xx", "xx.x.xx", "xx...xx", "xxxxxxx", "xxxxxxx"};
  EXPECT_EQ(voids_left(alone, 9), 1u);
}

double distance(Point a, Point b, double x, double y) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double along = std::clamp(((x - a.x) * dx + (y - a.y) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
  return std::hypot(a.x + along * dx - x, a.y + along * dy - y);
}

RC_GTEST_PROP(outline, closed_voids_hold_no_height_and_lie_within_the_tolerance, ()) {
  const auto field = testing::random_field(*rc::gen::arbitrary<std::uint32_t>(), 30, 30, testing::Relief::kTies,
                                           *rc::gen::element(0.05, 0.3, 0.6));
  const double tolerance = *rc::gen::element(0.5, 0.75, 1.0, 1.5, 2.5);
  const grid::Outline exact = grid::trace_outline(field.raster()),
                      left = grid::close_voids(field.raster(), exact, tolerance);
  for (const auto& polygon : exact) {
    if (std::find(left.begin(), left.end(), polygon) != left.end()) continue;
    RC_ASSERT(twice_area(polygon) < 0);
    // Points an eighth of a sample apart, off the lattice's lines and diagonals.
    for (double y = 0.03; y < 29; y += 0.125) {
      for (double x = 0.05; x < 29; x += 0.125) {
        bool inside = false;
        double nearest = 99;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
          const Point a = polygon[i], b = polygon[(i + 1) % polygon.size()];
          nearest = std::min(nearest, distance(a, b, x, y));
          if ((a.y > y) != (b.y > y) && x < a.x + (y - a.y) * (b.x - a.x) / (b.y - a.y)) inside = !inside;
        }
        if (!inside) continue;
        RC_ASSERT(nearest <= tolerance);
        // A valid sample near it is a sample of the outline.
        const Point p{static_cast<std::int32_t>(std::lround(x)), static_cast<std::int32_t>(std::lround(y))};
        if (!field.raster().is_valid(p) || std::hypot(p.x - x, p.y - y) > 0.1) continue;
        double beside = 99;
        for (std::size_t i = 0; i < polygon.size(); ++i)
          beside = std::min(beside, distance(polygon[i], polygon[(i + 1) % polygon.size()], p.x, p.y));
        RC_ASSERT(beside == 0);
      }
    }
  }
}

/// The valid samples of a field.
std::vector<grid::SampleRun> runs_of(const testing::Field& field) {
  std::vector<grid::SampleRun> runs;
  for (std::int32_t y = 0; y < field.rows; ++y) {
    for (std::int32_t x = 0; x < field.cols; ++x) {
      if (!field.raster().is_valid({x, y})) continue;
      if (runs.empty() || runs.back().row != y || runs.back().end != x) runs.push_back({y, x, x});
      ++runs.back().end;
    }
  }
  return runs;
}

RC_GTEST_PROP(outline, of_runs_is_that_of_the_raster, ()) {
  const auto cols = *rc::gen::inRange(1, 20), rows = *rc::gen::inRange(1, 20);
  testing::Field field = testing::random_field(*rc::gen::arbitrary<std::uint32_t>(), cols, rows, testing::Relief::kTies,
                                               *rc::gen::element(0.0, 0.1, 0.5));
  // One of four heights: single samples, and gaps of whole rows.
  if (*rc::gen::arbitrary<bool>()) {
    for (float& z : field.samples) z = z == 2 ? z : std::numeric_limits<float>::quiet_NaN();
  }
  RC_ASSERT(grid::trace_outline(runs_of(field)) == grid::trace_outline(field.raster()));
}

}  // namespace
}  // namespace scarp
