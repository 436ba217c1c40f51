// Lines of a map on the lattice of a raster, with heights.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "lines/breaklines.h"

namespace scarp::breaklines_laws_test {
namespace {

constexpr double kSoft = std::numeric_limits<double>::quiet_NaN();
constexpr float kNodata = std::numeric_limits<float>::quiet_NaN();

/// Samples of a plane, and lines on or over it.
struct Scene {
  int cols = 0, rows = 0;
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};
  double base = 0, east = 0, south = 0;
  std::vector<float> samples;
  std::vector<Line> lines;

  double plane(double col, double row) const { return base + east * col + south * row; }
  grid::Raster raster() const { return {samples.data(), cols, rows}; }
  std::array<double, 2> map(double col, double row) const {
    return {affine[0] + affine[1] * col + affine[2] * row, affine[3] + affine[4] * col + affine[5] * row};
  }
  Result<lines::Breaklines> place(LineConflict conflict = LineConflict::kError) const {
    return lines::place_breaklines(lines, affine, raster(), grid::trace_outline(raster()), conflict);
  }
};

class Stage {
 public:
  explicit Stage(std::uint32_t seed) : random_(seed) {}

  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_()) / 4294967296.0);
  }

  Scene plane() {
    Scene scene;
    scene.cols = 2 + below(12);
    scene.rows = 2 + below(12);
    scene.base = below(2000) - 1000;
    scene.east = below(64) / 8.0 - 4;
    scene.south = below(64) / 8.0 - 4;
    for (int row = 0; row < scene.rows; ++row) {
      for (int col = 0; col < scene.cols; ++col) scene.samples.push_back(static_cast<float>(scene.plane(col, row)));
    }
    const double turn = between(0, 6.3), size = between(0.1, 100);
    if (below(3) != 0)
      scene.affine = {between(-1e6, 1e6), size * std::cos(turn), -size * std::sin(turn),
                      between(-1e6, 1e6), size * std::sin(turn), size * std::cos(turn)};
    return scene;
  }

  /// Arbitrary lines whose heights, if any, are `lift` above the plane.
  void add_lines(Scene& scene, bool is_hard, double lift) {
    for (int count = 1 + below(6); count > 0; --count) {
      Line line;
      line.name = "line " + std::to_string(scene.lines.size());
      for (int k = 2 + below(6); k > 0; --k) {
        const double reach = below(6) == 0 ? 1e3 : 1.5;
        const double col = between(-reach, scene.cols + reach), row = between(-reach, scene.rows + reach);
        const auto [x, y] = scene.map(col, row);
        line.points.push_back({x, y, is_hard ? scene.plane(col, row) + lift : kSoft});
      }
      scene.lines.push_back(line);
    }
  }

 private:
  std::mt19937 random_;
};

double plane_at(const Scene& scene, Point p) {
  return scene.plane(p.x / double{grid::kLatticeSteps}, p.y / double{grid::kLatticeSteps});
}

RC_GTEST_PROP(breaklines, hard_lines_of_a_plane_meet_in_peace_and_stay_on_it, ()) {
  Stage stage(*rc::gen::arbitrary<std::uint32_t>());
  Scene scene = stage.plane();
  stage.add_lines(scene, true, 100);
  const auto placed = scene.place();
  RC_ASSERT(placed.has_value());
  const double climb = (std::abs(scene.east) + std::abs(scene.south)) / grid::kLatticeSteps;
  for (std::size_t k = 0; k < placed->points.size(); ++k) {
    const double lift = placed->is_hard[k] ? 100 : 0;
    RC_ASSERT(std::abs(placed->heights[k] - lift - plane_at(scene, placed->points[k])) <= 3 * climb + 1e-3);
  }
  for (const auto& edge : placed->edges)
    RC_ASSERT(!edge.is_line || (placed->is_hard[edge.a] && placed->is_hard[edge.b]));
}

RC_GTEST_PROP(breaklines, soft_lines_lie_on_the_raster, ()) {
  Stage stage(*rc::gen::arbitrary<std::uint32_t>());
  Scene scene = stage.plane();
  stage.add_lines(scene, false, 0);
  const auto placed = scene.place();
  RC_ASSERT(placed.has_value());
  for (std::size_t k = 0; k < placed->points.size(); ++k) {
    RC_ASSERT(!placed->is_hard[k]);
    RC_ASSERT(std::abs(placed->heights[k] - plane_at(scene, placed->points[k])) <= 1e-3);
  }
}

RC_GTEST_PROP(breaklines, every_vertex_in_the_raster_is_a_point_within_half_a_step, ()) {
  Stage stage(*rc::gen::arbitrary<std::uint32_t>());
  Scene scene = stage.plane();
  scene.affine = {0, 1, 0, 0, 0, 1};
  stage.add_lines(scene, stage.below(2) == 0, 0);
  const auto placed = scene.place();
  RC_ASSERT(placed.has_value());
  for (const Line& line : scene.lines) {
    for (const auto& [x, y, z] : line.points) {
      const double col = x * grid::kLatticeSteps, row = y * grid::kLatticeSteps;
      if (col < 1 || row < 1 || col > (scene.cols - 1) * grid::kLatticeSteps - 1 ||
          row > (scene.rows - 1) * grid::kLatticeSteps - 1)
        continue;
      RC_ASSERT(std::any_of(placed->points.begin(), placed->points.end(), [col = col, row = row](Point p) {
        return std::abs(p.x - col) <= 0.5 && std::abs(p.y - row) <= 0.5;
      }));
    }
  }
}

RC_GTEST_PROP(breaklines, no_nodata_leaks_into_the_surface, ()) {
  Stage stage(*rc::gen::arbitrary<std::uint32_t>());
  Scene scene = stage.plane();
  for (int count = stage.below(6); count > 0; --count)
    scene.samples[static_cast<std::size_t>(stage.below(static_cast<int>(scene.samples.size())))] = kNodata;
  stage.add_lines(scene, false, 0);
  const auto placed = scene.place();
  RC_ASSERT(placed.has_value());
  const grid::Raster raster = scene.raster();
  for (std::size_t k = 0; k < placed->points.size(); ++k) {
    const Point p = placed->points[k];
    const Point cell{std::min(p.x / grid::kLatticeSteps, scene.cols - 2),
                     std::min(p.y / grid::kLatticeSteps, scene.rows - 2)};
    const bool on_sample = p.x % grid::kLatticeSteps == 0 && p.y % grid::kLatticeSteps == 0;
    if (std::popcount(grid::valid_corners(raster, cell.x, cell.y)) < 3 || on_sample) continue;
    RC_ASSERT(std::abs(placed->heights[k] - plane_at(scene, p)) <= 1e-3);
  }
}

Scene flat(int size, std::vector<std::vector<std::array<double, 3>>> lines) {
  Scene scene;
  scene.cols = scene.rows = size;
  scene.samples.assign(static_cast<std::size_t>(size) * static_cast<std::size_t>(size), 5.0F);
  for (auto& points : lines)
    scene.lines.push_back(
        {std::move(points), LineRole::kLine, kNoPolygon, "line " + std::to_string(scene.lines.size())});
  return scene;
}

/// The height at a place; fails the test if there is no vertex.
float height_at(const lines::Breaklines& placed, double col, double row) {
  const Point p{static_cast<std::int32_t>(col * grid::kLatticeSteps),
                static_cast<std::int32_t>(row * grid::kLatticeSteps)};
  const auto found = std::find(placed.points.begin(), placed.points.end(), p);
  if (found == placed.points.end()) {
    ADD_FAILURE() << "no vertex at " << col << ", " << row;
    return 0;
  }
  return placed.heights[static_cast<std::size_t>(found - placed.points.begin())];
}

TEST(breaklines, hard_lines_that_disagree_are_named_or_settled) {
  Scene scene = flat(5, {{{0, 2, 10}, {4, 2, 14}}, {{2, 0, 30}, {2, 4, 30}}, {{0, 0, kSoft}, {4, 4, kSoft}}});
  scene.affine = {1000, 10, 0, 2000, 0, -10};
  for (Line& line : scene.lines) {
    for (auto& [x, y, z] : line.points) x = 1000 + 10 * x, y = 2000 - 10 * y;
  }
  const auto refused = scene.place();
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().kind, ErrorKind::kInput);
  EXPECT_EQ(refused.error().message,
            "line 0 has the height 12 and line 1 has 30 where they meet at 1020, 1980: mend one of them, or say which "
            "height counts (line conflict: first, mean or highest)");
  EXPECT_EQ(height_at(*scene.place(LineConflict::kFirst), 2, 2), 12);
  EXPECT_EQ(height_at(*scene.place(LineConflict::kMean), 2, 2), 21);
  EXPECT_EQ(height_at(*scene.place(LineConflict::kHighest), 2, 2), 30);
}

TEST(breaklines, a_cliff_within_a_line_is_a_conflict) {
  const Scene scene = flat(5, {{{0, 2, 10}, {2, 2, 10}, {2, 2, 20}, {4, 2, 20}}});
  const auto refused = scene.place();
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().message.substr(0, 55), "line 0 has the height 10 and elsewhere along it has 20 ");
  EXPECT_EQ(height_at(*scene.place(LineConflict::kHighest), 2, 2), 20);
}

TEST(breaklines, a_line_with_some_heights_is_soft_between_others) {
  const Scene scene = flat(
      5, {{{0, 2, 10}, {2, 2, 20}, {4, 2, kSoft}}, {{1, 0, kSoft}, {1, 4, kSoft}}, {{3, 0, kSoft}, {3, 4, kSoft}}});
  const auto placed = scene.place();
  ASSERT_TRUE(placed.has_value());
  EXPECT_EQ(height_at(*placed, 1, 2), 15);
  EXPECT_EQ(height_at(*placed, 2, 2), 20);
  EXPECT_EQ(height_at(*placed, 3, 2), 5);
  EXPECT_EQ(height_at(*placed, 4, 2), 5);
}

TEST(breaklines, lines_far_away_are_cut_or_counted) {
  const Scene scene = flat(5, {{{-1e12, 2, kSoft}, {1e12, 2, kSoft}}, {{1e9, 1e9, 1}, {2e9, 1e9, 1}}});
  const auto placed = scene.place();
  ASSERT_TRUE(placed.has_value());
  EXPECT_EQ(placed->outside, 1u);
  const auto edge = std::find_if(placed->edges.begin(), placed->edges.end(), [](const auto& e) { return e.is_line; });
  ASSERT_NE(edge, placed->edges.end());
  EXPECT_EQ(placed->points[edge->a], (Point{0, 512}));
  EXPECT_EQ(placed->points[edge->b], (Point{1024, 512}));
  for (const double far : {1e13, 1e308}) {
    const auto refused = flat(5, {{{far, -far, 0}, {-far, far, 0}}}).place();
    ASSERT_FALSE(refused.has_value());
    EXPECT_NE(refused.error().message.find("line 0 has a vertex at 1e+"), std::string::npos);
  }
  Scene stretched = flat(5, {{{1e300, 0, 0}, {0, 1, 0}}});
  stretched.affine = {0, 1e-10, 0, 0, 0, 1e-10};
  const auto too_far = stretched.place();
  ASSERT_FALSE(too_far.has_value());
  EXPECT_NE(too_far.error().message.find("line 0 has a vertex at 1e+300, 0"), std::string::npos);
}

TEST(breaklines, map_coordinates_are_those_of_the_file) {
  RasterInfo info;
  EXPECT_EQ(map_affine(info, 5), (std::array<double, 6>{0, 1, 0, 4, 0, -1}));
  info.has_georeference = true;
  info.geotransform = {500000, 30, 0, 4100000, 0, -30};
  EXPECT_EQ(map_affine(info, 5), (std::array<double, 6>{500015, 30, 0, 4099985, 0, -30}));
}

}  // namespace
}  // namespace scarp::breaklines_laws_test
