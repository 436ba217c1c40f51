#include "geom/scan.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numeric>
#include <set>

namespace scarp {
namespace {

using Lattice = std::set<std::pair<std::int32_t, std::int32_t>>;

Lattice scanned(const std::array<Point, 3>& corners) {
  Lattice points;
  std::int32_t last_row = -1;
  geom::scan_rows(corners, [&](std::int32_t y, std::int32_t first, std::int32_t last) {
    EXPECT_GT(y, last_row);
    last_row = y;
    for (std::int32_t x = first; x <= last; ++x) EXPECT_TRUE(points.emplace(x, y).second);
  });
  return points;
}

RC_GTEST_PROP(scan, visits_exactly_the_closed_triangle, ()) {
  const auto side = *rc::gen::element(3, 8, 40);
  const auto point = [&] { return Point{*rc::gen::inRange(0, side), *rc::gen::inRange(0, side)}; };
  std::array<Point, 3> corners{point(), point(), point()};
  if (orient(corners[0], corners[1], corners[2]) < 0) std::swap(corners[1], corners[2]);
  RC_PRE(orient(corners[0], corners[1], corners[2]) > 0);
  Lattice expected;
  for (std::int32_t y = 0; y < side; ++y) {
    for (std::int32_t x = 0; x < side; ++x) {
      const Point p{x, y};
      if (orient(corners[0], corners[1], p) >= 0 && orient(corners[1], corners[2], p) >= 0 &&
          orient(corners[2], corners[0], p) >= 0)
        expected.emplace(x, y);
    }
  }
  RC_ASSERT(scanned(corners) == expected);
}

RC_GTEST_PROP(scan, visits_exactly_a_sliver, ()) {
  const std::int32_t width = *rc::gen::element(1, 2, 5), height = *rc::gen::element(40, 300);
  const auto point = [&] { return Point{*rc::gen::inRange(0, width + 1), *rc::gen::inRange(0, height)}; };
  std::array<Point, 3> corners{point(), point(), point()};
  if (orient(corners[0], corners[1], corners[2]) < 0) std::swap(corners[1], corners[2]);
  if (orient(corners[0], corners[1], corners[2]) == 0) corners = {Point{0, 0}, Point{width, height - 2}, Point{0, 1}};
  Lattice expected;
  for (std::int32_t y = 0; y < height; ++y) {
    for (std::int32_t x = 0; x <= width; ++x) {
      const Point p{x, y};
      if (orient(corners[0], corners[1], p) >= 0 && orient(corners[1], corners[2], p) >= 0 &&
          orient(corners[2], corners[0], p) >= 0)
        expected.emplace(x, y);
    }
  }
  RC_ASSERT(scanned(corners) == expected);
}

// A tall raster with few columns is full of slivers; scanning a thousand of them row by row needs minutes.
TEST(scan, a_sliver_costs_its_samples_not_its_rows) {
  constexpr std::int32_t kFar = 1'000'000'000;
  std::int64_t samples = 0;
  for (std::int32_t k = 0; k < 1000; ++k) {
    geom::scan_rows({Point{0, k}, Point{0, k + 2}, Point{1, kFar + k}},
                    [&](std::int32_t, std::int32_t first, std::int32_t last) { samples += last - first + 1; });
    geom::scan_rows({Point{3, k}, Point{0, kFar + k}, Point{3, k + 1}},
                    [&](std::int32_t, std::int32_t first, std::int32_t last) { samples += last - first + 1; });
  }
  EXPECT_GE(samples, 1000 * (4 + 3));
  EXPECT_LE(samples, 1000 * (4 + 5));
}

// Pick's theorem: 2·area = 2·inside + border − 2. This detects a wrong count at sizes for which an oracle is too slow.
RC_GTEST_PROP(scan, counts_what_pick_says_at_any_size, ()) {
  const std::int32_t side = 60000;
  const auto point = [&] { return Point{*rc::gen::inRange(0, side), *rc::gen::inRange(0, side)}; };
  std::array<Point, 3> corners{point(), point(), point()};
  const std::int64_t area2 = std::abs(orient(corners[0], corners[1], corners[2]));
  RC_PRE(area2 != 0);
  std::int64_t count = 0, border = 0;
  geom::scan_rows(corners, [&](std::int32_t, std::int32_t first, std::int32_t last) { count += last - first + 1; });
  for (int k = 0; k < 3; ++k)
    border += std::gcd(std::int64_t{corners[k].x} - corners[(k + 1) % 3].x,
                       std::int64_t{corners[k].y} - corners[(k + 1) % 3].y);
  RC_ASSERT(2 * count == area2 + border + 2);
}

}  // namespace
}  // namespace scarp
