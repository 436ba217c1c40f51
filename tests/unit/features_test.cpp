// Declared features: lines of a mesh with one max error.
#include "scarp/features.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "laws/array_source.h"
#include "laws/fields.h"
#include "scarp/simplify.h"

namespace scarp::testing {
namespace {

constexpr double kNoHeight = std::numeric_limits<double>::quiet_NaN();

/// Land that falls to the east, with a wall across it.
Field walled_slope() {
  Field field{60, 40, {}};
  for (int row = 0; row < field.rows; ++row) {
    for (int col = 0; col < field.cols; ++col)
      field.samples.push_back(static_cast<float>(100 - col + 3 * std::sin(0.7 * row) + (3 * row > col + 70 ? 50 : 0)));
  }
  return field;
}

Features declare(const Field& field) {
  Features features;
  features.breaklines.affine = grid_frame(field.rows).affine;
  Line river;
  river.points = {{2, 30, kNoHeight}, {30, 32, kNoHeight}, {58, 29, kNoHeight}};
  features.rivers.push_back(river);
  features.walls = WallGoals{20};
  features.ridges = RidgeGoals{2};
  return features;
}

bool same_points(const Line& a, const Line& b) {
  if (a.points.size() != b.points.size()) return false;
  for (std::size_t k = 0; k < a.points.size(); ++k) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (a.points[k][i] != b.points[k][i] && !(std::isnan(a.points[k][i]) && std::isnan(b.points[k][i]))) return false;
    }
  }
  return true;
}

TEST(Features, AreFittedInTheirOrder) {
  const Field field = walled_slope();
  const Features features = declare(field);
  EXPECT_TRUE(features.depend_on_error());
  const auto fitted = fit_features(field.view(), features, {1.0});
  ASSERT_TRUE(fitted) << fitted.error().message;
  ASSERT_EQ(fitted->rivers.size(), 1u);
  ASSERT_TRUE(fitted->walls && fitted->ridges);
  EXPECT_GT(fitted->walls->wall_count, 0u);

  std::vector<Line> lines;
  const auto rivers = carve_rivers(field.view(), features.rivers, {}, {features.breaklines.affine, 0.5});
  ASSERT_TRUE(rivers);
  lines.push_back(rivers->front().course);
  const auto walls = detect_cliffs(field.view(), {20, 1, features.breaklines.affine, lines});
  ASSERT_TRUE(walls);
  lines.insert(lines.end(), walls->lines.begin(), walls->lines.end());
  const auto ridges = detect_ridges(field.view(), {2, 1, features.breaklines.affine, lines});
  ASSERT_TRUE(ridges);
  for (const auto* found : {&ridges->ridges, &ridges->valleys}) lines.insert(lines.end(), found->begin(), found->end());
  ASSERT_EQ(fitted->lines.lines.size(), lines.size());
  for (std::size_t k = 0; k < lines.size(); ++k) EXPECT_TRUE(same_points(fitted->lines.lines[k], lines[k])) << k;
  EXPECT_EQ(fitted->given_lines(), 1u);
}

TEST(Features, ServeABudgetsSearch) {
  const Field field = walled_slope();
  const Features features = declare(field);
  SimplifyOptions options;
  options.goals.max_triangles = 600;
  options.features = features;
  const auto simplified = simplify(field.view(), options);
  ASSERT_TRUE(simplified) << simplified.error().message;
  EXPECT_LE(simplified->mesh.triangle_count(), 600u);
  const auto fitted = fit_features(field.view(), features, {simplified->lines_for});
  ASSERT_TRUE(fitted);
  EXPECT_GE(fitted->lines.lines.size(), simplified->lines_inserted);
}

TEST(Features, AreThoseOfAnyKindOfSamples) {
  const Field field = walled_slope();
  const Features features = declare(field);
  const auto held = fit_features(field.view(), features, {1.0});
  const ArraySource source(field.view());
  const auto streamed = fit_features(with_source(field.view(), source), features, {1.0});
  Field coded = field;
  coded.samples[5] = std::numeric_limits<float>::infinity();
  coded.samples[9] = -9999;
  HeightField with_nodata = coded.view();
  with_nodata.nodata = -9999.0f;
  Field holed = field;
  holed.samples[5] = holed.samples[9] = std::numeric_limits<float>::quiet_NaN();
  const auto nodata = fit_features(with_nodata, features, {1.0}), holes = fit_features(holed.view(), features, {1.0});
  ASSERT_TRUE(held && streamed && nodata && holes);
  for (const auto& [a, b] : {std::pair{&*held, &*streamed}, std::pair{&*nodata, &*holes}}) {
    ASSERT_EQ(a->lines.lines.size(), b->lines.lines.size());
    for (std::size_t k = 0; k < a->lines.lines.size(); ++k)
      EXPECT_TRUE(same_points(a->lines.lines[k], b->lines.lines[k])) << k;
  }
}

TEST(Features, RefuseErrorsThatAreNone) {
  const Field field = walled_slope();
  for (const double error : {-1.0, kNoHeight, HUGE_VAL}) {
    const auto fitted = fit_features(field.view(), {}, {error});
    ASSERT_FALSE(fitted);
    EXPECT_EQ(fitted.error().kind, ErrorKind::kUsage);
  }
  Features features = declare(field);
  features.walls = WallGoals{0};
  EXPECT_FALSE(fit_features(field.view(), features, {1.0}));
  EXPECT_FALSE(Features().depend_on_error());
}

}  // namespace
}  // namespace scarp::testing
