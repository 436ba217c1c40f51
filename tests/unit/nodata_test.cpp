#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <array>
#include <cmath>
#include <limits>

#include "scarp/height_field.h"

namespace scarp {
namespace {

constexpr float kNodata = std::numeric_limits<float>::quiet_NaN();

OwnedHeightField field_of(int cols, int rows, std::vector<float> samples) {
  OwnedHeightField field;
  field.cols = cols;
  field.rows = rows;
  field.samples = std::move(samples);
  field.frame = grid_frame(rows);
  return field;
}

/// The definition, applied sample by sample. NaN: remains nodata.
double expected_fill(const OwnedHeightField& field, int col, int row, double max_distance) {
  double weight = 0, weighted = 0;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      if (dx == 0 && dy == 0) continue;
      for (int steps = 1;; ++steps) {
        const int c = col + dx * steps, r = row + dy * steps;
        if (c < 0 || r < 0 || c >= field.cols || r >= field.rows) break;
        const float z = field.samples[static_cast<std::size_t>(r * field.cols + c)];
        if (!std::isfinite(z)) continue;
        const double distance = steps * std::hypot(dx, dy);
        if (distance <= max_distance + 1e-12) {
          weight += 1 / (distance * distance);
          weighted += z / (distance * distance);
        }
        break;
      }
    }
  }
  return weight > 0 ? weighted / weight : kNodata;
}

TEST(Nodata, RangeCountsHeightsOnly) {
  auto field = field_of(2, 3, {3, kNodata, -7, std::numeric_limits<float>::infinity(), 5, 4});
  const HeightRange range = height_range(field);
  EXPECT_EQ(range.valid, 4u);
  EXPECT_EQ(range.min, -7);
  EXPECT_EQ(range.max, 5);
  HeightField borrowed = field.view();
  borrowed.nodata = -7.0f;
  EXPECT_EQ(height_range(borrowed).valid, 3u);
  EXPECT_EQ(height_range(borrowed).min, 3);
  const HeightRange none = height_range(field_of(2, 2, {kNodata, kNodata, kNodata, kNodata}));
  EXPECT_EQ(none.valid, 0u);
  EXPECT_EQ(none.min, 0);
  EXPECT_EQ(none.max, 0);
}

TEST(Nodata, FillAgreesWithItsDefinition) {
  EXPECT_TRUE(rc::check("fill_nodata is the weighted mean of the nearest heights in eight directions", [] {
    const int cols = *rc::gen::inRange(1, 14), rows = *rc::gen::inRange(1, 14);
    const int share = *rc::gen::inRange(1, 10);
    std::vector<float> samples;
    for (int k = 0; k < cols * rows; ++k) {
      const bool is_nodata = *rc::gen::inRange(0, 10) >= share;
      samples.push_back(is_nodata ? kNodata : static_cast<float>(*rc::gen::inRange(-1000, 9000)) / 8);
    }
    const double max_distance = *rc::gen::element(1.0, 1.5, 2.0, 3.7, 100.0);
    const auto given = field_of(cols, rows, samples);
    auto filled = given;
    const std::uint64_t count = fill_nodata(filled, max_distance);
    std::uint64_t expected_count = 0;
    for (int row = 0; row < rows; ++row) {
      for (int col = 0; col < cols; ++col) {
        const auto k = static_cast<std::size_t>(row * cols + col);
        if (std::isfinite(given.samples[k])) {
          RC_ASSERT(filled.samples[k] == given.samples[k]);
          continue;
        }
        const double expected = expected_fill(given, col, row, max_distance);
        RC_ASSERT(std::isnan(expected) == std::isnan(filled.samples[k]));
        if (std::isnan(expected)) continue;
        ++expected_count;
        RC_ASSERT(std::abs(filled.samples[k] - expected) < 1e-3);
      }
    }
    RC_ASSERT(count == expected_count);
  }));
}

TEST(Nodata, AFlatSurroundFillsFlat) {
  auto field = field_of(9, 9, std::vector<float>(81, 100.1f));
  for (int row = 2; row < 7; ++row) {
    for (int col = 1; col < 8; ++col) field.samples[static_cast<std::size_t>(row * 9 + col)] = kNodata;
  }
  EXPECT_EQ(fill_nodata(field, 100), 35u);
  for (const float z : field.samples) EXPECT_EQ(z, 100.1f);
}

TEST(Nodata, FarNodataStays) {
  auto field = field_of(7, 1, {5, kNodata, kNodata, kNodata, kNodata, kNodata, 9});
  EXPECT_EQ(fill_nodata(field, 2), 4u);
  EXPECT_EQ(field.samples[2], 5);
  EXPECT_TRUE(std::isnan(field.samples[3]));
  EXPECT_EQ(field.samples[4], 9);
}

TEST(Nodata, TheLargestHeightsFillToo) {
  constexpr float kLargest = std::numeric_limits<float>::max();
  auto field = field_of(5, 5, std::vector<float>(25, kNodata));
  for (int col = 0; col < 5; ++col) {
    field.samples[static_cast<std::size_t>(col)] = -kLargest;
    field.samples[static_cast<std::size_t>(20 + col)] = kLargest;
  }
  EXPECT_EQ(fill_nodata(field, 100), 15u);
  for (const float z : field.samples) EXPECT_TRUE(std::isfinite(z));
  EXPECT_LT(field.samples[7], -kLargest / 4);
  EXPECT_GT(field.samples[17], kLargest / 4);
  auto high = field_of(3, 3, std::vector<float>(9, kLargest));
  high.samples[0] = 0;
  high.samples[4] = kNodata;
  EXPECT_EQ(fill_nodata(high, 100), 1u);
  EXPECT_GT(high.samples[4], kLargest / 2);
}

TEST(Nodata, BackgroundFillsTheRest) {
  auto field = field_of(2, 2, {kNodata, 1, std::numeric_limits<float>::infinity(), 2});
  EXPECT_EQ(fill_background(field, -3), 2u);
  EXPECT_EQ(field.samples, (std::vector<float>{-3, 1, -3, 2}));
}

}  // namespace
}  // namespace scarp
