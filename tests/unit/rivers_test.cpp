// Rivers that never rise, and meshes with them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "scarp/features.h"
#include "scarp/simplify.h"

namespace scarp {
namespace {

/// Land that falls to the east, with bumps and pits.
OwnedHeightField bumpy_slope() {
  OwnedHeightField field;
  field.cols = 60;
  field.rows = 40;
  field.frame = grid_frame(field.rows);
  std::uint32_t dice = 7;
  for (int row = 0; row < field.rows; ++row) {
    for (int col = 0; col < field.cols; ++col) {
      dice = dice * 1664525u + 1013904223u;
      field.samples.push_back(static_cast<float>(100 - col + static_cast<double>(dice >> 24) / 16));
    }
  }
  return field;
}

Line line_of(std::vector<std::array<double, 3>> points, const char* name) {
  Line line;
  line.points = std::move(points);
  line.name = name;
  return line;
}

/// A trunk with bends and a tributary that joins it at a vertex, both partly drawn upstream.
std::vector<Line> network() {
  return {line_of({{1.3, 20.2, NAN}, {20.7, 25.1, NAN}, {41.2, 18.4, NAN}, {58.6, 20.9, NAN}}, "trunk"),
          line_of({{41.2, 18.4, NAN}, {30.5, 9.8, NAN}, {5.1, 3.3, NAN}}, "tributary")};
}

RiverOptions in_frame_of(const OwnedHeightField& field, double tolerance) { return {field.frame.affine, tolerance}; }

bool never_rises(const River& river) {
  auto heights = river.course.points;
  if (river.is_turned) std::reverse(heights.begin(), heights.end());
  return std::is_sorted(heights.begin(), heights.end(), [](const auto& a, const auto& b) { return a[2] > b[2]; });
}

TEST(rivers, never_rise_and_are_never_above_the_raster) {
  const OwnedHeightField field = bumpy_slope();
  const auto rivers = carve_rivers(field, network(), {}, in_frame_of(field, 0));
  ASSERT_TRUE(rivers);
  ASSERT_EQ(rivers->size(), 2u);
  EXPECT_FALSE((*rivers)[0].is_turned);
  EXPECT_TRUE((*rivers)[1].is_turned);
  for (const River& river : *rivers) {
    EXPECT_TRUE(never_rises(river)) << river.name;
    EXPECT_GT(river.deepest_cut, 0);
    EXPECT_GT(river.source, river.mouth);
    for (const auto& [x, y, z] : river.course.points) {
      // On the lattice of 256ths, the surface is nowhere steeper than 32 per sample.
      const auto col = static_cast<int>(x), row = static_cast<int>(field.rows - 1 - y);
      float highest = -1e9F;
      for (const int i : {0, 1, field.cols, field.cols + 1})
        highest = std::max(highest, field.samples[static_cast<std::size_t>(row * field.cols + col + i)]);
      EXPECT_LE(z, double{highest}) << x << ", " << y;
    }
  }
}

TEST(rivers, have_one_height_where_they_meet) {
  const OwnedHeightField field = bumpy_slope();
  const auto rivers = carve_rivers(field, network(), {}, in_frame_of(field, 1));
  ASSERT_TRUE(rivers);
  const auto height_at = [&](const River& river) -> std::optional<double> {
    for (const auto& [x, y, z] : river.course.points) {
      if (x == 41.2 && y == 18.4) return z;
    }
    return std::nullopt;
  };
  ASSERT_TRUE(height_at((*rivers)[0]));
  EXPECT_EQ(height_at((*rivers)[0]), height_at((*rivers)[1]));
}

TEST(rivers, are_lines_of_the_mesh_in_every_effort) {
  const OwnedHeightField field = bumpy_slope();
  const auto rivers = carve_rivers(field, network(), {}, in_frame_of(field, 1.5));
  ASSERT_TRUE(rivers);
  for (const Effort effort : {Effort::kFast, Effort::kNormal, Effort::kHigh}) {
    SimplifyOptions options;
    options.goals.max_error = 3;
    options.quality.effort = effort;
    options.output.float32_positions = false;
    options.features.breaklines.affine = field.frame.affine;
    for (const River& river : *rivers) options.features.breaklines.lines.push_back(river.course);
    const auto result = simplify(field, options);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_EQ(result->lines_inserted, 2u);
    for (const River& river : *rivers) {
      for (const auto& [x, y, z] : river.course.points) {
        bool is_there = false;
        for (std::uint32_t v = 0; v < result->mesh.vertex_count() && !is_there; ++v) {
          const auto p = result->mesh.vertex(v);
          is_there = std::hypot(p[0] - x, p[1] - y) < 0.005 && std::abs(p[2] - z) < 1e-4;
        }
        EXPECT_TRUE(is_there) << river.name << " at " << x << ", " << y;
      }
    }
  }
}

TEST(rivers, keep_the_level_of_a_lake_and_give_way_to_its_shore) {
  OwnedHeightField field = bumpy_slope();
  Line shore =
      line_of({{24.2, 15.3, NAN}, {36.1, 14.2, NAN}, {37.7, 30.2, NAN}, {23.4, 29.9, NAN}, {24.2, 15.3, NAN}}, "lake");
  shore.role = LineRole::kOuter;
  shore.polygon = 0;
  WaterOptions water;
  water.affine = field.frame.affine;
  const auto lakes = flatten_lakes(field, std::vector<Line>{shore}, water);
  ASSERT_TRUE(lakes);
  const double level = lakes->front().level;
  const auto rivers = carve_rivers(field, network(), *lakes, in_frame_of(field, 1));
  ASSERT_TRUE(rivers);
  std::size_t in_lake = 0;
  for (const auto& [x, y, z] : rivers->front().course.points) {
    if (x < 25.5 || x > 35 || y < 16.5 || y > 28.5) continue;
    ++in_lake;
    EXPECT_EQ(z, level) << x;
  }
  SimplifyOptions options;
  options.goals.max_error = 2;
  options.quality.vertices = Vertices::kSamples;
  options.output.float32_positions = false;
  options.features.breaklines.affine = field.frame.affine;
  options.features.breaklines.lines = lakes->front().shore;
  options.features.breaklines.lines.push_back(rivers->front().course);
  const auto result = simplify(field, options);
  ASSERT_TRUE(result) << result.error().message;
  for (std::uint32_t v = 0; v < result->mesh.vertex_count(); ++v) {
    const auto [x, y, z] = result->mesh.vertex(v);
    if (x < 25.5 || x > 35 || y < 16.5 || y > 28.5) continue;
    EXPECT_EQ(z, level) << x << ", " << y;
  }
}

TEST(rivers, that_are_closed_or_beside_the_raster_are_left_out) {
  const OwnedHeightField field = bumpy_slope();
  const std::vector<Line> lines{line_of({{1, 1, NAN}, {9, 1, NAN}, {9, 9, NAN}, {1, 1, NAN}}, "closed"),
                                line_of({{-9, -9, NAN}, {-5, -5, NAN}}, "away")};
  EXPECT_TRUE(carve_rivers(field, lines, {}, in_frame_of(field, 0))->empty());
  EXPECT_EQ(carve_rivers(field, lines, {}, in_frame_of(field, -1)).error().kind, ErrorKind::kUsage);
}

/// Three streams in a chain, given in the order that converges last, must end like any other order.
TEST(rivers, do_not_depend_on_their_order) {
  const OwnedHeightField field = bumpy_slope();
  std::vector<Line> lines{line_of({{2.2, 30.1, NAN}, {15.5, 22.2, NAN}}, "first"),
                          line_of({{15.5, 22.2, NAN}, {33.1, 27.4, NAN}}, "second"),
                          line_of({{33.1, 27.4, NAN}, {57.7, 31.1, NAN}}, "third")};
  const auto some = carve_rivers(field, lines, {}, in_frame_of(field, 0.5));
  std::reverse(lines.begin(), lines.end());
  const auto others = carve_rivers(field, lines, {}, in_frame_of(field, 0.5));
  ASSERT_TRUE(some);
  ASSERT_TRUE(others);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ((*some)[i].course.points, (*others)[2 - i].course.points);
  EXPECT_LE((*some)[1].course.points.front()[2], (*some)[0].course.points.front()[2]);
  EXPECT_EQ((*some)[1].course.points.front()[2], (*some)[0].course.points.back()[2]);
}

}  // namespace
}  // namespace scarp
