// The engine against its textbook twins, and the laws of its meshes.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>

#include "geom/exact_error.h"
#include "laws/fields.h"
#include "laws/mesh_laws.h"
#include "metric/height_metric.h"
#include "refine/domain.h"
#include "refine/refinement.h"
#include "refine/textbook.h"
#include "scarp/simplify.h"

namespace scarp::refinement_laws_test {
namespace {

using testing::Field;
using testing::Relief;

std::vector<Point> insert_by_queue(const grid::Raster& raster, tin::Triangulation& tin, double threshold,
                                   std::size_t most) {
  const std::size_t seeds = tin.vertex_count();
  const metric::HeightMetric metric(raster, threshold);
  refine::Refinement refinement(metric, tin);
  while (!refinement.done() && tin.vertex_count() < seeds + most) refinement.insert_worst();
  std::vector<Point> points;
  for (std::size_t v = seeds; v < tin.vertex_count(); ++v) points.push_back(tin.point(static_cast<tin::Vertex>(v)));
  return points;
}

struct Case {
  Field field;
  double threshold;
  double outline_tolerance;
};

Case random_case(std::int32_t largest) {
  const auto cols = *rc::gen::inRange(2, largest), rows = *rc::gen::inRange(2, largest);
  const auto relief =
      *rc::gen::elementOf(std::vector<Relief>(std::begin(testing::kReliefs), std::end(testing::kReliefs)));
  const auto nodata = *rc::gen::element(0.0, 0.0, 0.05, 0.3, 0.7);
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  return {testing::random_field(seed, cols, rows, relief, nodata), *rc::gen::element(0.0, 0.25, 1.0, 2.0, 7.3),
          *rc::gen::element(0.0, 0.0, 1.0, 2.5)};
}

std::string name(Point p) { return fmt::format("({}, {})", p.x, p.y); }

RC_GTEST_PROP(oracle, algorithms_one_two_and_three_insert_the_same_points, ()) {
  const Case c = random_case(14);
  const auto domain = refine::build_domain(c.field.raster(), c.outline_tolerance, grid_frame(c.field.rows));
  RC_PRE(domain.has_value());
  auto one = refine::build_domain(c.field.raster(), c.outline_tolerance, grid_frame(c.field.rows));
  auto two = refine::build_domain(c.field.raster(), c.outline_tolerance, grid_frame(c.field.rows));
  auto three = refine::build_domain(c.field.raster(), c.outline_tolerance, grid_frame(c.field.rows));
  const auto first = refine::insert_by_brute_force(c.field.raster(), one->tin, c.threshold, 40);
  const auto second = refine::insert_by_local_search(c.field.raster(), two->tin, c.threshold, 40);
  const auto third = insert_by_queue(c.field.raster(), three->tin, c.threshold, 40);
  RC_ASSERT(first.size() == second.size());
  RC_ASSERT(first.size() == third.size());
  for (std::size_t k = 0; k < first.size(); ++k) {
    if (!(first[k] == second[k]) || !(first[k] == third[k]))
      RC_FAIL(fmt::format("insertion {}: I {}, II {}, III {}", k, name(first[k]), name(second[k]), name(third[k])));
  }
}

// The public interface in the greedy order: the textbook's vertices on any number of threads.
RC_GTEST_PROP(oracle, simplify_in_the_greedy_order_takes_the_textbooks_vertices, ()) {
  const Case c = random_case(18);
  const grid::Raster raster = c.field.raster();
  auto domain = refine::build_domain(raster, c.outline_tolerance, grid_frame(c.field.rows));
  RC_PRE(domain.has_value());
  refine::insert_by_local_search(raster, domain->tin, c.threshold, 1u << 20);
  SimplifyOptions options{.goals = {.max_error = c.threshold}, .domain = {.outline_tolerance = c.outline_tolerance}};
  options.quality.order = Order::kGreedy;
  options.run.threads = *rc::gen::inRange(1, 4);
  const auto result = simplify(c.field.view(), options);
  RC_ASSERT(result.has_value());
  RC_ASSERT(result->order == Order::kGreedy);
  std::vector<std::pair<int, int>> expected, found;
  std::set<tin::Vertex> used;
  for (tin::HalfEdge h = 0; h < 3 * domain->tin.triangle_count(); ++h) {
    if (!domain->tin.is_outside(h / 3)) used.insert(domain->tin.origin(h));
  }
  for (const tin::Vertex v : used) expected.push_back({domain->tin.point(v).x, domain->tin.point(v).y});
  for (std::size_t v = 0; v < result->mesh.vertex_count(); ++v) {
    const auto p = result->mesh.vertex(v);
    found.push_back({static_cast<int>(p[0]), c.field.rows - 1 - static_cast<int>(p[1])});
  }
  std::sort(expected.begin(), expected.end());
  std::sort(found.begin(), found.end());
  RC_ASSERT(found == expected);
}

// The guarantee in integers without scan conversion: every valid sample in every triangle that contains it.
RC_GTEST_PROP(refinement, keeps_the_bound_exactly_and_covers_every_cell, ()) {
  const Case c = random_case(22);
  const grid::Raster raster = c.field.raster();
  auto domain = refine::build_domain(raster, c.outline_tolerance, grid_frame(c.field.rows));
  RC_PRE(domain.has_value());
  tin::Triangulation& tin = domain->tin;
  insert_by_queue(raster, tin, c.threshold, 1u << 20);
  RC_ASSERT(testing::verify_triangulation(tin, raster.cols, raster.rows) == "");
  std::int64_t domain_area2 = 0, cells_area2 = 0;
  std::vector<int> covered(c.field.samples.size(), 0);
  for (tin::Triangle t = 0; t < tin.triangle_count(); ++t) {
    if (tin.is_outside(t)) continue;
    const auto corners = tin.corners(t);
    domain_area2 += orient(corners[0], corners[1], corners[2]);
    std::array<float, 3> heights;
    for (int k = 0; k < 3; ++k) {
      RC_ASSERT(raster.is_valid(corners[k]));
      heights[k] = raster.at(corners[k]);
    }
    for (std::int32_t y = 0; y < raster.rows; ++y) {
      for (std::int32_t x = 0; x < raster.cols; ++x) {
        const Point p{x, y};
        const bool inside = orient(corners[0], corners[1], p) >= 0 && orient(corners[1], corners[2], p) >= 0 &&
                            orient(corners[2], corners[0], p) >= 0;
        if (!inside || !raster.is_valid(p)) continue;
        covered[static_cast<std::size_t>(y) * static_cast<std::size_t>(raster.cols) + static_cast<std::size_t>(x)] = 1;
        RC_ASSERT(!geom::exceeds_exactly(corners, heights, p, raster.at(p), c.threshold));
      }
    }
  }
  for (std::int32_t y = 0; y + 1 < raster.rows; ++y) {
    for (std::int32_t x = 0; x + 1 < raster.cols; ++x) {
      const int valid = std::popcount(grid::valid_corners(raster, x, y));
      if (valid < 3) continue;
      cells_area2 += valid == 4 ? 2 : 1;
      for (Point p : {Point{x, y}, Point{x + 1, y}, Point{x + 1, y + 1}, Point{x, y + 1}}) {
        if (raster.is_valid(p))
          RC_ASSERT(covered[static_cast<std::size_t>(p.y) * static_cast<std::size_t>(raster.cols) +
                            static_cast<std::size_t>(p.x)]);
      }
    }
  }
  if (c.outline_tolerance == 0) RC_ASSERT(domain_area2 == cells_area2);
  RC_ASSERT(domain_area2 >= cells_area2);
}

// Refinement of cliffs ends at any threshold, and threshold 0 inserts exactly the samples that planes cannot explain.
TEST(refinement, a_plane_needs_no_vertex_but_the_corners) {
  Field field{40, 30, std::vector<float>(1200)};
  for (std::int32_t y = 0; y < 30; ++y)
    for (std::int32_t x = 0; x < 40; ++x)
      field.samples[static_cast<std::size_t>(40 * y + x)] = static_cast<float>(3 * x - 7 * y) / 4.0f;
  auto domain = refine::build_domain(field.raster(), 0, grid_frame(30));
  EXPECT_EQ(insert_by_queue(field.raster(), domain->tin, 0, 1000).size(), 0u);
}

TEST(refinement, next_gain_says_how_many_triangles_will_come) {
  const Field field = testing::random_field(7, 25, 19, Relief::kReal, 0.1);
  auto domain = refine::build_domain(field.raster(), 0, grid_frame(19));
  const metric::HeightMetric metric(field.raster(), 0);
  refine::Refinement refinement(metric, domain->tin);
  while (!refinement.done()) {
    const auto expected = refinement.triangle_count() + refinement.next_gain();
    refinement.insert_worst();
    ASSERT_EQ(refinement.triangle_count(), expected);
    std::uint64_t inside = 0;
    for (tin::Triangle t = 0; t < domain->tin.triangle_count(); ++t) inside += !domain->tin.is_outside(t);
    ASSERT_EQ(inside, expected);
  }
}

}  // namespace
}  // namespace scarp::refinement_laws_test
