// Laws of sources: reading by windows gives the same samples and verdicts as memory.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>

#include "laws/array_source.h"
#include "laws/fields.h"
#include "scarp/measure.h"
#include "scarp/picture.h"
#include "scarp/simplify.h"

namespace scarp::source_laws_test {
namespace {

using testing::ArraySource;
using testing::Field;
using testing::Relief;
using testing::with_source;

Field any_field(int least, int largest) {
  const auto relief =
      *rc::gen::elementOf(std::vector<Relief>(std::begin(testing::kReliefs), std::end(testing::kReliefs)));
  return testing::random_field(*rc::gen::arbitrary<std::uint32_t>(), *rc::gen::inRange(least, largest),
                               *rc::gen::inRange(least, largest), relief, *rc::gen::element(0.0, 0.1, 0.5));
}

void expect_same(const Measurement& a, const Measurement& b) {
  const auto numbers = [](const Measurement& m) {
    return std::vector<double>{m.max_error,
                               m.mean_error,
                               m.mean_abs_error,
                               m.rmse,
                               m.p50,
                               m.p95,
                               m.p99,
                               m.p999,
                               m.heights.min,
                               m.heights.max,
                               m.min_angle,
                               static_cast<double>(m.max_error_at[0]),
                               static_cast<double>(m.max_error_at[1]),
                               static_cast<double>(m.uncovered_at[0]),
                               static_cast<double>(m.uncovered_at[1]),
                               static_cast<double>(m.samples),
                               static_cast<double>(m.uncovered),
                               static_cast<double>(m.stray),
                               static_cast<double>(m.nodata_cells_covered),
                               static_cast<double>(m.over_tolerance),
                               static_cast<double>(m.heights.valid),
                               static_cast<double>(m.offenders.size()),
                               static_cast<double>(m.gaps)};
  };
  const auto x = numbers(a), y = numbers(b);
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (std::bit_cast<std::uint64_t>(x[k]) != std::bit_cast<std::uint64_t>(y[k]))
      ADD_FAILURE() << "number " << k << ": " << x[k] << " and " << y[k];
    RC_ASSERT(std::bit_cast<std::uint64_t>(x[k]) == std::bit_cast<std::uint64_t>(y[k]));
  }
}

/// A mesh of another field of the same size: errors of all sizes, uncovered samples, covered nodata, gaps.
RC_GTEST_PROP(sources, are_judged_as_the_same_samples_in_memory, ()) {
  const Field field = any_field(2, 90);
  Field other = testing::random_field(*rc::gen::arbitrary<std::uint32_t>(), field.cols, field.rows, Relief::kRidges,
                                      *rc::gen::element(0.0, 0.3));
  const auto result = simplify(other.view(), {.goals = {.max_error = *rc::gen::element(0.0, 2.0, 20.0)}});
  RC_PRE(result.has_value());
  HeightField in_core = field.view();
  if (*rc::gen::arbitrary<bool>()) in_core.nodata = 2.0f;
  const ArraySource source(in_core);
  MeasureOptions options;
  options.run.threads = 1;
  options.collect_above = *rc::gen::element(0.0, 5.0);
  const auto from_memory = measure(in_core, result->mesh, options);
  options.run.threads = *rc::gen::element(1, 3);
  const auto from_source = measure(with_source(in_core, source), result->mesh, options);
  RC_ASSERT(from_memory.has_value() && from_source.has_value());
  expect_same(*from_memory, *from_source);
}

RC_GTEST_PROP(sources, of_16_bit_codes_give_the_heights_of_their_table, ()) {
  const int cols = *rc::gen::inRange(2, 20), rows = *rc::gen::inRange(2, 20);
  const auto size = static_cast<std::size_t>(cols * rows);
  const auto codes = *rc::gen::container<std::vector<std::uint16_t>>(size, rc::gen::arbitrary<std::uint16_t>());
  std::vector<float> heights(65536);
  for (std::size_t code = 0; code < heights.size(); ++code)
    heights[code] = code % 7 == 3 ? NAN : 0.1f * static_cast<float>(code);
  const auto source = make_coded_source(codes, cols, heights);
  const int col = *rc::gen::inRange(0, cols), row = *rc::gen::inRange(0, rows);
  const int width = *rc::gen::inRange(1, cols - col + 1), height = *rc::gen::inRange(1, rows - row + 1);
  const int stride = width + *rc::gen::inRange(0, 3);
  std::vector<float> out(static_cast<std::size_t>(stride * height), -1.0f);
  RC_ASSERT(source->read(col, row, width, height, out.data(), stride).has_value());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < stride; ++x) {
      const float z = out[static_cast<std::size_t>(y * stride + x)];
      if (x >= width) {
        RC_ASSERT(z == -1.0f);
        continue;
      }
      const float wanted = heights[codes[static_cast<std::size_t>((row + y) * cols + col + x)]];
      RC_ASSERT(std::bit_cast<std::uint32_t>(z) == std::bit_cast<std::uint32_t>(wanted));
    }
  }
}

TEST(sources, that_break_in_the_middle_end_the_judging_with_their_own_error) {
  const Field field = testing::random_field(3, 60, 200, Relief::kRidges);
  const auto result = simplify(field.view(), {.goals = {.max_error = 5.0}});
  ASSERT_TRUE(result);
  for (const int threads : {1, 4}) {
    const ArraySource source(field.view(), 130);
    MeasureOptions options;
    options.run.threads = threads;
    const auto measured = measure(with_source(field.view(), source), result->mesh, options);
    ASSERT_FALSE(measured);
    EXPECT_EQ(measured.error().kind, ErrorKind::kInput);
    EXPECT_EQ(measured.error().message, "row 130 is broken");
  }
}

TEST(sources, have_no_range_before_they_are_read) {
  const Field field = testing::random_field(3, 12, 10, Relief::kRidges);
  const ArraySource source(field.view());
  EXPECT_EQ(height_range(with_source(field.view(), source)).valid, 0u);
}

TEST(sources, give_the_approximation_of_samples_in_memory) {
  const Field field = testing::random_field(3, 90, 170, Relief::kRidges, 0.1);
  const auto result = simplify(field.view(), {.goals = {.max_error = 5.0}});
  ASSERT_TRUE(result);
  const ArraySource source(field.view()), broken(field.view(), 130);
  const auto held = resample(field.view(), result->mesh);
  const auto streamed = resample(with_source(field.view(), source), result->mesh, 3);
  ASSERT_TRUE(held && streamed);
  ASSERT_EQ(held->size(), streamed->size());
  for (std::size_t k = 0; k < held->size(); ++k) {
    if (std::isnan((*held)[k])) continue;
    ASSERT_EQ((*held)[k], (*streamed)[k]);
    ASSERT_LE(std::abs((*held)[k] - field.samples[k]), 5.001f);
  }
  EXPECT_EQ(resample(with_source(field.view(), broken), result->mesh).error().message, "row 130 is broken");
}

TEST(sources, give_the_preview_of_samples_in_memory) {
  const Field field = testing::random_field(3, 90, 170, Relief::kRidges, 0.1);
  const auto result = simplify(field.view(), {.goals = {.max_error = 5.0}});
  ASSERT_TRUE(result);
  const ArraySource source(field.view()), broken(field.view(), 130);
  const auto held = draw_preview(field.view(), result->mesh);
  const auto streamed = draw_preview(with_source(field.view(), source), result->mesh);
  ASSERT_TRUE(held && streamed);
  EXPECT_GT(held->width, 90);
  EXPECT_EQ(held->rgb, streamed->rgb);
  EXPECT_EQ(draw_preview(with_source(field.view(), broken), result->mesh).error().message, "row 130 is broken");
}

TEST(measuring, tells_the_range_of_all_samples_and_the_first_uncovered_one) {
  Field field = testing::random_field(3, 12, 10, Relief::kRidges);
  const HeightRange range = height_range(field.view());
  auto result = simplify(field.view(), {.goals = {.max_error = 0.0}});
  ASSERT_TRUE(result);
  auto measured = measure(field.view(), result->mesh);
  ASSERT_TRUE(measured);
  EXPECT_EQ(measured->heights.valid, range.valid);
  EXPECT_EQ(measured->heights.min, range.min);
  EXPECT_EQ(measured->heights.max, range.max);
  EXPECT_EQ(measured->uncovered_at, (std::array<std::int32_t, 2>{-1, -1}));
}

}  // namespace
}  // namespace scarp::source_laws_test
