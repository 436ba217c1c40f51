// Laws of cutlines: exactly the points in the polygons with data are covered, once, and satisfy the bound.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "geom/arrangement.h"
#include "geom/polygon_cover.h"
#include "laws/any_cutlines.h"
#include "laws/any_field.h"
#include "scarp/features.h"
#include "scarp/lines.h"
#include "scarp/simplify.h"

namespace scarp::cutline_laws_test {
namespace {

using testing::any_field;
using testing::distance_to_rings;
using testing::doubled_area;
using testing::Draughtsman;
using testing::Field;
using testing::find_wrong_cover;
using testing::heights_at;
using testing::is_in_polygons;
using testing::triangles_of;

SimplifyOptions any_options(const Cutline& cutline) {
  SimplifyOptions options;
  options.goals.max_error = *rc::gen::element(0.0, 0.5, 1.0, 3.0, 20.0);
  options.quality.effort = *rc::gen::element(Effort::kFast, Effort::kNormal, Effort::kHigh);
  options.quality.order = *rc::gen::element(Order::kAuto, Order::kGreedy);
  options.output.float32_positions = *rc::gen::arbitrary<bool>();
  options.features.cutline = cutline;
  return options;
}

RC_GTEST_PROP(cutlines, cover_what_lies_in_the_polygons_and_has_data_within_the_bound_and_nothing_else, ()) {
  const Field field = any_field(24);
  Draughtsman draughtsman(*rc::gen::arbitrary<std::uint32_t>());
  const SimplifyOptions options = any_options(draughtsman.rings(field));
  const auto result = simplify(field.view(), options);
  if (!result) RC_LOG() << result.error().message;
  constexpr double kDoubt = 1.0 / 64;
  const auto triangles =
      result ? triangles_of(result->mesh, field.rows) : std::vector<std::array<testing::Corner, 3>>();
  RC_ASSERT(find_wrong_cover(field, options.features.cutline, triangles, draughtsman) == "");
  if (!result) RC_ASSERT(result.error().kind == ErrorKind::kInput);
  for (std::int32_t row = 0; result && row < field.rows; ++row) {
    for (std::int32_t col = 0; col < field.cols; ++col) {
      const double sample{field.raster().at({col, row})};
      if (std::isnan(sample) || distance_to_rings(options.features.cutline, col, row) < kDoubt) continue;
      const auto heights = heights_at(triangles, col, row);
      RC_ASSERT(heights.empty() || is_in_polygons(options.features.cutline, col, row));
      for (const double height : heights) RC_ASSERT(std::abs(height - sample) <= *options.goals.max_error + 1e-6);
    }
  }
}

/// The judge's measurement, which must find a sound mesh within the bound.
Measurement judged(const Field& field, const SimplifyOptions& options, const Simplified& result) {
  MeasureOptions judge;
  judge.cutline = &options.features.cutline;
  const Measurement m = *measure(field.view(), result.mesh, judge);
  RC_ASSERT(m.max_error <= *options.goals.max_error + 1e-9);
  RC_ASSERT(m.uncovered == 0u);
  RC_ASSERT(m.nodata_cells_covered == 0u);
  RC_ASSERT(m.is_sound());
  return m;
}

RC_GTEST_PROP(cutlines, keep_the_bound_in_the_eyes_of_the_judge, ()) {
  const Field field = any_field(40);
  Draughtsman draughtsman(*rc::gen::arbitrary<std::uint32_t>());
  SimplifyOptions options = any_options(draughtsman.rings(field));
  const auto result = simplify(field.view(), options);
  if (!result) {
    RC_LOG() << result.error().message;
    RC_ASSERT(result.error().kind == ErrorKind::kInput);
    return;
  }
  const Measurement m = judged(field, options, *result);
  RC_ASSERT(m.samples + m.stray + m.cut_off == m.heights.valid);
  RC_ASSERT(result->measurement.samples == m.samples);
  options.run.threads = 3;
  const auto again = simplify(field.view(), options);
  RC_ASSERT(again->mesh.positions == result->mesh.positions && again->mesh.triangles == result->mesh.triangles);
}

RC_GTEST_PROP(cutlines, hold_shapes_or_the_lines_of_walls_within_the_bound, ()) {
  const Field field = any_field(24);
  Draughtsman draughtsman(*rc::gen::arbitrary<std::uint32_t>());
  SimplifyOptions options = any_options(draughtsman.rings(field));
  options.goals.max_error = *rc::gen::element(0.5, 1.0, 3.0, 20.0);
  const bool has_walls = *rc::gen::arbitrary<bool>();
  if (has_walls) {
    options.quality.order = Order::kAuto;
    const auto cliffs =
        detect_cliffs(field.view(), {.height = 2 * *options.goals.max_error, .max_error = *options.goals.max_error});
    RC_ASSERT(cliffs.has_value());
    options.features.breaklines.lines = cliffs->lines;
  } else {
    options.quality.shape.min_angle = *rc::gen::element(0.0, 15.0, 28.0);
    options.quality.shape.max_edge = *rc::gen::element(1.5, 6.0);
  }
  const auto result = simplify(field.view(), options);
  if (!result) {
    RC_LOG() << result.error().message;
    RC_ASSERT(result.error().kind == ErrorKind::kInput);
    return;
  }
  const Measurement m = judged(field, options, *result);
  if (!has_walls) RC_ASSERT(result->shape->longest_edge <= *options.quality.shape.max_edge + 1e-4);
  options.run.threads = 3;
  const auto again = simplify(field.view(), options);
  RC_ASSERT(again->mesh.positions == result->mesh.positions && again->mesh.triangles == result->mesh.triangles);
}

RC_GTEST_PROP(cutlines, leave_exactly_the_area_of_the_polygons_that_has_data, ()) {
  const Field field = any_field(14);
  Draughtsman draughtsman(*rc::gen::arbitrary<std::uint32_t>());
  SimplifyOptions options = any_options(draughtsman.rectangles(field));
  options.output.float32_positions = false;
  const auto result = simplify(field.view(), options);
  double area = 0;
  if (result) {
    for (const auto& t : triangles_of(result->mesh, field.rows)) area += doubled_area(t);
  } else {
    RC_ASSERT(result.error().kind == ErrorKind::kInput);
  }
  RC_ASSERT(area * grid::kLatticeSteps * grid::kLatticeSteps ==
            static_cast<double>(doubled_area(field, options.features.cutline)));
}

TEST(cutlines, of_the_whole_raster_change_nothing_but_what_lines_change) {
  const Field field = testing::random_field(5, 40, 30, testing::Relief::kRidges);
  SimplifyOptions options;
  options.goals.max_error = 2;
  Line ring;
  ring.role = LineRole::kOuter;
  ring.polygon = 0;
  ring.points = {{-9, -9, 0}, {60, -9, 0}, {60, 50, 0}, {-9, 50, 0}, {-9, -9, 0}};
  options.features.cutline.rings = {ring};
  const auto whole = simplify(field.view(), options);
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->cut_off, 0u);
  EXPECT_EQ(whole->measurement.samples, 1200u);
}

TEST(cutlines, beside_the_raster_or_on_nodata_are_refused) {
  Field field = testing::random_field(5, 20, 20, testing::Relief::kRidges);
  for (std::int32_t row = 0; row < 10; ++row) {
    for (std::int32_t col = 0; col < 20; ++col) field.samples[static_cast<std::size_t>(20 * row + col)] = NAN;
  }
  SimplifyOptions options;
  options.goals.max_error = 2;
  const auto refuse = [&](double x, double y) {
    Line ring;
    ring.role = LineRole::kOuter;
    ring.polygon = 0;
    ring.points = {{x, y, 0}, {x + 4, y, 0}, {x, y + 4, 0}, {x, y, 0}};
    options.features.cutline.rings = {ring};
    const auto result = simplify(field.view(), options);
    return result ? std::string() : result.error().message;
  };
  EXPECT_EQ(refuse(2, 11), "");
  EXPECT_NE(refuse(100, 100).find("beside the raster"), std::string::npos);
  EXPECT_NE(refuse(2, 2).find("nodata only"), std::string::npos);
}

TEST(cutlines, are_closed_or_refused) {
  Line ring, open;
  ring.name = "ring", open.name = "open";
  ring.points = {{0, 0, 0}, {1, 0, 5}, {1, 1, 0}, {0, 0, 7}};
  open.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  const auto closed = close_rings({ring, ring});
  ASSERT_TRUE(closed);
  EXPECT_EQ((*closed)[0].role, LineRole::kOuter);
  EXPECT_EQ((*closed)[1].polygon, 1u);
  const auto refused = close_rings({ring, open});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("open is an open line"), std::string::npos);
}

TEST(cutlines, along_samples_make_the_others_nodata) {
  OwnedHeightField field;
  field.cols = field.rows = 5;
  field.samples.assign(25, 1);
  Cutline cutline;
  Line ring;
  ring.role = LineRole::kOuter;
  ring.polygon = 0;
  ring.points = {{0.5, 0.5, 0}, {3.5, 0.5, 0}, {3.5, 3.5, 0}, {0.5, 3.5, 0}, {0.5, 0.5, 0}};
  cutline.rings = {ring};
  const auto left = mask_outside(field, cutline);
  ASSERT_TRUE(left);
  EXPECT_EQ(left->lost, 16u);
  EXPECT_EQ(left->kept, 9u);
  EXPECT_TRUE(left->has_surface);
  EXPECT_TRUE(std::isnan(field.samples[0]));
  EXPECT_EQ(field.samples[6], 1);
}

// The parity of edges to the left of an edge's middle, polygon by polygon.
RC_GTEST_PROP(polygon_cover, counts_the_polygons_on_both_sides_of_every_edge, ()) {
  Draughtsman draughtsman(*rc::gen::arbitrary<std::uint32_t>());
  const std::int32_t size = *rc::gen::element(8, 64, 4096);
  geom::Polylines lines;
  std::vector<std::uint32_t> polygons;
  for (int count = 1 + draughtsman.below(6); count > 0; --count) {
    std::vector<Point> ring;
    for (int n = 3 + draughtsman.below(6); n > 0; --n)
      ring.push_back({draughtsman.below(size), draughtsman.below(size)});
    ring.push_back(ring.front());
    lines.add(ring);
    polygons.push_back(static_cast<std::uint32_t>(draughtsman.below(4)));
  }
  const geom::Arrangement arranged = geom::arrange(lines, {}, size, size);
  std::vector<geom::GraphEdge> edges;
  for (const auto& edge : arranged.edges) edges.push_back({edge.a, edge.b});
  std::vector<geom::PolygonEdge> passes;
  for (const auto& chain : arranged.chains) {
    const auto stops = arranged.stops_of(chain);
    for (std::size_t k = 0; k + 1 < stops.size(); ++k)
      passes.push_back(
          {polygons[chain.line],
           {std::min(stops[k].vertex, stops[k + 1].vertex), std::max(stops[k].vertex, stops[k + 1].vertex)}});
  }
  const auto covers = geom::cover_edges(arranged.vertices, edges, passes);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Point a = arranged.vertices[edges[i][0]], b = arranged.vertices[edges[i][1]];
    if (a.y == b.y) continue;
    const Point middle{a.x + b.x, a.y + b.y};
    std::array<int, 4> left{}, right{};
    for (const geom::PolygonEdge& pass : passes) {
      const Point p = arranged.vertices[pass.edge[0]], q = arranged.vertices[pass.edge[1]];
      if (pass.edge == edges[i]) {
        right[pass.polygon] ^= 1;
        continue;
      }
      if (2 * p.y > middle.y || 2 * q.y <= middle.y) continue;
      if (orient({2 * p.x, 2 * p.y}, {2 * q.x, 2 * q.y}, middle) >= 0) continue;
      left[pass.polygon] ^= 1;
      right[pass.polygon] ^= 1;
    }
    RC_ASSERT(covers[i].positive == left[0] + left[1] + left[2] + left[3]);
    RC_ASSERT(covers[i].negative == right[0] + right[1] + right[2] + right[3]);
  }
}

}  // namespace
}  // namespace scarp::cutline_laws_test
