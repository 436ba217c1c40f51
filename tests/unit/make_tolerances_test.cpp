// Tolerances of rasters and regions: the smallest applies, in memory and in windows.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "laws/array_source.h"
#include "laws/fields.h"
#include "scarp/tolerances.h"

namespace scarp::testing {
namespace {

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN(), kFree = std::numeric_limits<float>::infinity();

OwnedHeightField raster_of(int cols, int rows, const std::vector<float>& values) {
  OwnedHeightField raster;
  raster.cols = cols;
  raster.rows = rows;
  raster.samples = values;
  raster.info.path = "bounds.tif";
  return raster;
}

std::vector<float> values_of(int cols, int rows) {
  std::vector<float> values;
  for (int k = 0; k < cols * rows; ++k) values.push_back(k % 7 == 0 ? kNothing : static_cast<float>(k % 11) / 2);
  return values;
}

std::vector<Region> some_regions() {
  Region region;
  region.lines.resize(1);
  region.lines[0].points = {{5, 3, 0}, {20, 9, 0}};
  region.tolerance = 0.75;
  Region beside = region;
  beside.lines[0].points = {{500, 3, 0}, {600, 9, 0}};
  return {region, beside};
}

std::vector<float> read_all(const SampleSource& source, int cols, int rows) {
  std::vector<float> values(static_cast<std::size_t>(cols) * static_cast<std::size_t>(rows));
  EXPECT_TRUE(source.read(0, 0, cols, rows, values.data(), cols));
  return values;
}

TEST(MakeTolerances, TheSmallestCounts) {
  RegionGrid grid{30, 20};
  grid.beyond = 4;
  grid.falloff = 6;
  const std::vector<float> values = values_of(30, 20);
  const std::vector<Region> regions = some_regions();
  const std::vector<float> of_regions = region_tolerances(regions, grid);
  const auto made = make_tolerances(raster_of(30, 20, values), regions, grid);
  ASSERT_TRUE(made) << made.error().message;
  ASSERT_EQ(made->values.size(), values.size());
  for (std::size_t k = 0; k < values.size(); ++k)
    EXPECT_EQ(made->values[k], std::min(std::isnan(values[k]) ? kFree : values[k], of_regions[k])) << k;
  EXPECT_EQ(made->found, (std::vector<bool>{true, false}));
  EXPECT_EQ(make_tolerances(std::nullopt, regions, grid)->values, of_regions);
  EXPECT_EQ(made->source, nullptr);

  ToleranceOptions in_windows;
  in_windows.in_windows = true;
  const auto held = make_tolerances(raster_of(30, 20, values), regions, grid, in_windows);
  ASSERT_TRUE(held) << held.error().message;
  EXPECT_TRUE(held->values.empty());
  EXPECT_GT(held->bytes, 0u);
  EXPECT_EQ(held->found, made->found);
  EXPECT_EQ(read_all(*held->source, 30, 20), made->values);
  OwnedHeightField streamed = raster_of(30, 20, values);
  const HeightField view{values.data(), 30, 20};
  streamed.samples.clear();
  streamed.source = std::make_shared<ArraySource>(view);
  EXPECT_FALSE(make_tolerances(streamed, regions, grid)) << "values of a source are asked for in windows";
  const auto opened = make_tolerances(streamed, regions, grid, in_windows);
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_EQ(read_all(*opened->source, 30, 20), made->values);
  EXPECT_EQ(read_all(*make_tolerances(std::nullopt, regions, grid, in_windows)->source, 30, 20), of_regions);
}

TEST(MakeTolerances, AreNotAboveTheValuesOfTheFile) {
  RegionGrid grid{2, 2};
  OwnedHeightField raster = raster_of(2, 2, {0, 1, 0.1f, kNothing});
  raster.sample_rounding = 1e-9;
  const auto made = make_tolerances(raster, {}, grid);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->values, (std::vector<float>{0, std::nextafter(1.0f, 0.0f), std::nextafter(0.1f, 0.0f), kFree}));
}

TEST(MakeTolerances, RefuseWhatIsNone) {
  RegionGrid grid{3, 2};
  for (const bool in_windows : {false, true}) {
    ToleranceOptions options;
    options.in_windows = in_windows;
    const auto negative = make_tolerances(raster_of(3, 2, {1, 1, 1, 1, -5, 1}), {}, grid, options);
    ASSERT_FALSE(negative);
    EXPECT_EQ(negative.error().kind, ErrorKind::kInput);
    EXPECT_EQ(negative.error().message,
              "bounds.tif: the value -5 at column 1, row 1 is negative: it must be at least 0");
    const auto empty = make_tolerances(raster_of(3, 2, std::vector<float>(6, kNothing)), {}, grid, options);
    ASSERT_FALSE(empty);
    EXPECT_EQ(empty.error().kind, ErrorKind::kInput);
    EXPECT_EQ(make_tolerances(raster_of(2, 2, {1, 1, 1, 1}), {}, grid, options).error().kind, ErrorKind::kUsage);
    EXPECT_EQ(make_tolerances(std::nullopt, {}, grid, options).error().kind, ErrorKind::kUsage);
  }
}

TEST(MakeWeights, AreAtMostOne) {
  EXPECT_EQ(make_weights(raster_of(2, 2, {0, 50, 100, kNothing}))->values, (std::vector<float>{0, 0.5f, 1, 0}));
  EXPECT_EQ(make_weights(raster_of(2, 2, {0, 0.25f, 0.5f, 0}))->values, (std::vector<float>{0, 0.25f, 0.5f, 0}));
  EXPECT_EQ(make_weights(raster_of(2, 2, {0, kNothing, 0, 0})).error().kind, ErrorKind::kInput);
  EXPECT_EQ(make_weights(raster_of(2, 2, {0, 1, -1, 0})).error().kind, ErrorKind::kInput);
}

}  // namespace
}  // namespace scarp::testing
