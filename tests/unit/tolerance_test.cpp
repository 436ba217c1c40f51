// The judge with a bound for each sample, and the mesh as a raster.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "scarp/measure.h"
#include "unit/measure_meshes.h"

namespace scarp::testing {
namespace {

std::vector<double> errors_of(const HeightField& field, const Mesh& mesh) {
  std::vector<double> errors;
  MeasureOptions options;
  options.on_row = [&](int, std::span<const float> row) { errors.insert(errors.end(), row.begin(), row.end()); };
  EXPECT_TRUE(measure(field, mesh, options));
  return errors;
}

TEST(Tolerance, EachSampleHasItsOwnBound) {
  std::mt19937 random(11);
  for (const bool dressed : {false, true}) {
    Terrain terrain = wavy_terrain(61, 41);
    if (dressed) terrain.frame = dress_up(terrain.frame);
    Terrain plain = wavy_terrain(61, 41);
    const Mesh mesh = grid_mesh(plain, 10);
    const std::vector<double> errors = errors_of(terrain.view(), mesh);
    std::vector<float> tolerance(errors.size());
    for (float& bound : tolerance) bound = static_cast<float>(random() % 100) / 10;
    tolerance[7] = std::numeric_limits<float>::infinity();
    std::uint64_t over = 0;
    for (std::size_t i = 0; i < errors.size(); ++i) over += std::abs(errors[i]) > double{tolerance[i]};
    MeasureOptions options;
    options.tolerance = tolerance;
    const auto verdict = measure(terrain.view(), mesh, options);
    ASSERT_TRUE(verdict);
    EXPECT_GT(over, 0u);
    EXPECT_EQ(verdict->over_tolerance, over);
    EXPECT_FALSE(verdict->offenders.empty());
    for (const Offender& offender : verdict->offenders) {
      const auto i = static_cast<std::size_t>(offender.row * 61 + offender.col);
      EXPECT_GT(std::abs(offender.error), double{tolerance[i]});
    }
    options.run.threads = 3;
    EXPECT_EQ(measure(terrain.view(), mesh, options)->offenders.size(), verdict->offenders.size());

    // Bounds equal to the errors hold; all non-zero errors break slightly smaller bounds.
    std::uint64_t nonzero = 0;
    for (std::size_t i = 0; i < errors.size(); ++i) {
      const double error = std::abs(errors[i]);
      tolerance[i] = static_cast<float>(error);
      nonzero += error > 0;
      if (double{tolerance[i]} < error) tolerance[i] = std::nextafter(tolerance[i], HUGE_VALF);
      if (error > 0) tolerance[i] = std::nextafter(tolerance[i], HUGE_VALF);
    }
    EXPECT_EQ(measure(terrain.view(), mesh, options)->over_tolerance, 0u);
    EXPECT_TRUE(measure(terrain.view(), mesh, options)->offenders.empty());
    for (float& bound : tolerance) bound = std::nextafter(std::nextafter(bound, -HUGE_VALF), -HUGE_VALF);
    EXPECT_GE(measure(terrain.view(), mesh, options)->over_tolerance, nonzero / 2);
  }
}

TEST(Tolerance, NeedsAValueForEachSample) {
  const Terrain terrain = wavy_terrain(11, 11);
  const std::vector<float> tolerance(120, 1.0f);
  MeasureOptions options;
  options.tolerance = tolerance;
  const auto verdict = measure(terrain.view(), grid_mesh(terrain, 5), options);
  ASSERT_FALSE(verdict);
  EXPECT_EQ(verdict.error().kind, ErrorKind::kUsage);
}

TEST(Tolerance, UncoveredSamplesAreOffenders) {
  const Terrain terrain = wavy_terrain(11, 11);
  Mesh mesh = grid_mesh(terrain, 5);
  mesh.triangles.resize(3);
  const std::vector<float> tolerance(121, std::numeric_limits<float>::infinity());
  MeasureOptions options;
  options.tolerance = tolerance;
  const auto verdict = measure(terrain.view(), mesh, options);
  ASSERT_TRUE(verdict);
  EXPECT_EQ(verdict->over_tolerance, 0u);
  EXPECT_EQ(verdict->offenders.size(), verdict->uncovered);
  options.tolerance = {};
  EXPECT_TRUE(measure(terrain.view(), mesh, options)->offenders.empty());
  options.collect_above = HUGE_VAL;
  EXPECT_EQ(measure(terrain.view(), mesh, options)->offenders.size(), verdict->uncovered);
}

TEST(Resample, IsTheSampleAndItsError) {
  std::mt19937 random(5);
  for (const bool dressed : {false, true}) {
    Terrain plain = wavy_terrain(61, 41);
    plain.at(33, 22) = NAN;
    Mesh mesh = grid_mesh(plain, 20);
    mesh.triangles.resize(mesh.triangles.size() - 3);
    Terrain terrain = plain;
    if (dressed) terrain.frame = dress_up(terrain.frame);
    const std::vector<double> errors = errors_of(terrain.view(), mesh);
    const auto heights = resample(terrain.view(), mesh, 1);
    ASSERT_TRUE(heights);
    ASSERT_EQ(heights->size(), errors.size());
    std::size_t nodata = 0;
    for (std::size_t i = 0; i < errors.size(); ++i) {
      const float height = (*heights)[i];
      ASSERT_EQ(std::isnan(height), std::isnan(errors[i]));
      nodata += std::isnan(height);
      if (std::isnan(height)) continue;
      ASSERT_NEAR(height, double{terrain.samples[i]} + errors[i], 1e-4);
    }
    EXPECT_GT(nodata, 1u);
    for (const auto& [c, r] : {std::array{0, 0}, {20, 20}, {40, 20}, {60, 0}}) {
      EXPECT_EQ((*heights)[static_cast<std::size_t>(r * 61 + c)], plain.at(c, r));
    }
    const auto again = resample(terrain.view(), mesh, 4);
    ASSERT_TRUE(again);
    for (std::size_t i = 0; i < errors.size(); ++i) {
      EXPECT_TRUE((*again)[i] == (*heights)[i] || std::isnan((*heights)[i]));
    }
  }
}

TEST(Resample, FailsAsTheJudgeDoes) {
  const Terrain terrain = wavy_terrain(11, 11);
  EXPECT_FALSE(resample(terrain.view(), Mesh{}));
}

}  // namespace
}  // namespace scarp::testing
