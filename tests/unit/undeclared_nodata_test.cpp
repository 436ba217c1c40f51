// Heights that are undeclared nodata, and those that only appear so.
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "scarp/height_field.h"

namespace scarp {
namespace {

std::vector<UndeclaredNodata> find(const std::vector<float>& samples) {
  HeightField field;
  field.samples = samples.data();
  field.cols = static_cast<int>(samples.size() / 2);
  field.rows = 2;
  return find_undeclared_nodata(height_range(field));
}

/// 2000 heights in steps of a tenth, then some of `value`.
std::vector<float> land_beside(float value, int count, float lowest = 0, float step = 0.1F) {
  std::vector<float> samples;
  for (int k = 0; k < 2000; ++k) samples.push_back(lowest + step * static_cast<float>(k * 7 % 2000));
  samples.insert(samples.begin() + 500, static_cast<std::size_t>(count), value);
  return samples;
}

TEST(undeclared_nodata, usual_signs_are_found_at_either_end_and_counted) {
  for (const float value :
       {-9999.0F, -10000.0F, -32768.0F, -32767.0F, -999.0F, 32767.0F, 65535.0F, -3.4028235e38F, 1e20F}) {
    const auto found = find(land_beside(value, 6));
    ASSERT_EQ(found.size(), 1U) << value;
    EXPECT_EQ(found[0].of.height, value);
    EXPECT_EQ(found[0].of.samples, 6U);
    EXPECT_EQ(found[0].is_high, value > 0);
    EXPECT_EQ(found[0].min, 0);
  }
}

TEST(undeclared_nodata, signs_are_values_of_the_file_whatever_heights_are_made_of_them) {
  for (const auto& [scale, offset] : {std::pair{0.3048, 0.0}, {0.1, 0.0}, {3.28084, -20.0}, {-1.0, 100.0}}) {
    auto samples = land_beside(-9999, 6);
    for (float& z : samples) z = static_cast<float>(scale * double{z} + offset);
    HeightField field;
    field.samples = samples.data();
    field.cols = static_cast<int>(samples.size() / 2);
    field.rows = 2;
    const auto found = find_undeclared_nodata(height_range(field), scale, offset);
    ASSERT_EQ(found.size(), 1U) << scale;
    EXPECT_EQ(found[0].value, -9999);
    EXPECT_EQ(found[0].of.height, static_cast<float>(scale * -9999 + offset));
  }
}

TEST(undeclared_nodata, several_signs_and_spikes_do_not_hide_each_other) {
  auto samples = land_beside(-9999, 40);
  samples.insert(samples.end(), 30, -32768.0F);
  samples.push_back(1e7F);
  samples.push_back(2e7F);
  const auto found = find(samples);
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ(found[0].of.height, -32768);
  EXPECT_EQ(found[1].of.height, -9999);
  EXPECT_EQ(found[1].of.samples, 40U);
  EXPECT_EQ(found[2].of.height, 2e7);
  EXPECT_EQ(found[3].of.height, 1e7);
}

TEST(undeclared_nodata, zeros_below_land_that_begins_far_above_are_found) {
  EXPECT_EQ(find(land_beside(0, 200, 37)).size(), 1U);
  EXPECT_EQ(find(land_beside(0, 200, -400)).size(), 1U);
}

TEST(undeclared_nodata, a_whole_number_that_many_samples_have_stands_as_far_away_as_others_reach) {
  for (const float value : {-99.0F, -1.0F, 255.0F, 1000.0F}) {
    const auto found = find(land_beside(value, 140, 500));
    ASSERT_EQ(found.size(), 1U) << value;
    EXPECT_EQ(found[0].value, value);
    EXPECT_EQ(found[0].of.samples, 140U);
    EXPECT_TRUE(find(land_beside(value, 9, 500)).empty()) << "towers or pits";
    EXPECT_TRUE(find(land_beside(value + 0.3F, 140, 500)).empty()) << "no sign";
    EXPECT_TRUE(find(land_beside(value, 2100, 500)).empty()) << "land around a hill";
  }
  EXPECT_TRUE(find(land_beside(350, 140, 500)).empty()) << "a lake below a cliff";
  EXPECT_TRUE(find({10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 40, 40, 41, 41, 41, 42, 42, 42, 43, 43}).empty())
      << "steps";
}

TEST(undeclared_nodata, honest_heights_are_not) {
  EXPECT_TRUE(find(land_beside(0, 900, 0.3F)).empty()) << "a sea";
  EXPECT_TRUE(find(land_beside(0, 900, 5)).empty()) << "a sea with quays";
  EXPECT_TRUE(find(land_beside(0, 900, 0.5F, 0.001F)).empty()) << "a sea beside a polder";
  EXPECT_TRUE(find(land_beside(0, 900, 30, 1)).empty()) << "a sea with cliffs";
  EXPECT_TRUE(find(land_beside(-9999, 3, -11000, 5)).empty()) << "a deep sea";
  EXPECT_TRUE(find(land_beside(9999, 3, 0, 5)).empty()) << "a range of heights that has it";
  EXPECT_TRUE(find(land_beside(900, 3)).empty()) << "a tower";
  EXPECT_TRUE(find({0, 0, 0, 0, 100, 100, 100, 100}).empty()) << "two levels";
  EXPECT_TRUE(find({5, 5, 5, 5}).empty()) << "a plain";
}

TEST(undeclared_nodata, levels_of_contours_are_not) {
  for (int levels = 2; levels < 20; ++levels) {
    std::vector<float> heights;
    for (int level = 0; level < levels; ++level)
      heights.insert(heights.end(), 100, static_cast<float>(300 + 5 * level));
    EXPECT_TRUE(find(heights).empty()) << levels;
  }
}

TEST(undeclared_nodata, stands_around_a_plain) { EXPECT_FALSE(find({-9999, -9999, 5, 5}).empty()); }

TEST(undeclared_nodata, ends_of_a_range_are_those_of_its_parts) {
  const auto samples = land_beside(-9999, 6);
  HeightField all;
  all.samples = samples.data();
  all.cols = static_cast<int>(samples.size() / 2);
  all.rows = 2;
  HeightField part = all;
  part.rows = 1;
  HeightRange sum = height_range(part);
  part.samples += part.cols;
  sum.add(height_range(part));
  const HeightRange whole = height_range(all);
  EXPECT_EQ(sum.valid, whole.valid);
  for (std::size_t k = 0; k < HeightRange::kEnds; ++k) {
    EXPECT_EQ(sum.lowest[k].height, whole.lowest[k].height);
    EXPECT_EQ(sum.lowest[k].samples, whole.lowest[k].samples);
    EXPECT_EQ(sum.highest[k].height, whole.highest[k].height);
    EXPECT_EQ(sum.highest[k].samples, whole.highest[k].samples);
  }
  EXPECT_EQ(whole.lowest[0].samples, 6U);
}

}  // namespace
}  // namespace scarp
