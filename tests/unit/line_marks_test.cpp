// Samples in polygons, against a count of edges next to each.
#include "grid/line_marks.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>

namespace scarp {
namespace {

TEST(line_runs, of_a_ring_that_crosses_rows_a_million_times_are_even_odd) {
  constexpr int kCols = 60, kRows = 90;
  std::mt19937 random(4);
  Line ring;
  ring.role = LineRole::kOuter;
  for (int k = 0; k < 13000; ++k)
    ring.points.push_back({kCols * (static_cast<double>(random()) / 0x1p32), k % 2 == 0 ? 1.5 : kRows - 2.5, 0});
  ring.points.push_back(ring.points.front());
  grid::LineRuns runs({0, 1, 0, 0, 0, 1}, kCols, kRows);
  runs.add_polygons({&ring, 1});
  const grid::SampleSet inside(runs.runs(), kRows);
  for (const std::int32_t row : {0, 1, 2, 30, 44, 45, 46, 87, 88, 89}) {
    for (std::int32_t col = 0; col < kCols; col += 7) {
      bool is_inside = false;
      for (std::size_t k = 0; k + 1 < ring.points.size(); ++k) {
        const auto &p = ring.points[k], &q = ring.points[k + 1];
        if ((p[1] < row) == (q[1] < row)) continue;
        is_inside ^= p[0] + (row - p[1]) / (q[1] - p[1]) * (q[0] - p[0]) < col;
      }
      EXPECT_EQ(inside.has({col, row}), is_inside) << col << ", " << row;
    }
  }
}

}  // namespace
}  // namespace scarp
