#include "tin/triangulation.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "laws/mesh_laws.h"

namespace scarp {
namespace {

using testing::verify_triangulation;

tin::Vertex insert_point(tin::Triangulation& tin, Point p) { return tin.insert(p, tin.locate(p, tin.last_touched())); }

TEST(triangulation, starts_with_two_triangles_from_south_west_to_north_east) {
  const tin::Triangulation tin(7, 5);
  EXPECT_EQ(tin.triangle_count(), 2u);
  EXPECT_NE(tin.find_edge(1, 3), tin::kNone) << "from (6, 0) to (0, 4)";
  EXPECT_EQ(verify_triangulation(tin, 7, 5), "");
}

RC_GTEST_PROP(triangulation, stays_delaunay_under_any_insertions, ()) {
  const auto side = *rc::gen::element(4, 12, 30000, 50000, 1000000);
  tin::Triangulation tin(side, side);
  const auto points = *rc::gen::container<std::vector<std::pair<int, int>>>(
      rc::gen::pair(rc::gen::inRange(0, side), rc::gen::inRange(0, side)));
  for (auto [x, y] : points) insert_point(tin, {x, y});
  RC_ASSERT(verify_triangulation(tin, side, side) == "");
}

RC_GTEST_PROP(triangulation, finds_a_vertex_that_is_there, ()) {
  tin::Triangulation tin(9, 9);
  const Point p{*rc::gen::inRange(0, 9), *rc::gen::inRange(0, 9)};
  const tin::Vertex v = insert_point(tin, p);
  insert_point(tin, {4, 4});
  RC_ASSERT(insert_point(tin, p) == v);
}

TEST(triangulation, holds_every_sample_of_a_grid) {
  tin::Triangulation tin(17, 13);
  for (std::int32_t y = 0; y < 13; ++y)
    for (std::int32_t x = 0; x < 17; ++x) insert_point(tin, {x, y});
  EXPECT_EQ(tin.vertex_count(), 17u * 13);
  EXPECT_EQ(tin.triangle_count(), 2u * 16 * 12);
  EXPECT_EQ(verify_triangulation(tin, 17, 13), "");
}

TEST(triangulation, uses_128_bits_beyond_29609_and_stays_delaunay) {
  const std::int32_t side = 46400;
  tin::Triangulation tin(side, side);
  // Nearly cocircular points at a huge scale: 64-bit determinants would overflow.
  for (std::int32_t k = 0; k < 60; ++k) {
    insert_point(tin, {k * 700 + k % 3, 5 + k % 2});
    insert_point(tin, {side - 2 - k % 5, k * 761 + k % 4});
    insert_point(tin, {k * 773 + k % 2, side - 3 - k % 3});
  }
  EXPECT_EQ(verify_triangulation(tin, side, side), "");
}

RC_GTEST_PROP(triangulation, constrained_segments_become_chains_of_edges, ()) {
  const auto side = *rc::gen::element(6, 25, 40000);
  tin::Triangulation tin(side, side);
  const auto point = [&] { return Point{*rc::gen::inRange(0, side), *rc::gen::inRange(0, side)}; };
  for (int k = *rc::gen::inRange(0, 40); k > 0; --k) insert_point(tin, point());
  std::vector<std::pair<tin::Vertex, tin::Vertex>> held;
  for (int k = 0; k < 6; ++k) {
    const tin::Vertex a = insert_point(tin, point()), b = insert_point(tin, point());
    if (a != b && tin.constrain(a, b)) held.emplace_back(a, b);
  }
  RC_ASSERT(!held.empty() || tin.vertex_count() < 6);
  // Later insertions respect constraints, and split constraints on which they lie.
  for (int k = 0; k < 20; ++k) insert_point(tin, point());
  RC_ASSERT(verify_triangulation(tin, side, side) == "");
  for (auto [a, b] : held) RC_ASSERT(testing::is_constrained_chain(tin, a, b));
}

TEST(triangulation, refuses_a_segment_across_a_constraint_and_changes_nothing) {
  tin::Triangulation tin(11, 11);
  const tin::Vertex a = insert_point(tin, {2, 2}), b = insert_point(tin, {8, 8}), c = insert_point(tin, {8, 2}),
                    d = insert_point(tin, {2, 8});
  ASSERT_TRUE(tin.constrain(a, b));
  EXPECT_FALSE(tin.constrain(c, d));
  EXPECT_EQ(verify_triangulation(tin, 11, 11), "");
  EXPECT_TRUE(testing::is_constrained_chain(tin, a, b));
}

TEST(triangulation, a_segment_through_a_vertex_is_split_there) {
  tin::Triangulation tin(11, 11);
  const tin::Vertex a = insert_point(tin, {1, 1}), b = insert_point(tin, {9, 9}), m = insert_point(tin, {5, 5});
  ASSERT_TRUE(tin.constrain(a, b));
  EXPECT_TRUE(testing::is_constrained_chain(tin, a, m));
  EXPECT_TRUE(testing::is_constrained_chain(tin, m, b));
}

}  // namespace
}  // namespace scarp
