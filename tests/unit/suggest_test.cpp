// Max errors for meshes of given sizes.
#include <gtest/gtest.h>

#include <cmath>

#include "laws/fields.h"
#include "scarp/simplify.h"

namespace scarp::testing {
namespace {

TEST(Suggest, ADefaultRunStaysWithinTheShare) {
  const Field field = random_field(3, 90, 70, Relief::kRidges);
  const std::vector<double> shares{0.02, 0.1, 0.3};
  const auto suggestions = suggest_errors(field.view(), shares);
  ASSERT_TRUE(suggestions) << suggestions.error().message;
  ASSERT_EQ(suggestions->rows.size(), shares.size());
  EXPECT_FALSE(suggestions->is_estimate);
  EXPECT_EQ(suggestions->samples_used, 90u * 70u);
  const double full = 2 * 89 * 69;
  double last = HUGE_VAL;
  for (const Suggestion& row : suggestions->rows) {
    ASSERT_TRUE(row.error);
    EXPECT_LT(*row.error, last);
    last = *row.error;
    SimplifyOptions options;
    options.goals.max_error = *row.error;
    const auto simplified = simplify(field.view(), options);
    ASSERT_TRUE(simplified);
    const auto triangles = static_cast<double>(simplified->mesh.triangle_count());
    EXPECT_LE(triangles, row.share * full);
    EXPECT_GE(triangles, row.share * full / 8);
  }
}

TEST(Suggest, AnOutlineThatNeedsMoreHasNoError) {
  Field field = random_field(4, 40, 40, Relief::kReal, 0.4);
  const double share[] = {0.001};
  const auto suggestions = suggest_errors(field.view(), share);
  ASSERT_TRUE(suggestions) << suggestions.error().message;
  EXPECT_FALSE(suggestions->rows.front().error);
}

TEST(Suggest, RefusesSharesThatAreNone) {
  const Field field = random_field(5, 20, 20, Relief::kReal);
  for (const std::vector<double>& shares : {std::vector<double>{}, {0.0}, {0.5, 0.5}, {0.5, 0.2}, {1.5}, {NAN}}) {
    const auto suggestions = suggest_errors(field.view(), shares);
    ASSERT_FALSE(suggestions);
    EXPECT_EQ(suggestions.error().kind, ErrorKind::kUsage);
  }
  const double share[] = {0.5};
  const auto stopped = suggest_errors(field.view(), share, [](const Progress&) { return false; });
  EXPECT_TRUE(stopped || stopped.error().kind == ErrorKind::kCancelled);
}

}  // namespace
}  // namespace scarp::testing
