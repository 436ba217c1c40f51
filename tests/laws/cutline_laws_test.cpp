// Laws of cutlines: what lies in the polygons and has data is covered, once, and nothing else; the bound holds there.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "geom/arrangement.h"
#include "geom/polygon_cover.h"
#include "grid/vertex_places.h"
#include "laws/any_field.h"
#include "scarp/cliffs.h"
#include "scarp/cutline.h"
#include "scarp/simplify.h"

namespace scarp::cutline_laws_test {
namespace {

using testing::any_field;
using testing::Field;

constexpr double kNoHeight = std::numeric_limits<double>::quiet_NaN();

class Draughtsman {
 public:
  explicit Draughtsman(std::uint32_t seed) : random_(seed) {}

  std::int32_t below(std::int32_t n) { return static_cast<std::int32_t>(random_() % static_cast<std::uint32_t>(n)); }
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_()) / 4294967296.0);
  }

  /// Rings of any kind in columns and rows: bow-ties, slivers, on samples and far beyond the raster.
  Cutline rings(const Field& field) {
    Cutline cutline;
    const bool is_on_samples = below(3) == 0;
    for (std::uint32_t polygon = static_cast<std::uint32_t>(1 + below(3)); polygon-- > 0;) {
      for (int holes = below(3), k = 0; k <= holes; ++k) {
        Line ring = ring_of(polygon, k);
        for (int n = 3 + below(7); n > 0; --n) {
          const double reach = below(8) == 0 ? 100 : 2;
          std::array<double, 3> p{between(-reach, field.cols + reach), between(-reach, field.rows + reach), kNoHeight};
          if (is_on_samples) p = {std::round(p[0]), std::round(p[1]), kNoHeight};
          ring.points.push_back(p);
        }
        close(ring, cutline);
      }
    }
    return cutline;
  }

  /// Rectangles along the axes, their corners on the lattice.
  Cutline rectangles(const Field& field) {
    Cutline cutline;
    for (std::uint32_t polygon = static_cast<std::uint32_t>(1 + below(3)); polygon-- > 0;) {
      for (int holes = below(4), k = 0; k <= holes; ++k) {
        const auto [left, right] = side(field.cols);
        const auto [top, bottom] = side(field.rows);
        Line ring = ring_of(polygon, k);
        ring.points = {
            {left, top, kNoHeight}, {right, top, kNoHeight}, {right, bottom, kNoHeight}, {left, bottom, kNoHeight}};
        if (below(2) == 0) std::reverse(ring.points.begin(), ring.points.end());
        close(ring, cutline);
      }
    }
    return cutline;
  }

 private:
  static Line ring_of(std::uint32_t polygon, int k) {
    Line ring;
    ring.role = k == 0 ? LineRole::kOuter : LineRole::kHole;
    ring.polygon = polygon;
    ring.name = "polygon " + std::to_string(polygon);
    return ring;
  }
  static void close(Line& ring, Cutline& cutline) {
    ring.points.push_back(ring.points.front());
    cutline.rings.push_back(ring);
  }
  std::pair<double, double> side(std::int32_t size) {
    const std::int32_t grain = below(2) == 0 ? 1 : kLatticeSteps, steps = (size + 1) * kLatticeSteps / grain;
    const std::int32_t a = below(steps), b = below(steps);
    const auto place = [&](std::int32_t step) { return static_cast<double>(step * grain) / kLatticeSteps - 1; };
    return {place(std::min(a, b)), place(std::max(a, b) + 1)};
  }

  std::mt19937 random_;
};

SimplifyOptions any_options(const Cutline& cutline) {
  SimplifyOptions options;
  options.max_error = *rc::gen::element(0.0, 0.5, 1.0, 3.0, 20.0);
  options.effort = *rc::gen::element(Effort::kFast, Effort::kNormal, Effort::kHigh);
  options.order = *rc::gen::element(Order::kAuto, Order::kGreedy);
  options.float32_positions = *rc::gen::arbitrary<bool>();
  options.cutline = cutline;
  return options;
}

bool is_in_polygons(const Cutline& cutline, double x, double y) {
  std::array<bool, 8> inside{};
  for (const Line& ring : cutline.rings) {
    for (std::size_t k = 0; k + 1 < ring.points.size(); ++k) {
      const auto &p = ring.points[k], &q = ring.points[k + 1];
      if ((p[1] <= y) != (q[1] <= y) && p[0] + (y - p[1]) / (q[1] - p[1]) * (q[0] - p[0]) < x)
        inside[ring.polygon] = !inside[ring.polygon];
    }
  }
  return std::find(inside.begin(), inside.end(), true) != inside.end();
}

double distance_to_rings(const Cutline& cutline, double x, double y) {
  double least = std::numeric_limits<double>::infinity();
  for (const Line& ring : cutline.rings) {
    for (std::size_t k = 0; k + 1 < ring.points.size(); ++k) {
      const auto &p = ring.points[k], &q = ring.points[k + 1];
      const double dx = q[0] - p[0], dy = q[1] - p[1], length = dx * dx + dy * dy;
      const double at = length > 0 ? std::clamp(((x - p[0]) * dx + (y - p[1]) * dy) / length, 0.0, 1.0) : 0.0;
      least = std::min(least, std::hypot(p[0] + at * dx - x, p[1] + at * dy - y));
    }
  }
  return least;
}

/// Of a cell: valid corners, as bits.
int corners_of(const Field& field, std::int32_t col, std::int32_t row) {
  int corners = 0;
  for (int k = 0; k < 4; ++k) corners |= field.raster().is_valid({col + k % 2, row + k / 2}) ? 1 << k : 0;
  return corners;
}

/// How far inside the domain a point of a cell is, below 0 outside.
double depth_in_cell(const Field& field, double x, double y) {
  const auto col = static_cast<std::int32_t>(x), row = static_cast<std::int32_t>(y);
  const int corners = corners_of(field, col, row);
  if (corners == 15) return 1;
  for (int k = 0; k < 4; ++k) {
    if (corners != (15 & ~(1 << k))) continue;
    const double u = k % 2 == 0 ? x - col : 1 - (x - col), v = k / 2 == 0 ? y - row : 1 - (y - row);
    return u + v - 1;
  }
  return -1;
}

/// A mesh in the grid frame, in columns and rows.
struct Corner {
  double x, y, z;
};
std::vector<std::array<Corner, 3>> triangles_of(const Mesh& mesh, std::int32_t rows) {
  std::vector<std::array<Corner, 3>> triangles(mesh.triangle_count());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const double* p = &mesh.positions[3 * std::size_t{mesh.triangles[i]}];
    triangles[i / 3][i % 3] = {mesh.origin[0] + p[0], rows - 1 - (mesh.origin[1] + p[1]), mesh.origin[2] + p[2]};
  }
  return triangles;
}

double doubled_area(const std::array<Corner, 3>& t) {
  return std::abs((t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[1].y - t[0].y) * (t[2].x - t[0].x));
}

/// Heights of the triangles at a point; none where nothing covers it.
std::vector<double> heights_at(const std::vector<std::array<Corner, 3>>& triangles, double x, double y) {
  std::vector<double> heights;
  for (const auto& t : triangles) {
    std::array<double, 3> weights{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Corner &p = t[(k + 1) % 3], &q = t[(k + 2) % 3];
      weights[k] = (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x);
    }
    const bool is_held = std::all_of(weights.begin(), weights.end(), [](double w) { return w >= -1e-9; }) ||
                         std::all_of(weights.begin(), weights.end(), [](double w) { return w <= 1e-9; });
    const double sum = weights[0] + weights[1] + weights[2];
    if (is_held && sum != 0) heights.push_back((weights[0] * t[0].z + weights[1] * t[1].z + weights[2] * t[2].z) / sum);
  }
  return heights;
}

RC_GTEST_PROP(cutlines, cover_what_lies_in_the_polygons_and_has_data_within_the_bound_and_nothing_else, ()) {
  const Field field = any_field(24);
  Draughtsman draughtsman(*rc::gen::arbitrary<std::uint32_t>());
  const SimplifyOptions options = any_options(draughtsman.rings(field));
  const auto result = simplify(field.view(), options);
  if (!result) RC_LOG() << result.error().message;
  constexpr double kDoubt = 1.0 / 64;
  const auto triangles = result ? triangles_of(result->mesh, field.rows) : std::vector<std::array<Corner, 3>>();
  for (int probe = 0; probe < 200; ++probe) {
    const double x = draughtsman.between(0, field.cols - 1), y = draughtsman.between(0, field.rows - 1);
    const double depth = depth_in_cell(field, x, y);
    if (distance_to_rings(options.cutline, x, y) < kDoubt || std::abs(depth) < 1e-6) continue;
    const bool is_wanted = depth > 0 && is_in_polygons(options.cutline, x, y);
    RC_ASSERT(heights_at(triangles, x, y).empty() != is_wanted);
  }
  RC_ASSERT(result || result.error().kind == ErrorKind::kInput);
  for (std::int32_t row = 0; result && row < field.rows; ++row) {
    for (std::int32_t col = 0; col < field.cols; ++col) {
      const double sample{field.raster().at({col, row})};
      if (std::isnan(sample) || distance_to_rings(options.cutline, col, row) < kDoubt) continue;
      const auto heights = heights_at(triangles, col, row);
      RC_ASSERT(heights.empty() || is_in_polygons(options.cutline, col, row));
      for (const double height : heights) RC_ASSERT(std::abs(height - sample) <= *options.max_error + 1e-6);
    }
  }
}

/// The judge's own look, which finds the bound kept and the mesh whole.
Measurement judged(const Field& field, const SimplifyOptions& options, const Simplified& result) {
  MeasureOptions judge;
  judge.cutline = &options.cutline;
  const Measurement m = *measure(field.view(), result.mesh, judge);
  RC_ASSERT(m.max_error <= *options.max_error + 1e-9);
  RC_ASSERT(m.uncovered == 0u);
  RC_ASSERT(m.void_cells_covered == 0u);
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
  options.threads = 3;
  const auto again = simplify(field.view(), options);
  RC_ASSERT(again->mesh.positions == result->mesh.positions && again->mesh.triangles == result->mesh.triangles);
}

RC_GTEST_PROP(cutlines, hold_shapes_or_the_lines_of_walls_within_the_bound, ()) {
  const Field field = any_field(24);
  Draughtsman draughtsman(*rc::gen::arbitrary<std::uint32_t>());
  SimplifyOptions options = any_options(draughtsman.rings(field));
  options.max_error = *rc::gen::element(0.5, 1.0, 3.0, 20.0);
  const bool has_walls = *rc::gen::arbitrary<bool>();
  if (has_walls) {
    options.order = Order::kAuto;
    const auto cliffs =
        detect_cliffs(field.view(), {.height = 2 * *options.max_error, .max_error = *options.max_error});
    RC_ASSERT(cliffs.has_value());
    options.breaklines.lines = cliffs->lines;
  } else {
    options.shape.min_angle = *rc::gen::element(0.0, 15.0, 28.0);
    options.shape.max_edge = *rc::gen::element(1.5, 6.0);
  }
  const auto result = simplify(field.view(), options);
  if (!result) {
    RC_LOG() << result.error().message;
    RC_ASSERT(result.error().kind == ErrorKind::kInput);
    return;
  }
  const Measurement m = judged(field, options, *result);
  if (!has_walls) RC_ASSERT(result->shape->longest_edge <= *options.shape.max_edge + 1e-4);
  options.threads = 3;
  const auto again = simplify(field.view(), options);
  RC_ASSERT(again->mesh.positions == result->mesh.positions && again->mesh.triangles == result->mesh.triangles);
}

/// Twice the area of the part of [x0, x1] x [y0, y1] where x + y <= c.
std::int64_t doubled_below(std::int64_t x0, std::int64_t x1, std::int64_t y0, std::int64_t y1, std::int64_t c) {
  const auto square = [](std::int64_t t) { return t > 0 ? t * t : 0; };
  return square(c - x0 - y0) - square(c - x1 - y0) - square(c - x0 - y1) + square(c - x1 - y1);
}

/// Twice the area of the domain in a rectangle of one cell, in lattice steps.
std::int64_t doubled_in_cell(const Field& field, std::int32_t col, std::int32_t row, std::array<std::int64_t, 4> box) {
  const int corners = corners_of(field, col, row);
  auto [x0, x1, y0, y1] = box;
  if (corners == 15) return 2 * (x1 - x0) * (y1 - y0);
  for (int k = 0; k < 4; ++k) {
    if (corners != (15 & ~(1 << k))) continue;
    x0 -= std::int64_t{col} * kLatticeSteps, x1 -= std::int64_t{col} * kLatticeSteps;
    y0 -= std::int64_t{row} * kLatticeSteps, y1 -= std::int64_t{row} * kLatticeSteps;
    // So that the void corner is the last of both.
    if (k % 2 == 0) std::tie(x0, x1) = std::pair(kLatticeSteps - x1, kLatticeSteps - x0);
    if (k / 2 == 0) std::tie(y0, y1) = std::pair(kLatticeSteps - y1, kLatticeSteps - y0);
    return doubled_below(x0, x1, y0, y1, kLatticeSteps);
  }
  return 0;
}

/// Twice the area of polygons and domain, in lattice steps: rectangle by rectangle between all sides of all.
std::int64_t doubled_area(const Field& field, const Cutline& cutline) {
  std::vector<std::int64_t> xs, ys;
  for (std::int32_t col = 0; col < field.cols; ++col) xs.push_back(std::int64_t{col} * kLatticeSteps);
  for (std::int32_t row = 0; row < field.rows; ++row) ys.push_back(std::int64_t{row} * kLatticeSteps);
  for (const Line& ring : cutline.rings) {
    for (const auto& p : ring.points) {
      xs.push_back(std::clamp<std::int64_t>(std::llround(p[0] * kLatticeSteps), 0, (field.cols - 1) * kLatticeSteps));
      ys.push_back(std::clamp<std::int64_t>(std::llround(p[1] * kLatticeSteps), 0, (field.rows - 1) * kLatticeSteps));
    }
  }
  for (auto* values : {&xs, &ys}) std::sort(values->begin(), values->end());
  std::int64_t area = 0;
  for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
    for (std::size_t k = 0; k + 1 < ys.size(); ++k) {
      if (xs[i] == xs[i + 1] || ys[k] == ys[k + 1]) continue;
      const double x = static_cast<double>(xs[i] + xs[i + 1]) / 2 / kLatticeSteps,
                   y = static_cast<double>(ys[k] + ys[k + 1]) / 2 / kLatticeSteps;
      if (is_in_polygons(cutline, x, y))
        area += doubled_in_cell(field, static_cast<std::int32_t>(x), static_cast<std::int32_t>(y),
                                {xs[i], xs[i + 1], ys[k], ys[k + 1]});
    }
  }
  return area;
}

RC_GTEST_PROP(cutlines, leave_exactly_the_area_of_the_polygons_that_has_data, ()) {
  const Field field = any_field(14);
  Draughtsman draughtsman(*rc::gen::arbitrary<std::uint32_t>());
  SimplifyOptions options = any_options(draughtsman.rectangles(field));
  options.float32_positions = false;
  const auto result = simplify(field.view(), options);
  double area = 0;
  if (result) {
    for (const auto& t : triangles_of(result->mesh, field.rows)) area += doubled_area(t);
  } else {
    RC_ASSERT(result.error().kind == ErrorKind::kInput);
  }
  RC_ASSERT(area * kLatticeSteps * kLatticeSteps == static_cast<double>(doubled_area(field, options.cutline)));
}

TEST(cutlines, of_the_whole_raster_change_nothing_but_what_lines_change) {
  const Field field = testing::random_field(5, 40, 30, testing::Relief::kRidges);
  SimplifyOptions options;
  options.max_error = 2;
  Line ring;
  ring.role = LineRole::kOuter;
  ring.polygon = 0;
  ring.points = {{-9, -9, 0}, {60, -9, 0}, {60, 50, 0}, {-9, 50, 0}, {-9, -9, 0}};
  options.cutline.rings = {ring};
  const auto whole = simplify(field.view(), options);
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->cut_off, 0u);
  EXPECT_EQ(whole->measurement.samples, 1200u);
}

TEST(cutlines, beside_the_raster_or_on_voids_are_refused) {
  Field field = testing::random_field(5, 20, 20, testing::Relief::kRidges);
  for (std::int32_t row = 0; row < 10; ++row) {
    for (std::int32_t col = 0; col < 20; ++col) field.samples[static_cast<std::size_t>(20 * row + col)] = NAN;
  }
  SimplifyOptions options;
  options.max_error = 2;
  const auto refuse = [&](double x, double y) {
    Line ring;
    ring.role = LineRole::kOuter;
    ring.polygon = 0;
    ring.points = {{x, y, 0}, {x + 4, y, 0}, {x, y + 4, 0}, {x, y, 0}};
    options.cutline.rings = {ring};
    const auto result = simplify(field.view(), options);
    return result ? std::string() : result.error().message;
  };
  EXPECT_EQ(refuse(2, 11), "");
  EXPECT_NE(refuse(100, 100).find("beside the raster"), std::string::npos);
  EXPECT_NE(refuse(2, 2).find("voids only"), std::string::npos);
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

TEST(cutlines, along_samples_make_the_others_void) {
  OwnedHeightField field;
  field.cols = field.rows = 5;
  field.samples.assign(25, 1);
  Cutline cutline;
  Line ring;
  ring.role = LineRole::kOuter;
  ring.polygon = 0;
  ring.points = {{0.5, 0.5, 0}, {3.5, 0.5, 0}, {3.5, 3.5, 0}, {0.5, 3.5, 0}, {0.5, 0.5, 0}};
  cutline.rings = {ring};
  EXPECT_EQ(void_outside(field, cutline), 16u);
  EXPECT_TRUE(std::isnan(field.samples[0]));
  EXPECT_EQ(field.samples[6], 1);
}

// The parity of edges to the left of an edge's middle, polygon by polygon.
RC_GTEST_PROP(polygon_cover, counts_the_polygons_on_both_sides_of_every_edge, ()) {
  Draughtsman draughtsman(*rc::gen::arbitrary<std::uint32_t>());
  const std::int32_t size = *rc::gen::element(8, 64, 4096);
  Polylines lines;
  std::vector<std::uint32_t> polygons;
  for (int count = 1 + draughtsman.below(6); count > 0; --count) {
    std::vector<Point> ring;
    for (int n = 3 + draughtsman.below(6); n > 0; --n)
      ring.push_back({draughtsman.below(size), draughtsman.below(size)});
    ring.push_back(ring.front());
    lines.add(ring);
    polygons.push_back(static_cast<std::uint32_t>(draughtsman.below(4)));
  }
  const Arrangement arranged = arrange(lines, {}, size, size);
  std::vector<GraphEdge> edges;
  for (const auto& edge : arranged.edges) edges.push_back({edge.a, edge.b});
  std::vector<PolygonEdge> passes;
  for (const auto& chain : arranged.chains) {
    const auto stops = arranged.stops_of(chain);
    for (std::size_t k = 0; k + 1 < stops.size(); ++k)
      passes.push_back(
          {polygons[chain.line],
           {std::min(stops[k].vertex, stops[k + 1].vertex), std::max(stops[k].vertex, stops[k + 1].vertex)}});
  }
  const auto covers = cover_edges(arranged.vertices, edges, passes);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Point a = arranged.vertices[edges[i][0]], b = arranged.vertices[edges[i][1]];
    if (a.y == b.y) continue;
    const Point middle{a.x + b.x, a.y + b.y};
    std::array<int, 4> left{}, right{};
    for (const PolygonEdge& pass : passes) {
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
