// Every set of scan kernels gives the bits of the scalar set, for all tiles, triangles and hints.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "geom/exact_error.h"
#include "geom/scan.h"
#include "laws/scan_tiles.h"

namespace scarp::scan_kernels_laws_test {
namespace {

using testing::Field;
using testing::Relief;
using testing::ScanTile;

std::vector<geom::TilePoint> random_points(const geom::TileView& tile, std::mt19937& random, unsigned count) {
  std::vector<geom::TilePoint> points(count);
  for (geom::TilePoint& p : points)
    p = geom::tile_point(static_cast<std::int32_t>(random() % static_cast<unsigned>(tile.cols)),
                         static_cast<std::int32_t>(random() % static_cast<unsigned>(tile.rows)));
  return points;
}

/// Checks that all kernels agree with the twin about random triangles of the field.
void expect_agreement(const Field& field, std::uint32_t seed, int triangle_count, std::vector<double> thresholds) {
  std::mt19937 random(seed);
  const ScanTile tile(field);
  const auto triangles = random_triangles(tile, random, triangle_count);
  const std::vector<geom::TilePoint> hints = random_points(tile.view(), random, static_cast<unsigned>(random() % 12));
  const std::span<const geom::ScanKernels> all = geom::available_kernels();
  for (const double threshold : thresholds) {
    std::vector<geom::ScanHit> expected(triangles.size());
    all.back().scan(tile.view(), threshold, triangles, {}, expected.data());
    for (const geom::ScanKernels& kernels : all) {
      std::vector<geom::ScanHit> hits(triangles.size());
      kernels.scan(tile.view(), threshold, triangles, hints, hits.data());
      for (std::size_t i = 0; i < hits.size(); ++i) {
        ASSERT_TRUE(testing::is_same(hits[i], expected[i]))
            << kernels.name << " threshold " << threshold << " triangle (" << geom::point_of(triangles[i][0]).x << ' '
            << geom::point_of(triangles[i][0]).y << ") (" << geom::point_of(triangles[i][1]).x << ' '
            << geom::point_of(triangles[i][1]).y << ") (" << geom::point_of(triangles[i][2]).x << ' '
            << geom::point_of(triangles[i][2]).y << "): " << hits[i].error << " at " << geom::point_of(hits[i].at).x
            << ' ' << geom::point_of(hits[i].at).y << ", expected " << expected[i].error << " at "
            << geom::point_of(expected[i].at).x << ' ' << geom::point_of(expected[i].at).y;
      }
    }
  }
}

RC_GTEST_PROP(scan_kernels_laws, agree_on_small_tiles, ()) {
  const auto cols = *rc::gen::inRange(2, 90), rows = *rc::gen::inRange(2, 90);
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const Relief relief = testing::kReliefs[*rc::gen::inRange(0, 5)];
  const double nodata = *rc::gen::element(0.0, 0.02, 0.3);
  expect_agreement(testing::random_field(seed, cols, rows, relief, nodata), seed, 100, {0, 0.5, 2, 30});
}

RC_GTEST_PROP(scan_kernels_laws, agree_on_large_tiles, ()) {
  const auto cols = *rc::gen::inRange(200, 700), rows = *rc::gen::inRange(200, 700);
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const Relief relief = testing::kReliefs[*rc::gen::inRange(0, 5)];
  const double nodata = *rc::gen::element(0.0, 0.02);
  expect_agreement(testing::random_field(seed, cols, rows, relief, nodata), seed, 12, {0, 1.5, 40});
}

TEST(scan_kernels_laws, agree_on_the_largest_tile) {
  Field field = testing::random_field(5, geom::kMaxTileSide, geom::kMaxTileSide, Relief::kRidges, 0.0001);
  for (std::size_t i = 0; i < field.samples.size(); ++i) field.samples[i] += static_cast<float>(i % 1999) * 0.05f;
  expect_agreement(field, 5, 12, {3, 80, 1000});
}

/// Heights of extreme magnitudes, many of them equal.
Field wild_field(std::uint32_t seed, std::int32_t cols, std::int32_t rows) {
  std::mt19937 random(seed);
  const int scale = static_cast<int>(random() % 160) - 80, spread = 1 + static_cast<int>(random() % 40);
  Field field{cols, rows, std::vector<float>(static_cast<std::size_t>(cols) * static_cast<std::size_t>(rows))};
  const float offset = random() % 2 == 0 ? 0 : std::ldexp(1.0f, scale);
  for (float& z : field.samples)
    z = offset + std::ldexp(static_cast<float>(random()) / 4294967296.0f - 0.5f,
                            std::min(95, scale - static_cast<int>(random() % static_cast<unsigned>(spread))));
  return field;
}

RC_GTEST_PROP(scan_kernels_laws, agree_on_wild_heights, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const Field field = wild_field(seed, *rc::gen::inRange(2, 200), *rc::gen::inRange(2, 200));
  const double threshold = std::abs(double{field.samples[0]}) / 3;
  expect_agreement(field, seed, 30, {0, threshold});
}

// The error as a real number: heights · area is a sum of products that long double represents exactly for heights of
// few bits, otherwise up to 2⁻⁶⁴. The guard includes this error.
RC_GTEST_PROP(scan_kernels_laws, guard_bounds_the_rounding, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  std::mt19937 random(seed);
  const ScanTile tile(wild_field(seed, *rc::gen::inRange(2, 120), *rc::gen::inRange(2, 120)));
  for (const auto& corners : random_triangles(tile, random, 20)) {
    const std::array<Point, 3> p{geom::point_of(corners[0]), geom::point_of(corners[1]), geom::point_of(corners[2])};
    const auto area = static_cast<long double>(orient(p[0], p[1], p[2]));
    const auto exact_error = [&](Point s) {
      const long double za = tile.view().at(corners[0]);
      const long double zb = tile.view().at(corners[1]) - za, zc = tile.view().at(corners[2]) - za;
      const auto weight_b = static_cast<long double>(orient(p[2], p[0], s));
      const auto weight_c = static_cast<long double>(orient(p[0], p[1], s));
      const long double sample = tile.view().at(geom::tile_point(s.x, s.y)) - za;
      return std::abs((zb * weight_b + zc * weight_c) / area - sample);
    };
    const double threshold =
        static_cast<double>(exact_error({(p[0].x + p[1].x + p[2].x) / 3, (p[0].y + p[1].y + p[2].y) / 3}));
    const geom::ScanPlane plane = geom::ScanPlane::through(tile.view(), corners, threshold);
    const double guard = plane.guard;
    geom::scan_rows(p, [&](std::int32_t y, std::int32_t first, std::int32_t last) {
      for (std::int32_t x = first; x <= last; ++x) {
        const long double exact = exact_error({x, y});
        const float along = plane.slope_x * static_cast<float>(x - p[0].x);
        const float across = plane.slope_y * static_cast<float>(y - p[0].y);
        const float computed = std::abs(along + across - (tile.view().at(geom::tile_point(x, y)) - plane.height));
        if (exact <= 2 * static_cast<long double>(threshold)) RC_ASSERT(std::abs(exact - computed) <= guard);
        if (exact > threshold && guard <= threshold) RC_ASSERT(computed > geom::scan_floor(threshold, plane.guard));
        if (computed > threshold + guard) RC_ASSERT(exact > threshold);
      }
    });
  }
}

RC_GTEST_PROP(scan_kernels_laws, blocks_hold_their_smallest_and_largest, ()) {
  const auto cols = *rc::gen::inRange(2, 90), rows = *rc::gen::inRange(2, 90);
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  ScanTile tile(testing::random_field(seed, cols, rows, testing::kReliefs[*rc::gen::inRange(0, 5)],
                                      *rc::gen::element(0.0, 0.1, 3.0)));
  const std::vector<float> low = tile.low(), high = tile.high();
  const std::uint64_t nodata = tile.nodata();
  const float most = tile.fill(geom::available_kernels().back());
  for (const geom::ScanKernels& kernels : geom::available_kernels()) {
    RC_ASSERT(tile.fill(kernels) == most);
    RC_ASSERT(tile.low() == low);
    RC_ASSERT(tile.high() == high);
    RC_ASSERT(tile.nodata() == nodata);
  }
}

RC_GTEST_PROP(scan_kernels_laws, rows_agree_to_the_bit, ()) {
  const auto count = *rc::gen::inRange(0, 70);
  const double offset = *rc::gen::inRange(-5000, 5000) / *rc::gen::element(1.0, 256.0);
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  const bool ties = random() % 2 == 0;
  std::vector<float> samples(static_cast<std::size_t>(count));
  for (float& z : samples) {
    z = ties ? static_cast<float>(random() % 3) : static_cast<float>(random()) * 0x1p-30f;
    if (random() % 9 == 0) z = std::numeric_limits<float>::quiet_NaN();
  }
  const double base = ties ? 1 : static_cast<double>(random()) * 0x1p-31;
  const double slope = ties ? 0 : static_cast<double>(random()) * 0x1p-40;
  const double start = *rc::gen::element(-1.0, 0.0, 1.0);
  double expected = start;
  std::int32_t expected_at = -7;
  for (std::int32_t x = 0; x < count; ++x) {
    const double error = std::abs(base + slope * (offset + x) - double{samples[static_cast<std::size_t>(x)]});
    if (error > expected) {
      expected = error;
      expected_at = x;
    }
  }
  for (const geom::ScanKernels& kernels : geom::available_kernels()) {
    double worst = start;
    std::int32_t at = -7;
    RC_ASSERT(kernels.scan_row(samples.data(), count, base, slope, offset, worst, at) == (expected_at >= 0));
    RC_ASSERT(worst == expected);
    RC_ASSERT(at == expected_at);
  }
}

}  // namespace
}  // namespace scarp::scan_kernels_laws_test
