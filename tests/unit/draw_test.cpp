// Pictures: sizes, colours with a meaning, lines at the mesh's edges.
#include <gtest/gtest.h>

#include <algorithm>

#include "draw/canvas.h"
#include "draw/font.h"
#include "draw/grid_positions.h"
#include "scarp/picture.h"
#include "unit/measure_meshes.h"

namespace scarp::testing::draw_test {
namespace {

std::array<int, 3> pixel(const Picture& picture, int x, int y) {
  const std::size_t at = 3 * static_cast<std::size_t>(y * picture.width + x);
  return {picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]};
}
int brightness(const std::array<int, 3>& colour) { return colour[0] + colour[1] + colour[2]; }

TEST(DrawPreview, KeepsToTheSizeAskedFor) {
  for (const auto& [cols, rows, side] :
       {std::array{40, 30, 1400}, {400, 30, 100}, {3, 900, 1400}, {2, 2, 1}, {701, 702, 1400}}) {
    const Terrain terrain = wavy_terrain(cols, rows);
    const Picture picture = *draw_preview(terrain.view(), Mesh{}, {.max_side = side});
    EXPECT_LE(std::max(picture.width, picture.height), side);
    EXPECT_GE(std::min(picture.width, picture.height), 1);
    EXPECT_EQ(picture.rgb.size(), 3u * static_cast<std::size_t>(picture.width * picture.height));
  }
  EXPECT_EQ(draw_preview(wavy_terrain(40, 30).view(), Mesh{})->width % 40, 0);
}

TEST(DrawPreview, LightsSlopesFromTheUpperLeft) {
  Terrain terrain = wavy_terrain(41, 41);
  for (int r = 0; r < 41; ++r) {
    for (int c = 0; c < 41; ++c)
      terrain.at(c, r) = static_cast<float>(-std::abs(c - 20));  // a ridge from top to bottom
  }
  const Picture picture = *draw_preview(terrain.view(), Mesh{}, {.max_side = 41});
  EXPECT_GT(brightness(pixel(picture, 10, 20)), brightness(pixel(picture, 30, 20)) + 60);
}

TEST(DrawPreview, LeavesNodataWhite) {
  Terrain terrain = wavy_terrain(30, 30);
  for (int r = 5; r < 15; ++r) {
    for (int c = 5; c < 15; ++c) terrain.at(c, r) = NAN;
  }
  const Picture picture = *draw_preview(terrain.view(), Mesh{}, {.max_side = 30});
  EXPECT_EQ(pixel(picture, 9, 9), (std::array<int, 3>{255, 255, 255}));
  EXPECT_NE(pixel(picture, 20, 20), (std::array<int, 3>{255, 255, 255}));
}

TEST(DrawPreview, DrawsTheMeshOnTheSamples) {
  for (const bool dressed : {false, true}) {
    Terrain terrain = wavy_terrain(41, 41);
    std::fill(terrain.samples.begin(), terrain.samples.end(), 7.0f);
    terrain.frame.affine = {500000, 10, 0, 4000000, 0, -10};
    if (dressed) terrain.frame = dress_up(terrain.frame);
    Mesh mesh;
    mesh.origin = {500000, 4000000, 0};
    for (const auto& [c, r] : {std::array{0, 0}, {0, 40}, {40, 0}, {40, 40}}) {
      mesh.positions.insert(mesh.positions.end(), {c * 10.0, r * -10.0, 7.0});
    }
    mesh.triangles = {0, 1, 2, 2, 1, 3};
    const Picture plain = *draw_preview(terrain.view(), Mesh{}, {.max_side = 41}),
                  drawn = *draw_preview(terrain.view(), mesh, {.max_side = 41});
    for (int i = 0; i < 41; ++i) {
      EXPECT_LT(brightness(pixel(drawn, i, 40 - i)), brightness(pixel(plain, i, 40 - i)) - 150);  // the diagonal
      EXPECT_LT(brightness(pixel(drawn, i, 0)), brightness(pixel(plain, i, 0)) - 150);
    }
    EXPECT_EQ(pixel(drawn, 10, 10), pixel(plain, 10, 10));
    EXPECT_EQ(pixel(drawn, 30, 30), pixel(plain, 30, 30));
  }
}

/// A curved map that no affine map approximates.
class Bend : public PointTransform {
 public:
  bool apply(std::span<double> x, std::span<double> y) const override {
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double radius = 5000 + y[i], angle = x[i] / 4000;
      x[i] = radius * std::sin(angle);
      y[i] = radius * std::cos(angle);
    }
    return true;
  }
};

TEST(GridPositions, AreFoundInAFrameThatIsNotAffine) {
  Frame frame;
  frame.affine = {-2000, 10, 0, 1500, 0, -10};
  frame.transform = std::make_shared<Bend>();
  Mesh mesh;
  for (const auto& [c, r] : {std::array{0.0, 0.0}, {399.0, 0.0}, {399.0, 299.0}, {123.25, 77.5}}) {
    auto [x, y] = frame.apply_affine(c, r);
    ASSERT_TRUE(frame.transform->apply({&x, 1}, {&y, 1}));
    mesh.positions.insert(mesh.positions.end(), {x, y, 0});
  }
  const draw::GridPositions at = draw::find_grid_positions(frame, 400, 300, mesh);
  EXPECT_NEAR(at.cols[0], 0, 0.02);
  EXPECT_NEAR(at.rows[0], 0, 0.02);
  EXPECT_NEAR(at.cols[2], 399, 0.02);
  EXPECT_NEAR(at.rows[2], 299, 0.02);
  EXPECT_NEAR(at.cols[3], 123.25, 0.02);
  EXPECT_NEAR(at.rows[3], 77.5, 0.02);
}

TEST(DrawErrorMap, ShowsSignAndSizeAndNodata) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> errors{-2, 0, 2, nan};
  const Picture picture = draw_error_map(errors, 4, 1, {.limit = 2});
  const int cell = picture.width / 4;
  const auto blue = pixel(picture, cell / 2, 0), white = pixel(picture, cell + cell / 2, 0);
  const auto red = pixel(picture, 2 * cell + cell / 2, 0), grey = pixel(picture, 3 * cell + cell / 2, 0);
  EXPECT_GT(blue[2], blue[0] + 50);
  EXPECT_GT(red[0], red[2] + 50);
  EXPECT_GT(brightness(white), 740);
  EXPECT_EQ(grey, (std::array<int, 3>{150, 150, 150}));
  EXPECT_GT(picture.height, cell);  // the scale below
}

TEST(DrawErrorMap, KeepsASinglePeakWhenItShrinks) {
  std::vector<float> errors(1000 * 1000, 0.0f);
  errors[500 * 1000 + 500] = 5;
  const Picture picture = draw_error_map(errors, 1000, 1000, {.max_side = 200});
  EXPECT_LE(std::max(picture.width, picture.height), 200);
  int red = 0;
  const int map_height = picture.height - 28;
  for (int y = 0; y < map_height; ++y) {
    for (int x = 0; x < picture.width; ++x) red += pixel(picture, x, y)[1] < 50;
  }
  EXPECT_EQ(red, 1);
}

TEST(DrawErrorMap, RowByRowIsTheMapOfAllErrors) {
  for (const auto& [cols, rows, side] : {std::array{40, 30, 1400}, {700, 90, 100}, {3, 900, 300}, {1, 1, 50}}) {
    std::vector<float> errors;
    for (int i = 0; i < cols * rows; ++i) errors.push_back(i % 13 == 4 ? NAN : std::sin(static_cast<float>(i)));
    for (const double limit : {0.0, 0.5}) {
      const ErrorMapOptions options{.limit = limit, .max_side = side, .cell = {3, 2}, .unit = "m", .title = "errors"};
      ErrorMap map(cols, rows, options);
      for (int y = 0; y < rows; ++y)
        map.add(y, std::span(errors).subspan(static_cast<std::size_t>(y * cols), static_cast<std::size_t>(cols)));
      const Picture picture = map.draw();
      EXPECT_LE(std::max(picture.width, picture.height), side);
      EXPECT_EQ(picture.rgb, draw_error_map(errors, cols, rows, options).rgb);
    }
  }
}

TEST(DrawErrorMap, DrawsAMapWithoutErrors) {
  const Picture picture = draw_error_map(std::vector<float>(100, 0.0f), 10, 10);
  EXPECT_GT(brightness(pixel(picture, 5, 5)), 740);
}

TEST(DrawErrorMap, HasATitleAndTheShapeOfTheGround) {
  const std::vector<float> errors(100 * 100, 1.0f);
  const Picture plain = draw_error_map(errors, 100, 100), wide = draw_error_map(errors, 100, 100, {.cell = {2, 1}}),
                titled = draw_error_map(errors, 100, 100, {.title = "a.glb minus b.tif"});
  EXPECT_NEAR(wide.width / static_cast<double>(plain.width), 2 * (wide.height - 60.0) / (plain.height - 60.0), 0.05);
  EXPECT_GT(titled.height, plain.height + 10);
}

int count_pixels(const Picture& picture, int rows, bool (*is_meant)(const std::array<int, 3>&)) {
  int count = 0;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < picture.width; ++x) count += is_meant(pixel(picture, x, y));
  }
  return count;
}
bool is_blue(const std::array<int, 3>& c) { return c[2] > c[0] + 40 && c[2] > c[1] + 10; }
bool is_red(const std::array<int, 3>& c) { return c[0] > c[1] + 90 && c[0] > c[2] + 90; }

TEST(DrawPreview, HasTheShapeOfTheGround) {
  const Terrain terrain = wavy_terrain(100, 100);
  const Picture picture = *draw_preview(terrain.view(), Mesh{}, {.max_side = 290, .cell = {74.8, 92.5}});
  EXPECT_NEAR(picture.width / static_cast<double>(picture.height), 74.8 / 92.5, 0.02);
  const Picture large = *draw_preview(terrain.view(), Mesh{}, {.cell = {74.8, 92.5}, .unit = "m"});
  EXPECT_GT(large.height * 74.8 / 92.5, large.width + 15);  // a legend below
}

TEST(DrawPreview, PaintsTheSeaBlue) {
  Terrain terrain = wavy_terrain(60, 60);
  for (int r = 0; r < 60; ++r) {
    for (int c = 0; c < 60; ++c) terrain.at(c, r) = static_cast<float>(c < 30 ? -5 : 5);
  }
  const Picture grid = *draw_preview(terrain.view(), Mesh{}, {.max_side = 60});
  EXPECT_EQ(count_pixels(grid, grid.height, is_blue), 0) << "heights of a grid do not count from the sea";
  terrain.frame.kind = Frame::Kind::kLocal;
  terrain.frame.affine = {0, 30, 0, 0, 0, -30};
  const Picture coast = *draw_preview(terrain.view(), Mesh{}, {.max_side = 60});
  EXPECT_NEAR(count_pixels(coast, coast.height, is_blue), coast.width * coast.height / 2, coast.height * 3);
}

TEST(DrawPreview, MarksLines) {
  Terrain terrain = wavy_terrain(60, 60);
  std::fill(terrain.samples.begin(), terrain.samples.end(), 7.0f);
  PreviewOptions options{.max_side = 60};
  EXPECT_EQ(count_pixels(*draw_preview(terrain.view(), Mesh{}, options), 60, is_red), 0);
  options.marks = {{MarkKind::kBreakline, {{10, 10}, {50, 10}}},
                   {MarkKind::kLake, {{20, 20}, {40, 20}, {40, 40}, {20, 40}, {20, 20}}}};
  const Picture marked = *draw_preview(terrain.view(), Mesh{}, options);
  EXPECT_GE(count_pixels(marked, 60, is_red), 30);
  EXPECT_GE(count_pixels(marked, 60, is_blue), 19 * 19);
}

TEST(DrawPreview, LeavesOutTheEdgesOfTinyTriangles) {
  Terrain terrain = wavy_terrain(101, 101);
  std::fill(terrain.samples.begin(), terrain.samples.end(), 7.0f);
  Mesh mesh;
  for (int r = 0; r < 101; ++r) {
    for (int c = 0; c < 101; ++c) mesh.positions.insert(mesh.positions.end(), {double(c), double(r), 7.0});
  }
  for (std::uint32_t r = 0; r < 100; ++r) {
    for (std::uint32_t c = 0; c < 100; ++c) {
      const std::uint32_t v = 101 * r + c;
      mesh.triangles.insert(mesh.triangles.end(), {v, v + 1, v + 102, v, v + 102, v + 101});
    }
  }
  const Picture plain = *draw_preview(terrain.view(), Mesh{}, {.max_side = 101});
  EXPECT_EQ(draw_preview(terrain.view(), mesh, {.max_side = 101})->rgb, plain.rgb) << "a grey veil";
}

TEST(Font, LeavesNoGapsAroundPoints) {
  // Each character is as wide as its ink plus one column: "+2.5" has no gap after the point.
  EXPECT_LT(draw::text_width(".", 1), 4);
  EXPECT_EQ(draw::text_width("2.5", 1),
            draw::text_width("2", 1) + draw::text_width(".", 1) + draw::text_width("5", 1) + 2);
  EXPECT_EQ(draw::text_width("km", 2), 2 * draw::text_width("km", 1));
  EXPECT_EQ(draw::text_width("", 1), 0);
  Picture picture = draw::blank(40, 16);
  draw::write_text(picture, 1, 1, 1, "m", {0, 0, 0});
  int dark = 0;
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 40; ++x) {
      dark += brightness(pixel(picture, x, y)) == 0;
      EXPECT_TRUE(brightness(pixel(picture, x, y)) == 765 || (x >= 1 && x < 1 + draw::text_width("m", 1)));
    }
  }
  EXPECT_GT(dark, 10);
  draw::write_text(picture, 35, 10, 3, "88\xff", {0, 0, 0});  // partly outside: cut off
}

}  // namespace
}  // namespace scarp::testing::draw_test
