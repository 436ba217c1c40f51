// Samples at places beyond the precision of float32 or even double.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "scarp/measure.h"
#include "scarp/simplify.h"

namespace scarp::placed_samples_test {
namespace {

constexpr int kSide = 40;

struct Slopes {
  std::vector<float> samples;
  HeightField field;

  Slopes(double west, double cell) {
    for (int k = 0; k < kSide * kSide; ++k)
      samples.push_back(
          static_cast<float>(std::round(1000 * std::sin(0.3 * (k % kSide)) * std::cos(0.2 * (k / kSide)))));
    field.samples = samples.data();
    field.cols = field.rows = kSide;
    field.frame.kind = Frame::Kind::kSource;
    field.frame.affine = {west, cell, 0, west, 0, -cell};
  }
};

TEST(PlacedSamples, ARefinersMeshInDoubleHasTheErrorThatItTells) {
  const Slopes slopes(4e5, 0.1);
  auto refiner = Refiner::create(slopes.field);
  ASSERT_TRUE(refiner);
  while (refiner->max_error() > 5 && refiner->insert_worst()) {
  }
  const auto error_of = [&](const Mesh& mesh) { return measure(slopes.field, mesh)->max_error; };
  EXPECT_EQ(error_of(refiner->mesh(false)), refiner->max_error());
  EXPECT_GT(error_of(refiner->mesh()), refiner->max_error()) << "in float32 the vertices have moved";
}

TEST(PlacedSamples, WhereDoubleDoesNotTellThemApartASentenceSaysSo) {
  EXPECT_TRUE(simplify(Slopes(1e12, 1).field, Goals{.max_error = 5}));
  for (const double far : {1e16, -1e20, 1e300}) {
    const auto refused = simplify(Slopes(far, 1).field, Goals{.max_error = 5});
    ASSERT_FALSE(refused) << far;
    EXPECT_EQ(refused.error().kind, ErrorKind::kPromise);
    EXPECT_NE(refused.error().message.find("cannot tell samples 1 apart"), std::string::npos)
        << refused.error().message;
  }
}

}  // namespace
}  // namespace scarp::placed_samples_test
