// Volumes between surfaces for which there is a formula.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <optional>
#include <string>

#include "../../bench/harness.h"
#include "laws/sanitized.h"
#include "scarp/io.h"
#include "scarp/measure.h"
#include "scarp/points.h"
#include "scarp/simplify.h"
#include "source_dir.h"
#include "unit/measure_meshes.h"

namespace scarp::volume_test {
namespace {

using ::testing::HasSubstr;

/// A square of `side`, in `steps` x `steps` cells of two triangles, with heights by place.
template <class Height>
Mesh square(double side, int steps, const Height& height) {
  testing::Terrain terrain{{}, steps + 1, steps + 1, {}};
  terrain.frame.affine = {0, side / steps, 0, side, 0, -side / steps};
  terrain.samples.resize(static_cast<std::size_t>(terrain.cols * terrain.rows));
  Mesh mesh = testing::grid_mesh(terrain, 1);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
    mesh.positions[3 * v + 2] = height(mesh.positions[3 * v], mesh.positions[3 * v + 1]);
  return mesh;
}

Mesh flat(double side, int steps, double z) {
  return square(side, steps, [&](double, double) { return z; });
}

/// A pyramid of height `top` over the square, with its top in the middle.
Mesh pyramid(double side, double top) {
  Mesh mesh;
  mesh.positions = {0, 0, 0, side, 0, 0, side, side, 0, 0, side, 0, side / 2, side / 2, top};
  mesh.triangles = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4};
  return mesh;
}

void expect_near(const Volumes& volumes, double cut, double fill, double area) {
  EXPECT_NEAR(volumes.cut, cut, 1e-12 * (1 + cut + fill));
  EXPECT_NEAR(volumes.fill, fill, 1e-12 * (1 + cut + fill));
  EXPECT_NEAR(volumes.common_area, area, 1e-12 * area);
  EXPECT_EQ(volumes.net(), volumes.cut - volumes.fill);
}

bool is_same(const Volumes& a, const Volumes& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

TEST(Volume, APlaneAboveALevelIsAPrism) {
  for (const int steps : {1, 7}) {
    expect_near(*measure_volume(flat(10, steps, 3), 1), 200, 0, 100);
    expect_near(*measure_volume(flat(10, steps, 3), 4.5), 0, 150, 100);
    expect_near(*measure_volume(flat(10, steps, 3), 3), 0, 0, 100);
  }
  // Half of a ramp lies above the middle, half below.
  const Mesh ramp = square(12, 5, [](double x, double) { return x; });
  expect_near(*measure_volume(ramp, 6), 216, 216, 144);
  expect_near(*measure_volume(ramp, 4), 8 * 8 / 2.0 * 12, 4 * 4 / 2.0 * 12, 144);
}

TEST(Volume, APyramidHasAThirdOfItsPrism) {
  const Mesh hill = pyramid(6, 9);
  expect_near(*measure_volume(hill, 0), 108, 0, 36);
  // The part above two thirds of the height is a pyramid of a third of the size.
  expect_near(*measure_volume(hill, 6), 108.0 / 27, 36 * 6 - (108 - 108.0 / 27), 36);
  for (const int steps : {1, 4, 5}) {
    expect_near(*measure_volume(flat(6, steps, 0), hill), 0, 108, 36);
    expect_near(*measure_volume(hill, flat(6, steps, 6)), 108.0 / 27, 36 * 6 - (108 - 108.0 / 27), 36);
  }
}

TEST(Volume, TwoTiltedPlanesCross) {
  const Mesh east = square(10, 3, [](double x, double) { return x; });
  const Mesh north = square(10, 4, [](double, double y) { return y; });
  // |x - y| over a square of side a has the integral a³ / 3, half on each side of the diagonal.
  expect_near(*measure_volume(east, north), 1000.0 / 6, 1000.0 / 6, 100);
  const Mesh west = square(10, 1, [](double x, double) { return 8 - x; });
  // The surfaces cross at x = 4; their difference is 2 (x - 4) from there on.
  expect_near(*measure_volume(west, east), 16.0 * 10, 36.0 * 10, 100);
}

TEST(Volume, CountsWhatBothCover) {
  Mesh small = flat(4, 3, 2), large = flat(10, 4, 1);
  small.origin = {8, -1, 5};  // 2 of its 4 columns and 3 of its 4 rows lie in the other mesh
  const Volumes volumes = *measure_volume(large, small);
  expect_near(volumes, 0, 6 * 6, 6);
  EXPECT_NEAR(volumes.from_outside, 94, 1e-12 * 100);
  EXPECT_NEAR(volumes.to_outside, 10, 1e-12 * 100);
  small.origin[0] = 11;
  EXPECT_EQ(measure_volume(large, small)->common_area, 0);
  EXPECT_EQ(measure_volume(large, small)->from_outside, 100);
}

TEST(Volume, AgainstItselfIsExactlyNothing) {
  std::mt19937 random(5);
  for (const double far : {0.0, 4.5e6}) {
    testing::Terrain terrain = testing::random_terrain(31, 23, 0, random);
    for (double& term : terrain.frame.affine) term *= 0.73;
    Mesh mesh = testing::grid_mesh(terrain, 1);
    mesh.origin = {far, far / 3, 0.1};
    const Volumes volumes = *measure_volume(mesh, mesh);
    EXPECT_EQ(volumes.cut, 0);
    EXPECT_EQ(volumes.fill, 0);
    EXPECT_EQ(volumes.from_outside, 0);
    EXPECT_EQ(volumes.to_outside, 0);
    EXPECT_NEAR(volumes.common_area, 30 * 22 * 0.73 * 0.73, 1e-9);
  }
}

TEST(Volume, DependsOnNeitherOrderNorThreads) {
  const Mesh a = square(10, 60, [](double x, double y) { return std::sin(x) + y / 7; });
  const Mesh b = square(11, 43, [](double x, double y) { return std::cos(y) + x / 5; });
  const Volumes volumes = *measure_volume(a, b, {.threads = 1});
  EXPECT_GT(volumes.cut, 1);
  EXPECT_GT(volumes.fill, 1);
  for (const int threads : {2, 4, 7}) {
    EXPECT_TRUE(is_same(*measure_volume(a, b, {.threads = threads}), volumes));
    EXPECT_TRUE(is_same(*measure_volume(b, a, {.threads = threads}), volumes.reversed()));
    EXPECT_TRUE(is_same(*measure_volume(a, 0.5, {.threads = threads}), *measure_volume(a, 0.5, {.threads = 1})));
  }
}

std::string refuse(const Mesh& from, const Mesh& to, ErrorKind kind = ErrorKind::kInput) {
  const auto volumes = measure_volume(from, to);
  if (volumes) return "measured";
  EXPECT_EQ(volumes.error().kind, kind);
  return volumes.error().message;
}

TEST(Volume, RefusesWhatIsNoSurface) {
  const Mesh good = flat(10, 3, 1);
  Mesh solid = good;
  ASSERT_TRUE(add_base(solid, 0));
  EXPECT_THAT(refuse(good, solid), HasSubstr("the second mesh is a closed solid"));
  EXPECT_THAT(refuse(solid, good), HasSubstr("the first mesh is a closed solid"));
  Mesh turned = good;
  std::swap(turned.triangles[15], turned.triangles[16]);
  EXPECT_THAT(refuse(turned, good), HasSubstr("the first mesh has a triangle, number 5, that faces down"));
  Mesh wall = good;
  wall.positions.insert(wall.positions.end(), {0, 0, 9});
  wall.triangles.insert(wall.triangles.end(), {0, 1, 16});
  wall.positions[3 * 16] = (wall.positions[0] + wall.positions[3]) / 2;
  wall.positions[3 * 16 + 1] = wall.positions[1];
  EXPECT_THAT(refuse(good, wall), HasSubstr("the second mesh has a triangle, number 18, that stands upright"));
  Mesh twice = good;
  twice.triangles.insert(twice.triangles.end(), good.triangles.begin(), good.triangles.begin() + 3);
  EXPECT_THAT(refuse(good, twice), HasSubstr("the second mesh has 1 pair of triangles that overlap"));
  EXPECT_THAT(refuse(good, Mesh()), HasSubstr("the second mesh has no triangles"));
  Mesh broken = good;
  broken.triangles[4] = 99;
  EXPECT_THAT(refuse(broken, good), HasSubstr("triangle 1 of the first mesh names vertex 99"));
  EXPECT_EQ(measure_volume(good, NAN).error().kind, ErrorKind::kUsage);
  const auto cancel = [](const Progress&) { return false; };
  EXPECT_EQ(measure_volume(good, good, {.progress = cancel}).error().kind, ErrorKind::kCancelled);
  EXPECT_EQ(measure_volume(good, 0, {.progress = cancel}).error().kind, ErrorKind::kCancelled);
}

TEST(Volume, TrianglesWithoutAreaInSpaceCountNothing) {
  Mesh mesh = flat(10, 3, 2);
  mesh.triangles.insert(mesh.triangles.end(), {0, 0, 5, 0, 1, 2, 7, 7, 7});
  expect_near(*measure_volume(mesh, 0), 200, 0, 100);
  expect_near(*measure_volume(mesh, flat(10, 4, 5)), 0, 300, 100);
}

/// The volume of the full grid above 0. Each cell has the mean of its corners, which is also the mean of its two
/// splits.
double volume_of_cells(const HeightField& field) {
  long double sum = 0;
  const auto at = [&](int col, int row) { return field.samples[row * std::ptrdiff_t{field.cols} + col]; };
  for (int row = 0; row + 1 < field.rows; ++row) {
    for (int col = 0; col + 1 < field.cols; ++col) {
      sum += 0.25L * at(col, row) + 0.25L * at(col + 1, row) + 0.25L * at(col, row + 1) + 0.25L * at(col + 1, row + 1);
    }
  }
  return static_cast<double>(sum * std::abs(field.frame.determinant()));
}

/// The bounds of two meshes of real terrain limit how far their volumes differ from that of all samples.
TEST(Volume, OfRealTerrainIsKnownToTheBounds) {
  for (const char* name : {"jacksboro_fault.tif", "crater.tif"}) {
    const auto path = bench::find_raster(source_dir(), name);
    if (!path) continue;
    const auto read = read_height_field(*path);
    ASSERT_TRUE(read) << read.error().message;
    const HeightField field = read->view();
    const double cells = volume_of_cells(field);
    std::optional<Mesh> coarse;
    for (const double error : {20.0, testing::kIsSanitized ? 5.0 : 1.0}) {
      const auto made = simplify(field, {.goals = {.max_error = error}, .quality = {.effort = Effort::kFast}});
      ASSERT_TRUE(made) << made.error().message;
      const Volumes above = *measure_volume(made->mesh, 0);
      EXPECT_LE(std::abs(above.net() - cells), error * above.common_area) << name;
      if (coarse) {
        const Volumes between = *measure_volume(*coarse, made->mesh);
        EXPECT_EQ(between.from_outside, 0);
        EXPECT_EQ(between.to_outside, 0);
        EXPECT_LE(std::abs(between.net()), (20 + error) * between.common_area) << name;
        EXPECT_LE(between.cut + between.fill, (20 + error) * between.common_area) << name;
        EXPECT_NEAR(between.net(), measure_volume(*coarse, 0)->net() - above.net(), 1e-10 * cells) << name;
      }
      coarse = made->mesh;
    }
  }
}

}  // namespace
}  // namespace scarp::volume_test
