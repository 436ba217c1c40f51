// Steps to the nearest sample of a set in a column, against a scan of every sample.
#include "grid/column_runs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>

namespace scarp {
namespace {

TEST(column_runs, know_the_steps_to_the_next_sample_above_or_below) {
  std::mt19937 random(3);
  const auto below = [&](int n) { return static_cast<std::int32_t>(random() % static_cast<unsigned>(n)); };
  for (int trial = 0; trial < 200; ++trial) {
    const std::int32_t cols = 1 + below(30), rows = 1 + below(20);
    grid::SampleRuns runs;
    for (std::int32_t k = below(40); k > 0; --k) {
      const std::int32_t begin = below(cols);
      runs.add({below(rows), begin, begin + 1 + below(cols - begin)});
    }
    runs.merge();
    const grid::SampleSet set(runs.all(), rows);
    const grid::ColumnRuns columns(runs.all(), cols);
    for (std::int32_t x = 0; x < cols; ++x) {
      const std::int32_t start = below(rows);
      grid::ColumnWalk walk(columns.column(x), start);
      for (std::int32_t y = start; y < rows; ++y) {
        std::int32_t wanted = -1;
        for (std::int32_t v = 0; v < rows; ++v) {
          if (set.has({x, v}) && (wanted < 0 || std::abs(v - y) < wanted)) wanted = std::abs(v - y);
        }
        ASSERT_EQ(walk.steps_from(y), wanted) << trial << ": " << x << ", " << y;
      }
    }
  }
}

TEST(column_runs, are_as_many_as_the_outline_is_long) {
  grid::SampleRuns runs;
  for (std::int32_t y = 0; y < 1000; ++y) runs.add({y, 10, 90});
  runs.merge();
  const grid::ColumnRuns columns(runs.all(), 100);
  EXPECT_TRUE(columns.column(9).empty());
  ASSERT_EQ(columns.column(10).size(), 1u);
  EXPECT_EQ(columns.column(10).front().end, 1000);
  EXPECT_LT(columns.bytes(), 2000u);
}

}  // namespace
}  // namespace scarp
