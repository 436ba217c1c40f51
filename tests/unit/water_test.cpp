// Flattened lakes and meshes with them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "scarp/features.h"
#include "scarp/simplify.h"

namespace scarp {
namespace {

/// A valley along x = 20 with rough ground, highest in the north.
OwnedHeightField valley() {
  OwnedHeightField field;
  field.cols = 40;
  field.rows = 50;
  field.frame = grid_frame(field.rows);
  for (int row = 0; row < field.rows; ++row) {
    for (int col = 0; col < field.cols; ++col)
      field.samples.push_back(static_cast<float>(std::abs(col - 20) * 1.5 - 0.1 * row + (col * 7 + row * 13) % 5));
  }
  return field;
}

Line ring(std::vector<std::array<double, 3>> points, LineRole role) {
  Line line;
  line.points = std::move(points);
  line.points.push_back(line.points.front());
  line.role = role;
  line.polygon = 0;
  line.name = "lakes feature 1";
  return line;
}

/// A lake with an island, in x and y of the grid frame, with rows going up.
std::vector<Line> lake_with_island() {
  return {ring({{10.3, 10.2, NAN}, {30.7, 12.4, NAN}, {28.1, 35.9, NAN}, {12.2, 33.3, NAN}}, LineRole::kOuter),
          ring({{18.2, 20.1, NAN}, {22.9, 20.3, NAN}, {20.5, 25.7, NAN}}, LineRole::kHole)};
}

TEST(water, is_level_in_the_raster_and_has_a_rim) {
  OwnedHeightField field = valley();
  const OwnedHeightField before = field;
  WaterOptions options;
  options.affine = field.frame.affine;
  const auto lakes = flatten_lakes(field, lake_with_island(), options);
  ASSERT_TRUE(lakes);
  ASSERT_EQ(lakes->size(), 1u);
  const Lake& lake = lakes->front();
  EXPECT_EQ(lake.name, "lakes feature 1");
  const auto at = [&](const OwnedHeightField& of, int x, int y) {
    return of.samples[static_cast<std::size_t>((of.rows - 1 - y) * of.cols + x)];
  };
  EXPECT_EQ(double{at(field, 15, 20)}, lake.level);
  EXPECT_EQ(double{at(field, 26, 30)}, lake.level);
  EXPECT_NE(double{at(field, 20, 22)}, lake.level) << "the island";
  EXPECT_EQ(at(field, 2, 2), at(before, 2, 2));
  std::uint64_t changed = 0;
  double largest = 0;
  for (std::size_t i = 0; i < field.samples.size(); ++i) {
    changed += field.samples[i] != before.samples[i];
    largest = std::max(largest, std::abs(double{field.samples[i]} - double{before.samples[i]}));
  }
  EXPECT_EQ(lake.samples + lake.raised, changed);
  EXPECT_EQ(lake.largest_change, largest);
  for (int y = 1; y + 1 < field.rows; ++y) {
    for (int x = 1; x + 1 < field.cols; ++x) {
      if (double{at(field, x, y)} == lake.level) continue;
      for (int v = y - 1; v <= y + 1; ++v) {
        for (int u = x - 1; u <= x + 1; ++u) {
          if (double{at(field, u, v)} == lake.level) {
            EXPECT_GT(double{at(field, x, y)}, lake.level);
          }
        }
      }
    }
  }
}

TEST(water, is_level_in_the_mesh) {
  for (const auto& [effort, longest] : {std::pair{Effort::kFast, 0.0},
                                        {Effort::kNormal, 0.0},
                                        {Effort::kHigh, 0.0},
                                        {Effort::kFast, 1.3},
                                        {Effort::kNormal, 2.5},
                                        {Effort::kHigh, 2.5}}) {
    OwnedHeightField field = valley();
    WaterOptions water;
    water.affine = field.frame.affine;
    const auto lakes = flatten_lakes(field, lake_with_island(), water);
    ASSERT_TRUE(lakes);
    SimplifyOptions options;
    options.goals.max_error = 3;
    options.quality.effort = effort;
    options.quality.vertices = Vertices::kSamples;
    options.output.float32_positions = false;
    options.features.breaklines.affine = field.frame.affine;
    options.features.breaklines.lines = lakes->front().shore;
    if (longest > 0) options.quality.shape = {.min_angle = 25, .max_edge = longest};
    const auto result = simplify(field, options);
    ASSERT_TRUE(result) << result.error().message;
    const auto inside = [](double x, double y) {  // a point of the shore but not of the island
      return x > 12.3 && x < 28 && y > 12.5 && y < 33.2 && !(x > 18 && x < 23 && y > 20 && y < 25.8);
    };
    std::size_t level = 0;
    for (std::size_t t = 0; t < result->mesh.triangles.size(); t += 3) {
      double x = 0, y = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto v = result->mesh.vertex(result->mesh.triangles[t + k]);
        x += v[0] / 3;
        y += v[1] / 3;
      }
      if (!inside(x, y)) continue;
      ++level;
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(result->mesh.vertex(result->mesh.triangles[t + k])[2], lakes->front().level) << x << ", " << y;
    }
    EXPECT_GT(level, 0u);
  }
}

TEST(water, of_the_percentile_and_nothing_else) {
  double before = -1e9;
  for (const double percentile : {0.0, 5.0, 50.0, 100.0}) {
    OwnedHeightField field = valley();
    WaterOptions options;
    options.affine = field.frame.affine;
    options.percentile = percentile;
    const auto lakes = flatten_lakes(field, lake_with_island(), options);
    ASSERT_TRUE(lakes);
    EXPECT_GT(lakes->front().level, before);
    before = lakes->front().level;
  }
  OwnedHeightField field = valley();
  WaterOptions options;
  options.percentile = 101;
  EXPECT_EQ(flatten_lakes(field, {}, options).error().kind, ErrorKind::kUsage);
  options.percentile = 5;
  options.freeboard = 0;
  EXPECT_EQ(flatten_lakes(field, {}, options).error().kind, ErrorKind::kUsage);
}

TEST(water, has_the_level_that_it_has_without_its_neighbours) {
  const auto flatten = [](const std::vector<Line>& lines) {
    OwnedHeightField field = valley();
    WaterOptions options;
    options.affine = field.frame.affine;
    options.percentile = 40;
    return *flatten_lakes(field, lines, options);
  };
  const std::vector<Line> lake = lake_with_island();
  std::vector<Line> neighbour = {ring({{20, 5, NAN}, {36, 9, NAN}, {29, 30, NAN}}, LineRole::kOuter)};
  const double alone = flatten(lake).front().level, other = flatten(neighbour).front().level;
  ASSERT_NE(alone, other);
  // The same lake twice, and a lake that overlaps both.
  std::vector<Line> lines = lake;
  for (Line again : lake) {
    again.polygon = 1;
    lines.push_back(std::move(again));
  }
  neighbour.front().polygon = 2;
  lines.push_back(neighbour.front());
  const auto lakes = flatten(lines);
  ASSERT_EQ(lakes.size(), 3u);
  EXPECT_EQ(lakes[0].level, alone);
  EXPECT_EQ(lakes[1].level, alone);
  EXPECT_EQ(lakes[1].samples + lakes[1].raised, 0u);
  EXPECT_EQ(lakes[2].level, other);
}

TEST(water, beside_the_raster_is_left_out) {
  OwnedHeightField field = valley();
  const auto before = field.samples;
  const std::vector<Line> lines{ring({{-30, 0, NAN}, {-20, 0, NAN}, {-20, 9, NAN}}, LineRole::kOuter)};
  WaterOptions options;
  options.affine = field.frame.affine;
  EXPECT_TRUE(flatten_lakes(field, lines, options)->empty());
  EXPECT_EQ(field.samples, before);
}

/// Two ponds in rough terrain, one with an island, and a terrace of one row.
OwnedHeightField ponds() {
  OwnedHeightField field = valley();
  for (int row = 0; row < field.rows; ++row) {
    for (int col = 0; col < field.cols; ++col) {
      float& sample = field.samples[static_cast<std::size_t>(row * field.cols + col)];
      const bool is_first = col >= 4 && col < 14 && row >= 6 && row < 16 && !(col == 8 && row == 9);
      if (is_first) sample = 11.03125F;
      if (std::hypot(col - 27, row - 33) < 6.5) sample = 3.25F;
      if (row == 24) sample = 17.03125F;
    }
  }
  return field;
}

TEST(flats, are_found_where_they_are_and_nothing_is_changed) {
  const OwnedHeightField field = ponds();
  const auto flats = find_flats(field, {field.frame.affine, 20});
  ASSERT_TRUE(flats);
  ASSERT_EQ(flats->size(), 2u) << "a row of samples has no area";
  EXPECT_EQ((*flats)[0].level, 11.03125);
  EXPECT_EQ((*flats)[1].level, 3.25);
  EXPECT_EQ((*flats)[0].shore.size(), 2u) << "a rim and an island";
  EXPECT_EQ((*flats)[0].samples + (*flats)[0].raised, 0u);
  for (const Lake& flat : *flats) {
    for (const Line& ring : flat.shore) {
      EXPECT_EQ(ring.points.front(), ring.points.back());
      for (const auto& [x, y, z] : ring.points) {
        EXPECT_EQ(z, flat.level);
        EXPECT_EQ(double{field.samples[static_cast<std::size_t>((field.rows - 1 - y) * field.cols + x)]}, flat.level);
      }
    }
  }
  EXPECT_EQ(find_flats(field, {field.frame.affine, 96})->size(), 2u);
  EXPECT_EQ(find_flats(field, {field.frame.affine, 100})->size(), 1u) << "the first has 99 samples";
  EXPECT_EQ(find_flats(field, {field.frame.affine, 2}).error().kind, ErrorKind::kUsage);
}

TEST(flats, are_level_in_the_mesh) {
  const OwnedHeightField field = ponds();
  const auto flats = find_flats(field, {field.frame.affine, 20});
  ASSERT_TRUE(flats);
  for (const Effort effort : {Effort::kFast, Effort::kNormal, Effort::kHigh}) {
    SimplifyOptions options;
    options.goals.max_error = 4;
    options.quality.effort = effort;
    options.quality.vertices = Vertices::kSamples;
    options.output.float32_positions = false;
    options.features.breaklines.affine = field.frame.affine;
    for (const Lake& flat : *flats)
      options.features.breaklines.lines.insert(options.features.breaklines.lines.end(), flat.shore.begin(),
                                               flat.shore.end());
    const auto result = simplify(field, options);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_TRUE(result->edits.empty());
    std::size_t level = 0;
    for (std::size_t t = 0; t < result->mesh.triangles.size(); t += 3) {
      std::array<std::array<double, 3>, 3> corners{};
      for (std::size_t k = 0; k < 3; ++k) corners[k] = result->mesh.vertex(result->mesh.triangles[t + k]);
      const double x = (corners[0][0] + corners[1][0] + corners[2][0]) / 3,
                   row = field.rows - 1 - (corners[0][1] + corners[1][1] + corners[2][1]) / 3;
      if (!(std::hypot(x - 27, row - 33) < 5)) continue;
      ++level;
      for (const auto& corner : corners) EXPECT_EQ(corner[2], 3.25);
    }
    EXPECT_GT(level, 0u);
  }
}

}  // namespace
}  // namespace scarp
