// Judging with channels, masks, tolerances and ignored samples, against manual sums.
#include "measure/judge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "laws/array_bounds.h"
#include "laws/array_source.h"
#include "unit/measure_meshes.h"

namespace scarp::testing {
namespace {

struct Case {
  Terrain terrain = wavy_terrain(61, 41);
  Mesh mesh;
  std::vector<double> errors;  // |mesh − sample|, as float32

  Case() {
    mesh = grid_mesh(terrain, 10);
    MeasureOptions options;
    options.on_row = [&](int, std::span<const float> row) {
      for (const float error : row) errors.push_back(std::abs(double{error}));
    };
    EXPECT_TRUE(measure(terrain.view(), mesh, options));
  }
};

double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double value : values) most = std::isnan(value) ? most : std::max(most, value);
  return most;
}

TEST(Judge, WeighsByAMask) {
  const Case given;
  std::mt19937 random(2);
  std::vector<float> mask(given.errors.size());
  for (float& weight : mask) weight = static_cast<float>(random() % 5) / 4;
  std::vector<double> weighed, bounded;
  std::uint64_t without = 0, over = 0;
  for (std::size_t k = 0; k < mask.size(); ++k) {
    weighed.push_back(double{mask[k]} * given.errors[k]);
    without += mask[k] == 0;
    if (mask[k] > 0) bounded.push_back(given.errors[k]);
  }
  const double bound = largest(weighed) / 2;
  for (const double value : weighed) over += value > bound * (1 + 1e-6);
  judge::JudgeOptions options;
  options.tolerances.weights = mask;
  options.max_error = bound;
  const auto judged = judge::judge_mesh(given.terrain.view(), given.mesh, options);
  ASSERT_TRUE(judged) << judged.error().message;
  ASSERT_TRUE(judged->weighted);
  EXPECT_EQ(judged->weighted->largest.value, largest(weighed));
  EXPECT_EQ(judged->weighted->over, over);
  EXPECT_GT(over, 0u);
  EXPECT_EQ(judged->ignored, without);
  EXPECT_NEAR(judged->bounded.value, largest(bounded), 1e-5);
  EXPECT_FALSE(judged->combined);
  EXPECT_TRUE(judged->height_errors.empty());
}

TEST(Judge, WeighsByTolerancesInMemoryAndInWindows) {
  const Case given;
  std::mt19937 random(3);
  std::vector<float> tolerance(given.errors.size());
  for (float& bound : tolerance) bound = random() % 9 == 0 ? kNoBound : static_cast<float>(random() % 100 + 1) / 10;
  std::vector<double> ratios;
  std::uint64_t over = 0, without = 0;
  for (std::size_t k = 0; k < tolerance.size(); ++k) {
    ratios.push_back(given.errors[k] / double{tolerance[k]});
    over += ratios[k] > 1 + 1e-6;
    without += tolerance[k] == kNoBound;
  }
  judge::JudgeOptions options;
  options.tolerances.values = tolerance;
  const auto held = judge::judge_mesh(given.terrain.view(), given.mesh, options);
  ASSERT_TRUE(held) << held.error().message;
  EXPECT_EQ(held->weighted->largest.value, largest(ratios));
  EXPECT_EQ(held->weighted->over, over);
  EXPECT_EQ(held->ignored, without);
  EXPECT_GT(over, 0u);

  const HeightField field = given.terrain.view();
  const ArraySource heights(field);
  options.tolerances.values = {};
  const ArrayBounds in_windows(tolerance, field.cols);
  options.tolerances.source = &in_windows;
  const auto streamed = judge::judge_mesh(with_source(field, heights), given.mesh, options);
  ASSERT_TRUE(streamed) << streamed.error().message;
  EXPECT_EQ(streamed->weighted->largest.value, held->weighted->largest.value);
  EXPECT_EQ(streamed->weighted->bounded.at, held->weighted->bounded.at);
  EXPECT_EQ(streamed->weighted->rmse, held->weighted->rmse);
  EXPECT_EQ(streamed->weighted->over, held->weighted->over);
  EXPECT_EQ(streamed->ignored, held->ignored);
  EXPECT_EQ(streamed->bounded.value, held->bounded.value);
  EXPECT_EQ(streamed->bounded.at, held->bounded.at);
  // A bound of all samples covers each of them.
  options.max_error = 100;
  EXPECT_EQ(judge::judge_mesh(with_source(field, heights), given.mesh, options)->ignored, 0u);
}

TEST(Judge, CombinesChannelsByTheNorm) {
  Case given;
  const std::size_t samples = given.errors.size();
  std::vector<float> band(samples);
  for (std::size_t k = 0; k < samples; ++k) band[k] = static_cast<float>(k % 61) * 2;
  given.mesh.channel_count = 1;
  given.mesh.channels.assign(given.mesh.vertex_count(), 60);
  HeightField field = given.terrain.view();
  field.channels = {{band.data(), 0.5}};
  field.height_scale = 2;
  for (const Norm norm : {Norm::kSum, Norm::kSquares, Norm::kMax}) {
    judge::JudgeOptions options;
    options.norm = norm;
    options.keep_errors = true;
    const auto judged = judge::judge_mesh(field, given.mesh, options);
    ASSERT_TRUE(judged) << judged.error().message;
    ASSERT_EQ(judged->norms.size(), samples);
    ASSERT_EQ(judged->channels.size(), 1u);
    double most = 0;
    for (std::size_t k = 0; k < samples; ++k) {
      const double a = 2 * given.errors[k], b = 0.5 * std::abs(60 - double{band[k]});
      const double wanted = norm == Norm::kSum ? a + b : norm == Norm::kSquares ? std::hypot(a, b) : std::max(a, b);
      EXPECT_NEAR(judged->norms[k], wanted, 1e-5 * wanted) << k;
      most = std::max(most, judged->norms[k]);
    }
    EXPECT_EQ(judged->combined->largest.value, most);
    const std::vector<float> raster = judge::take_error_raster(*judged, judge::ErrorsOf::kNorms);
    EXPECT_EQ(raster[100], static_cast<float>(judged->norms[100]));
  }
}

TEST(Judge, LeavesOutIgnoredSamples) {
  const Case given;
  const auto worst = std::max_element(given.errors.begin(), given.errors.end()) - given.errors.begin();
  const SampleAt ignored[] = {{static_cast<std::int32_t>(worst % 61), static_cast<std::int32_t>(worst / 61)}};
  judge::JudgeOptions options;
  options.tolerances.ignored = ignored;
  const auto judged = judge::judge_mesh(given.terrain.view(), given.mesh, options);
  ASSERT_TRUE(judged) << judged.error().message;
  EXPECT_EQ(judged->ignored, 1u);
  EXPECT_LT(judged->bounded.value, judged->heights.max_error);
  EXPECT_TRUE(judged->heights.offenders.empty());
}

TEST(Judge, RefusesWhatDoesNotFit) {
  const Case given;
  const HeightField field = given.terrain.view();
  const std::vector<float> all(given.errors.size(), 1), few(7, 1);
  judge::JudgeOptions few_weights, both, negative, outside;
  few_weights.tolerances.weights = few;
  both.tolerances.weights = both.tolerances.values = all;
  negative.max_error = -1;
  const SampleAt beyond[] = {{61, 0}};
  outside.tolerances.ignored = beyond;
  for (const judge::JudgeOptions& options : {few_weights, both, negative, outside}) {
    const auto judged = judge::judge_mesh(field, given.mesh, options);
    ASSERT_FALSE(judged);
    EXPECT_EQ(judged.error().kind, ErrorKind::kUsage);
  }
  HeightField coloured = field;
  coloured.channels = {{all.data(), 1}};
  EXPECT_FALSE(judge::judge_mesh(coloured, given.mesh));
  EXPECT_TRUE(judge::judge_mesh(field, given.mesh));
}

}  // namespace
}  // namespace scarp::testing
