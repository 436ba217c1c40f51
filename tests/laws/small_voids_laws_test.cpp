// Laws of small voids: in all windows, small voids are filled as by fill_nodata(), and other voids are not.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "grid/small_voids.h"
#include "laws/array_source.h"

namespace scarp::small_voids_laws_test {
namespace {

using testing::ArraySource;

OwnedHeightField any_holes() {
  OwnedHeightField field;
  field.cols = *rc::gen::inRange(2, 40);
  field.rows = *rc::gen::inRange(2, 40);
  const int share = *rc::gen::element(2, 10, 40);  // percent
  for (int k = 0; k < field.cols * field.rows; ++k)
    field.samples.push_back(*rc::gen::inRange(0, 100) < share ? NAN : static_cast<float>(*rc::gen::inRange(0, 500)));
  return field;
}

/// True for each sample of an enclosed void of at most `side` samples per side, by a search from each sample.
std::vector<bool> find_small(const OwnedHeightField& field, int side) {
  const int cols = field.cols, rows = field.rows;
  std::vector<bool> small(field.samples.size(), false), seen(field.samples.size(), false);
  for (int start = 0; start < cols * rows; ++start) {
    if (seen[static_cast<std::size_t>(start)] || !std::isnan(field.samples[static_cast<std::size_t>(start)])) continue;
    std::vector<int> area{start};
    seen[static_cast<std::size_t>(start)] = true;
    int left = cols, right = 0, top = rows, bottom = 0;
    for (std::size_t k = 0; k < area.size(); ++k) {
      const int col = area[k] % cols, row = area[k] / cols;
      left = std::min(left, col), right = std::max(right, col), top = std::min(top, row),
      bottom = std::max(bottom, row);
      for (int y = std::max(row - 1, 0); y <= std::min(row + 1, rows - 1); ++y) {
        for (int x = std::max(col - 1, 0); x <= std::min(col + 1, cols - 1); ++x) {
          const auto at = static_cast<std::size_t>(y * cols + x);
          if (seen[at] || !std::isnan(field.samples[at])) continue;
          seen[at] = true;
          area.push_back(y * cols + x);
        }
      }
    }
    const bool is_small =
        left > 0 && top > 0 && right < cols - 1 && bottom < rows - 1 && right - left < side && bottom - top < side;
    for (const int at : area) small[static_cast<std::size_t>(at)] = is_small;
  }
  return small;
}

bool is_same(float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }

RC_GTEST_PROP(small_voids, are_filled_as_fill_nodata_does_and_nothing_else_is, ()) {
  const OwnedHeightField given = any_holes();
  const int side = *rc::gen::inRange(1, 12);
  const std::vector<bool> small = find_small(given, side);
  OwnedHeightField filled = given, everywhere = given;
  const VoidCount count = grid::fill_small_voids(filled, side);
  fill_nodata(everywhere, side);
  std::uint64_t of_small = 0, missing = 0;
  for (std::size_t k = 0; k < small.size(); ++k) {
    of_small += small[k] ? 1U : 0U;
    missing += std::isnan(given.samples[k]) ? 1U : 0U;
    RC_ASSERT(is_same(filled.samples[k], small[k] ? everywhere.samples[k] : given.samples[k]));
  }
  RC_ASSERT(count.filled == of_small);
  RC_ASSERT(count.left == missing - of_small);
}

RC_GTEST_PROP(small_voids, look_the_same_through_every_window, ()) {
  const OwnedHeightField given = any_holes();
  const int side = *rc::gen::inRange(1, 12), cols = given.cols, rows = given.rows;
  OwnedHeightField filled = given;
  const VoidCount count = grid::fill_small_voids(filled, side);
  const ArraySource array(given.view());
  const HeightField streamed = testing::with_source(given.view(), array);
  const auto source = grid::without_small_voids(*rc::gen::element(true, false) ? streamed : given.view(), side);
  const int col = *rc::gen::inRange(0, cols), row = *rc::gen::inRange(0, rows);
  const int width = *rc::gen::inRange(1, cols - col + 1), height = *rc::gen::inRange(1, rows - row + 1);
  const int stride = width + *rc::gen::inRange(0, 3);
  std::vector<float> window(static_cast<std::size_t>(stride) * static_cast<std::size_t>(height), -1.0F);
  RC_ASSERT(source->read(col, row, width, height, window.data(), stride).has_value());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < stride; ++x) {
      const float seen = window[static_cast<std::size_t>(y * stride + x)];
      const bool is_right = x < width
                                ? is_same(seen, filled.samples[static_cast<std::size_t>((row + y) * cols + col + x)])
                                : seen == -1.0F;
      RC_ASSERT(is_right);
    }
  }
  const auto counted = grid::count_voids(streamed, side);
  RC_ASSERT(counted.has_value());
  RC_ASSERT(counted->filled == count.filled && counted->left == count.left && counted->least == count.least &&
            counted->most == count.most);
}

TEST(SmallVoids, TellHowHighTheLandAroundThoseThatAreLeftLies) {
  OwnedHeightField field;
  field.cols = field.rows = 9;
  field.samples.assign(81, 500.0F);
  for (const int at : {9 * 1 + 1, 9 * 4 + 3, 9 * 4 + 4, 9 * 4 + 5, 8})
    field.samples[static_cast<std::size_t>(at)] = NAN;
  field.samples[9 * 3 + 4] = 420;
  field.samples[7] = 3;
  const VoidCount count = grid::fill_small_voids(field, 2);
  EXPECT_EQ(count.filled, 1u);
  EXPECT_EQ(count.left, 4u);
  EXPECT_EQ(count.least, 420) << "the sea's shore lies lower";
  EXPECT_EQ(count.most, 500);
  EXPECT_EQ(field.samples[9 * 1 + 1], 500);
}

}  // namespace
}  // namespace scarp::small_voids_laws_test
