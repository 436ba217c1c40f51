// Tolerances around regions, against distances by brute force.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "scarp/tolerances.h"

namespace scarp {
namespace {

Line ring(std::vector<std::array<double, 3>> points, LineRole role, std::uint32_t polygon) {
  Line line;
  line.points = std::move(points);
  line.points.push_back(line.points.front());
  line.role = role;
  line.polygon = polygon;
  return line;
}

TEST(regions, have_their_tolerance_inside_and_not_in_holes) {
  const Region region{{ring({{2, 2, 0}, {12, 2, 0}, {12, 12, 0}, {2, 12, 0}}, LineRole::kOuter, 0),
                       ring({{5, 5, 0}, {9, 5, 0}, {9, 9, 0}, {5, 9, 0}}, LineRole::kHole, 0)},
                      0.25};
  RegionGrid grid{16, 16};
  grid.beyond = 4;
  const auto bounds = region_tolerances({&region, 1}, grid);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      const bool in_outer = x >= 2 && x <= 12 && y >= 2 && y <= 12, in_hole = x > 5 && x < 9 && y > 5 && y < 9;
      EXPECT_EQ(bounds[static_cast<std::size_t>(16 * y + x)], in_outer && !in_hole ? 0.25f : 4.0f) << x << ", " << y;
    }
  }
}

TEST(regions, grow_with_the_euclidean_distance_to_their_samples) {
  std::mt19937 random(5);
  const auto below = [&](int n) { return static_cast<double>(random() % static_cast<unsigned>(n)); };
  for (int trial = 0; trial < 20; ++trial) {
    Line line;
    for (int k = 0; k < 3; ++k) line.points.push_back({below(40) - 5, below(30) - 5, 0});
    const Region region{{line}, 1};
    RegionGrid grid{30, 20};
    grid.cell_x = 2;
    grid.cell_y = 3;
    grid.beyond = 9;
    std::vector<bool> found;
    const auto inside = region_tolerances({&region, 1}, grid, &found);
    grid.falloff = 16;
    const auto bounds = region_tolerances({&region, 1}, grid);
    for (int y = 0; y < 20; ++y) {
      for (int x = 0; x < 30; ++x) {
        double least = std::numeric_limits<double>::infinity();
        for (int v = 0; v < 20; ++v) {
          for (int u = 0; u < 30; ++u) {
            if (inside[static_cast<std::size_t>(30 * v + u)] == 1)
              least = std::min(least, std::hypot(2.0 * (u - x), 3.0 * (v - y)));
          }
        }
        const double wanted = found[0] ? 1 + 8 * std::min(1.0, least / 16) : 9;
        EXPECT_NEAR(double{bounds[static_cast<std::size_t>(30 * y + x)]}, wanted, 1e-5);
      }
    }
  }
}

TEST(regions, smaller_than_a_cell_have_a_sample_and_those_beside_the_raster_none) {
  const Region small{{ring({{3.1, 4.2, 0}, {3.2, 4.2, 0}, {3.2, 4.3, 0}}, LineRole::kOuter, 0)}, 0.5};
  const Region beside{{ring({{-30, 4, 0}, {-20, 4, 0}, {-20, 9, 0}}, LineRole::kOuter, 0)}, 0.5};
  const Region around{{ring({{-30, -30, 0}, {60, -30, 0}, {60, 60, 0}, {-30, 60, 0}}, LineRole::kOuter, 0)}, 0.75};
  const std::vector<Region> regions{small, beside, around};
  std::vector<bool> found;
  const auto bounds = region_tolerances(regions, {10, 8}, &found);
  EXPECT_EQ(found, (std::vector<bool>{true, false, true}));
  EXPECT_EQ(bounds[43], 0.5f);
  EXPECT_EQ(std::count(bounds.begin(), bounds.end(), 0.75f), 79);
}

TEST(regions, without_a_bound_beyond_leave_samples_without) {
  const Region region{{ring({{1, 1, 0}, {2, 1, 0}, {2, 2, 0}}, LineRole::kOuter, 0)}, 0.1};
  const auto bounds = region_tolerances({&region, 1}, {5, 5});
  EXPECT_TRUE(std::isinf(bounds[24]));
  EXPECT_LE(double{bounds[6]}, 0.1) << "rounded downwards";
}

TEST(regions, are_the_same_bits_in_windows_as_in_one_array) {
  std::mt19937 random(11);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const auto share = [&] { return static_cast<double>(random()) / 0x1p32; };
  for (int trial = 0; trial < 30; ++trial) {
    // Occasionally wider than a segment of a row.
    RegionGrid grid{trial % 5 == 0 ? 3100 : 2 + below(90), 2 + below(50)};
    grid.cell_x = 0.3 + 3 * share();
    grid.cell_y = 0.3 + 3 * share();
    grid.falloff = trial % 4 == 0 ? 0 : 40 * share();
    if (trial % 5 == 0) grid.falloff *= 20;
    if (grid.falloff > 0 || trial % 8 == 0) grid.beyond = 5 * share();
    std::vector<Region> regions(static_cast<std::size_t>(below(4)));
    for (Region& region : regions) {
      region.tolerance = 2 * share();
      for (int k = below(3); k >= 0; --k) {
        std::vector<std::array<double, 3>> points;
        for (int i = 2 + below(4); i > 0; --i)
          points.push_back({1.2 * grid.cols * (share() - 0.1), 1.2 * grid.rows * (share() - 0.1), 0});
        if (below(2) == 0) {
          region.lines.push_back(ring(std::move(points), LineRole::kOuter, static_cast<std::uint32_t>(k)));
        } else {
          region.lines.emplace_back().points = std::move(points);
        }
      }
    }
    std::vector<bool> found;
    const auto whole = region_tolerances(regions, grid, &found);
    const RegionBounds bounds = make_region_bounds(regions, grid);
    EXPECT_EQ(bounds.found, found);
    for (int look = 0; look < 20; ++look) {
      const int col = below(grid.cols), row = below(grid.rows);
      const int cols = 1 + below(grid.cols - col), rows = 1 + below(grid.rows - row), stride = cols + below(3);
      std::vector<float> window(static_cast<std::size_t>(stride) * static_cast<std::size_t>(rows), -1.0f);
      ASSERT_TRUE(bounds.source->read(col, row, cols, rows, window.data(), stride).has_value());
      for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < stride; ++x) {
          const float wanted = x < cols ? whole[static_cast<std::size_t>((row + y) * grid.cols + col + x)] : -1.0f;
          ASSERT_EQ(window[static_cast<std::size_t>(y * stride + x)], wanted) << trial << ": " << x << ", " << y;
        }
      }
    }
  }
}

}  // namespace
}  // namespace scarp
