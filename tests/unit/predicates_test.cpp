#include "geom/predicates.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scarp {
namespace {

Point random_point(std::int32_t side) { return {*rc::gen::inRange(0, side), *rc::gen::inRange(0, side)}; }

RC_GTEST_PROP(predicates, orient_is_cyclic_and_antisymmetric, ()) {
  const auto side = *rc::gen::element(10, 30000, 50000, kMaxCoordinate);
  const Point a = random_point(side), b = random_point(side), c = random_point(side);
  RC_ASSERT(orient(a, b, c) == orient(b, c, a));
  RC_ASSERT(orient(a, b, c) == -orient(b, a, c));
}

// 64-bit and 128-bit arithmetic agree where they are exact.
RC_GTEST_PROP(predicates, in_circle_64_agrees_with_128, ()) {
  const auto side = *rc::gen::element(4, 100, geom::kMaxInCircle64 + 1);
  const Point a = random_point(side), b = random_point(side), c = random_point(side), d = random_point(side);
  RC_ASSERT(geom::in_circle_fits_64(a, b, c, d));
  RC_ASSERT(sign_of(geom::detail::in_circle_determinant<std::int64_t>(a, b, c, d)) ==
            sign_of(geom::detail::in_circle_determinant<Int128>(a, b, c, d)));
}

RC_GTEST_PROP(predicates, in_circle_is_antisymmetric_at_any_extent, ()) {
  const auto side = *rc::gen::element(5, 29000, 46400, 1000000, kMaxCoordinate);
  const Point a = random_point(side), b = random_point(side), c = random_point(side), d = random_point(side);
  RC_ASSERT(geom::in_circle(a, b, c, d) == geom::in_circle(b, c, a, d));
  RC_ASSERT(geom::in_circle(a, b, c, d) == -geom::in_circle(b, a, c, d));
  RC_ASSERT(geom::in_circle(a, b, c, d) == -geom::in_circle(a, b, d, c));
}

TEST(predicates, in_circle_of_a_cocircular_square_is_zero_at_every_size) {
  for (const std::int32_t n : {2, 29609, 29610, 46341, 65536, kMaxCoordinate}) {
    EXPECT_EQ(geom::in_circle({0, 0}, {n, 0}, {n, n}, {0, n}), 0) << n;
    EXPECT_LT(geom::in_circle({0, 0}, {n - 1, 0}, {n - 1, n - 1}, {0, n}), 0) << n;
  }
}

TEST(predicates, in_circle_is_exact_by_one_sample_where_64_bits_would_overflow) {
  // A circle through three corners of a huge square, with the fourth corner moved by one sample.
  for (const std::int32_t n : {29700, 46400, 60000, 1000000, kMaxCoordinate}) {
    EXPECT_EQ(geom::in_circle_fits_64({0, 0}, {n, 0}, {n, n}, {0, n - 1}), false);
    EXPECT_GT(geom::in_circle({0, 0}, {n, 0}, {n, n}, {1, n - 1}), 0) << n;
    EXPECT_GT(geom::in_circle({0, 0}, {n, 0}, {n, n}, {0, n - 1}), 0) << n;
    EXPECT_LT(geom::in_circle({0, 1}, {n, 0}, {n - 1, n - 1}, {0, n}), 0) << n;
  }
}

TEST(predicates, the_64_bit_path_answers_up_to_29609) {
  const std::int32_t n = geom::kMaxInCircle64;
  EXPECT_TRUE(geom::in_circle_fits_64({0, 0}, {n, 0}, {n, n}, {0, n}));
  EXPECT_FALSE(geom::in_circle_fits_64({0, 0}, {n + 1, 0}, {n, n}, {0, n}));
  // The worst case of the bound, compared with 128-bit arithmetic.
  const Point worst[4] = {{0, 0}, {n, 0}, {0, n}, {n, n}};
  for (const Point a : worst)
    for (const Point b : worst)
      for (const Point c : worst)
        for (const Point d : worst)
          EXPECT_EQ(sign_of(geom::detail::in_circle_determinant<std::int64_t>(a, b, c, d)),
                    sign_of(geom::detail::in_circle_determinant<Int128>(a, b, c, d)));
}

}  // namespace
}  // namespace scarp
