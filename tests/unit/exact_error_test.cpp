#include "geom/exact_error.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "geom/plane.h"

namespace scarp {
namespace {

constexpr std::array<Point, 3> kCorners{Point{0, 0}, Point{3, 0}, Point{0, 3}};

TEST(exact_error, a_third_is_neither_more_nor_less_than_itself) {
  // The plane is x/3 at x = 1 of 0..3: exactly 1/3, which is not a double.
  const std::array<float, 3> heights{0, 1, 0};
  EXPECT_TRUE(geom::exceeds_exactly(kCorners, heights, {1, 0}, 0, std::nextafter(1.0 / 3, 0)));
  EXPECT_TRUE(geom::exceeds_exactly(kCorners, heights, {1, 0}, 0, 1.0 / 3)) << "the double 1/3 lies below one third";
  EXPECT_FALSE(geom::exceeds_exactly(kCorners, heights, {1, 0}, 0, std::nextafter(1.0 / 3, 1)));
}

TEST(exact_error, a_bound_that_is_met_exactly_is_not_exceeded) {
  const std::array<float, 3> heights{10, 13, 10};
  EXPECT_FALSE(geom::exceeds_exactly(kCorners, heights, {1, 1}, 10, 1.0));
  EXPECT_TRUE(geom::exceeds_exactly(kCorners, heights, {1, 1}, 10, std::nextafter(1.0, 0)));
  EXPECT_FALSE(geom::exceeds_exactly(kCorners, heights, {1, 1}, 11, 0.0));
}

TEST(exact_error, a_corner_has_no_error_at_any_magnitude) {
  const std::array<float, 3> heights{1e-38f, 3e38f, -7};
  EXPECT_FALSE(geom::exceeds_exactly(kCorners, heights, {3, 0}, 3e38f, 0));
}

TEST(exact_error, answers_true_where_128_bits_do_not_suffice) {
  const std::array<float, 3> heights{1e-38f, 3e38f, -7};
  EXPECT_TRUE(geom::exceeds_exactly(kCorners, heights, {1, 1}, 0, 1e30));
}

// The guard of a plane bounds its rounding: outside the guard, doubles and integers agree.
RC_GTEST_PROP(exact_error, agrees_with_doubles_outside_the_guard, ()) {
  const auto side = *rc::gen::element(5, 500, 40000);
  const auto point = [&] { return Point{*rc::gen::inRange(0, side), *rc::gen::inRange(0, side)}; };
  std::array<Point, 3> corners{point(), point(), point()};
  if (orient(corners[0], corners[1], corners[2]) < 0) std::swap(corners[1], corners[2]);
  RC_PRE(orient(corners[0], corners[1], corners[2]) > 0);
  const auto height = [&] { return static_cast<float>(*rc::gen::inRange(-900000, 900000)) / 128.0f; };
  const std::array<float, 3> heights{height(), height(), height()};
  // A lattice point of the triangle: a corner moved towards the middle.
  const Point p{(corners[0].x + corners[1].x + corners[2].x) / 3, (corners[0].y + corners[1].y + corners[2].y) / 3};
  RC_PRE(orient(corners[0], corners[1], p) >= 0 && orient(corners[1], corners[2], p) >= 0 &&
         orient(corners[2], corners[0], p) >= 0);
  const float sample = height();
  const geom::Plane plane = geom::Plane::through(corners, heights);
  const double error = std::abs(plane.height_at(p) - double{sample});
  RC_ASSERT(!geom::exceeds_exactly(corners, heights, p, sample, error + plane.guard));
  if (error > plane.guard)
    RC_ASSERT(geom::exceeds_exactly(corners, heights, p, sample, (error - plane.guard) * (1 - 0x1p-52)));
}

RC_GTEST_PROP(plane, does_not_depend_on_the_order_of_corners, ()) {
  const auto point = [&] { return Point{*rc::gen::inRange(0, 99), *rc::gen::inRange(0, 99)}; };
  std::array<Point, 3> c{point(), point(), point()};
  RC_PRE(orient(c[0], c[1], c[2]) != 0);
  const std::array<float, 3> h{1.25f, -7.5f, 1000.1f};
  const geom::Plane a = geom::Plane::through(c, h), b = geom::Plane::through({c[2], c[0], c[1]}, {h[2], h[0], h[1]});
  const Point p = point();
  RC_ASSERT(a.height_at(p) == b.height_at(p));
}

}  // namespace
}  // namespace scarp
