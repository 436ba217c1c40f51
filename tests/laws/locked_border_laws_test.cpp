// Laws of locked borders: vertices on the raster's edge depend only on the edge, and no effort changes them.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <vector>

#include "laws/any_field.h"
#include "laws/fields.h"
#include "laws/sanitized.h"
#include "scarp/measure.h"
#include "scarp/options.h"
#include "scarp/simplify.h"

namespace scarp::locked_border_laws_test {
namespace {

using testing::any_field;
using testing::Field;
using testing::Relief;

constexpr float kNodata = std::numeric_limits<float>::quiet_NaN();

/// The textbook algorithm for integer heights and a tolerance of 511 · `unit`: every pair of samples, in integers.
class Textbook {
 public:
  Textbook(const std::vector<float>& heights, std::int64_t unit) : room_(511 * unit) {
    for (const float z : heights) heights_.push_back(std::llround(z));
  }

  /// From `first` to `last`, all valid.
  std::vector<std::int32_t> find(std::size_t first, std::size_t last) const {
    std::vector<int> segments(last + 1, std::numeric_limits<int>::max());
    std::vector<std::size_t> before(last + 1, first);
    segments[first] = 0;
    for (std::size_t j = first + 1; j <= last; ++j) {
      for (std::size_t i = first; i < j; ++i) {
        if (segments[i] + 1 >= segments[j] || !is_allowed(i, j)) continue;
        segments[j] = segments[i] + 1;
        before[j] = i;
      }
    }
    std::vector<std::int32_t> vertices;
    for (std::size_t i = last; i != first; i = before[i]) vertices.push_back(static_cast<std::int32_t>(i));
    vertices.push_back(static_cast<std::int32_t>(first));
    std::reverse(vertices.begin(), vertices.end());
    return vertices;
  }

 private:
  bool is_allowed(std::size_t i, std::size_t j) const {
    const auto steps = static_cast<std::int64_t>(j - i);
    for (std::size_t k = i + 1; k < j; ++k) {
      const std::int64_t off =
          (heights_[k] - heights_[i]) * steps - (heights_[j] - heights_[i]) * static_cast<std::int64_t>(k - i);
      if (std::abs(off) > room_ * steps) return false;
    }
    return true;
  }

  std::vector<std::int64_t> heights_;
  std::int64_t room_;
};

RC_GTEST_PROP(simplify_edge, finds_what_the_textbook_finds, ()) {
  const auto unit = *rc::gen::element(0, 1, 2, 5);
  const auto steep = *rc::gen::element(1, 300, 4000);
  const auto count = *rc::gen::inRange(1, 60);
  std::vector<float> heights;
  for (int i = 0; i < count; ++i)
    heights.push_back(*rc::gen::inRange(0, 12) == 0 ? kNodata : static_cast<float>(*rc::gen::inRange(0, 4) * steep));
  std::vector<std::int32_t> expected;
  const Textbook textbook(heights, unit);
  for (std::size_t i = 0; i < heights.size(); ++i) {
    if (std::isnan(heights[i])) continue;
    const std::size_t first = i;
    while (i + 1 < heights.size() && !std::isnan(heights[i + 1])) ++i;
    const auto run = textbook.find(first, i);
    expected.insert(expected.end(), run.begin(), run.end());
  }
  RC_ASSERT(simplify_edge(heights, 512.0 * unit) == expected);
  RC_ASSERT(simplify_edge(heights, 0, std::vector<double>(heights.size(), 512.0 * unit)) == expected);
}

TEST(simplify_edge, spans_a_long_level_edge_in_few_segments) {
  const std::vector<float> sea(20'000, 0.0f);
  EXPECT_EQ(simplify_edge(sea, 1).size(), 4u);
}

/// An edge of a field: its samples and the adjacent row.
struct Edge {
  std::vector<Point> points;
  std::vector<float> heights, behind;

  bool is_height(std::size_t i) const { return i < heights.size() && !std::isnan(heights[i]); }
  /// True if the surface reaches the step after sample i: a cell with three heights or more.
  bool is_covered(std::size_t i) const {
    return is_height(i) && is_height(i + 1) && !(std::isnan(behind[i]) && std::isnan(behind[i + 1]));
  }
};

std::vector<Edge> edges_of(const Field& field) {
  std::vector<Edge> edges(4);
  const auto add = [&](std::size_t edge, Point on, Point behind) {
    edges[edge].points.push_back(on);
    edges[edge].heights.push_back(field.raster().at(on));
    edges[edge].behind.push_back(field.raster().at(behind));
  };
  const std::int32_t right = field.cols - 1, bottom = field.rows - 1;
  for (std::int32_t x = 0; x < field.cols; ++x) {
    add(0, {x, 0}, {x, 1});
    add(1, {x, bottom}, {x, bottom - 1});
  }
  for (std::int32_t y = 0; y < field.rows; ++y) {
    add(2, {0, y}, {1, y});
    add(3, {right, y}, {right - 1, y});
  }
  return edges;
}

/// A vertex on an edge: its height, and its normal if any.
struct OnEdge {
  double z = 0;
  std::array<float, 3> normal{};

  friend bool operator==(const OnEdge&, const OnEdge&) = default;
};

/// The mesh's vertices on an edge, by step along it.
std::map<std::size_t, OnEdge> vertices_on(const Mesh& mesh, const Field& field, const Edge& edge) {
  std::map<std::size_t, OnEdge> found;
  const Point a = edge.points.front(), b = edge.points.back();
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const auto [x, up, z] = mesh.vertex(v);
    const double y = field.rows - 1 - up;
    const bool is_on = a.x == b.x ? x == a.x : y == a.y;
    const double step = a.x == b.x ? y : x;
    if (!is_on) continue;
    OnEdge& vertex = found[step == std::floor(step) ? static_cast<std::size_t>(step) : std::size_t{1} << 40];
    vertex.z = z;
    for (std::size_t k = 0; k < 3 && !mesh.normals.empty(); ++k) vertex.normal[k] = mesh.normals[3 * v + k];
  }
  return found;
}

SimplifyOptions locked(double max_error, Effort effort) {
  SimplifyOptions options;
  options.goals.max_error = max_error;
  options.quality.effort = effort;
  options.domain.border.is_locked = true;
  return options;
}

Effort any_effort() { return *rc::gen::element(Effort::kFast, Effort::kNormal, Effort::kHigh, Effort::kMax); }

void expect_line(const Mesh& mesh, const Field& field, double max_error) {
  for (const Edge& edge : edges_of(field)) {
    const auto line = simplify_edge(edge.heights, max_error);
    const auto found = vertices_on(mesh, field, edge);
    const auto is_covered = [&](std::size_t i) { return i + 1 < edge.points.size() && edge.is_covered(i); };
    for (const std::int32_t vertex : line) {
      const auto i = static_cast<std::size_t>(vertex);
      if (!is_covered(i) && !(i > 0 && is_covered(i - 1))) continue;
      RC_ASSERT(found.count(i) == 1u);
      RC_ASSERT(found.at(i).z == edge.heights[i]);
    }
    for (const auto& [i, vertex] : found) {
      const bool is_on_line = std::binary_search(line.begin(), line.end(), static_cast<std::int32_t>(i));
      // Alternatively, two half cells meet there.
      const bool is_corner =
          i < edge.points.size() && (std::isnan(edge.behind[i]) || is_covered(i) != (i > 0 && is_covered(i - 1)));
      RC_ASSERT(is_on_line || is_corner);
    }
  }
}

RC_GTEST_PROP(locked_border, has_the_vertices_of_the_line_and_no_others, ()) {
  const Field field = any_field(40);
  const double goal = *rc::gen::element(0.0, 0.5, 1.0, 3.0, 20.0);
  auto options = locked(goal, any_effort());
  options.output.float32_positions = *rc::gen::arbitrary<bool>();
  options.quality.order = *rc::gen::element(Order::kAuto, Order::kDominant, Order::kGreedy);
  options.run.threads = 1;
  const auto made = simplify(field.view(), options);
  if (!made) {
    RC_ASSERT(made.error().kind == ErrorKind::kInput);  // no surface
    return;
  }
  expect_line(made->mesh, field, goal);
  const bool has_nodata =
      std::any_of(field.samples.begin(), field.samples.end(), [](float z) { return std::isnan(z); });
  if (has_nodata || options.quality.order == Order::kGreedy) RC_ASSERT(made->order == Order::kGreedy);
  if (!has_nodata && options.quality.order == Order::kDominant) RC_ASSERT(made->order == Order::kDominant);
  const Measurement m = *measure(field.view(), made->mesh);
  RC_ASSERT(m.max_error <= goal + 1e-9);
  RC_ASSERT(m.uncovered == 0u);
  RC_ASSERT(m.is_sound());
  options.run.threads = 3;
  const auto again = simplify(field.view(), options);
  RC_ASSERT(again->mesh.positions == made->mesh.positions);
  RC_ASSERT(again->mesh.triangles == made->mesh.triangles);
}

/// Columns [first, end) of a field.
Field columns(const Field& field, std::int32_t first, std::int32_t end) {
  Field part{end - first, field.rows, {}};
  for (std::int32_t y = 0; y < field.rows; ++y)
    part.samples.insert(part.samples.end(), field.raster().row(y) + first, field.raster().row(y) + end);
  return part;
}

RC_GTEST_PROP(locked_border, rasters_simplified_apart_meet, ()) {
  const auto relief = *rc::gen::element(Relief::kTies, Relief::kFlat, Relief::kCliff, Relief::kReal, Relief::kRidges);
  const Field field = testing::random_field(*rc::gen::arbitrary<std::uint32_t>(), *rc::gen::inRange(4, 50),
                                            *rc::gen::inRange(2, 60), relief);
  const auto at = *rc::gen::inRange(1, field.cols - 1);
  const Field west = columns(field, 0, at + 1), east = columns(field, at, field.cols);
  const double goal = *rc::gen::element(0.0, 1.0, 5.0, 30.0);
  const auto left = simplify(west.view(), locked(goal, any_effort()));
  const auto right = simplify(east.view(), locked(goal, any_effort()));
  RC_ASSERT(left && right);
  RC_ASSERT(vertices_on(left->mesh, west, edges_of(west)[3]) == vertices_on(right->mesh, east, edges_of(east)[2]));
}

std::vector<float> column(const Field& field, std::int32_t x) {
  std::vector<float> samples;
  for (std::int32_t y = 0; y < field.rows; ++y) samples.push_back(field.raster().at({x, y}));
  return samples;
}

// Cuts at a column or a row, with or without the samples beyond, with nodata.
RC_GTEST_PROP(locked_border, has_the_same_normals_on_both_sides, ()) {
  const auto relief = *rc::gen::element(Relief::kTies, Relief::kFlat, Relief::kCliff, Relief::kReal, Relief::kRidges);
  const Field field = testing::random_field(*rc::gen::arbitrary<std::uint32_t>(), *rc::gen::inRange(4, 40),
                                            *rc::gen::inRange(2, 40), relief, *rc::gen::element(0.0, 0.0, 0.1));
  const auto at = *rc::gen::inRange(1, field.cols - 1);
  Field first = columns(field, 0, at + 1), second = columns(field, at, field.cols);
  auto options = locked(*rc::gen::element(0.0, 1.0, 5.0), any_effort());
  options.output.normals = true;
  SimplifyOptions of_second = options;
  BeyondEdges &beyond = options.domain.border.beyond, &beyond_second = of_second.domain.border.beyond;
  const bool knows_beyond = *rc::gen::arbitrary<bool>(), is_row = *rc::gen::arbitrary<bool>();
  std::size_t side = 3, side_second = 2;
  if (is_row) {
    first = transposed(first);
    second = transposed(second);
    side = 1;
    side_second = 0;
  }
  if (knows_beyond) {
    (is_row ? beyond.bottom : beyond.right) = column(field, at + 1);
    (is_row ? beyond_second.top : beyond_second.left) = column(field, at - 1);
  }
  const auto left = simplify(first.view(), options), right = simplify(second.view(), of_second);
  if (!left || !right) return;  // no surface
  const auto here = vertices_on(left->mesh, first, edges_of(first)[side]);
  for (const auto& [step, vertex] : vertices_on(right->mesh, second, edges_of(second)[side_second])) {
    // With nodata next to the edge, one of the two meshes may have another vertex, also between samples.
    if (step >= edges_of(second)[side_second].points.size()) continue;
    if (const auto same = here.find(step); same != here.end()) RC_ASSERT(same->second == vertex);
  }
}

TEST(locked_border, has_the_normals_of_the_whole_raster_where_it_knows_what_is_beyond) {
  const Field field = testing::random_field(7, 30, 20, Relief::kReal);
  const Field west = columns(field, 0, 13);
  auto options = locked(0, Effort::kFast);
  options.output.normals = true;
  const auto whole = simplify(field.view(), options);
  const auto apart = simplify(west.view(), options);
  options.domain.border.beyond.right = column(field, 13);
  const auto known = simplify(west.view(), options);
  ASSERT_TRUE(whole && apart && known);
  Edge middle;
  for (std::int32_t y = 0; y < field.rows; ++y) middle.points.push_back({12, y});
  const auto wanted = vertices_on(whole->mesh, field, middle), found = vertices_on(known->mesh, west, middle);
  std::size_t compared = 0, level = 0;
  for (const auto& [step, vertex] : found) {
    const auto same = wanted.find(step);
    if (same == wanted.end() || step == 0 || step + 1 == static_cast<std::size_t>(field.rows)) continue;
    ++compared;
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(same->second.normal[k], vertex.normal[k], 1e-6f);
  }
  EXPECT_GT(compared, 10u);
  // Level across the edge if the samples beyond are unknown.
  for (const auto& [step, vertex] : vertices_on(apart->mesh, west, middle)) level += vertex.normal[0] == 0;
  EXPECT_GT(level, 10u);
  options.domain.border.beyond.right.pop_back();
  EXPECT_EQ(simplify(west.view(), options).error().kind, ErrorKind::kUsage);
}

TEST(locked_border, tolerances_weights_and_ignored_samples_decide_the_line_too) {
  for (std::uint32_t seed = 0; seed < 12; ++seed) {
    const Field field = testing::random_field(seed, 45, 38, Relief::kRidges);
    std::vector<float> values;
    for (std::size_t i = 0; i < field.samples.size(); ++i) values.push_back(1.0f + static_cast<float>(i % 7));
    for (const bool is_tolerance : {true, false}) {
      SimplifyOptions options = locked(14, seed % 2 == 0 ? Effort::kNormal : Effort::kHigh);
      const std::vector<SampleAt> ignored{{7, 0}, {0, 9}, {44, 20}};
      options.tolerances.ignored = ignored;
      (is_tolerance ? options.tolerances.values : options.tolerances.weights) = values;
      const auto made = simplify(field.view(), options);
      ASSERT_TRUE(made) << made.error().message;
      EXPECT_LE(made->judged_max_error, (is_tolerance ? 1 : 14) * 1.000001);
      for (const Edge& edge : edges_of(field)) {
        std::vector<double> bounds;
        for (const Point p : edge.points) {
          const double value = values[static_cast<std::size_t>(p.y * field.cols + p.x)];
          bounds.push_back(is_tolerance ? value : 14 / value);
          if (std::count(ignored.begin(), ignored.end(), SampleAt{p.x, p.y}) > 0) bounds.back() = HUGE_VAL;
        }
        std::vector<std::int32_t> found;
        for (const auto& [i, z] : vertices_on(made->mesh, field, edge)) found.push_back(static_cast<std::int32_t>(i));
        EXPECT_EQ(found, simplify_edge(edge.heights, 0, bounds));
      }
    }
  }
}

TEST(locked_border, lets_the_mesh_begin_with_points_in_either_order) {
  const Field field = testing::random_field(11, 90, 70, Relief::kRidges);
  for (const Order order : {Order::kAuto, Order::kGreedy}) {
    for (const Effort effort : {Effort::kFast, Effort::kNormal, Effort::kHigh}) {
      SimplifyOptions options = locked(5, effort);
      options.quality.order = order;
      options.features.points = {{1, 1}, {44, 35}, {44, 36}, {88, 68}};
      const auto made = simplify(field.view(), options);
      ASSERT_TRUE(made) << made.error().message;
      EXPECT_EQ(made->order, order == Order::kAuto ? Order::kDominant : Order::kGreedy);
      EXPECT_LE(measure(field.view(), made->mesh)->max_error, 5 + 1e-9);
      expect_line(made->mesh, field, 5);
      for (const SampleAt& point : options.features.points) {
        std::size_t found = 0;
        for (std::size_t v = 0; v < made->mesh.vertex_count(); ++v) {
          const auto [x, up, z] = made->mesh.vertex(v);
          found += x == point.col && field.rows - 1 - up == point.row;
        }
        EXPECT_EQ(found, 1u);
      }
    }
  }
}

TEST(locked_border, is_what_the_caller_gives) {
  const Field field = testing::random_field(3, 30, 20, Relief::kRidges);
  SimplifyOptions options = locked(400, Effort::kHigh);
  options.domain.border.vertices = EdgeVertices{{3, 11}, {}, {0, 5, 19}, {7}};
  const auto made = simplify(field.view(), options);
  ASSERT_TRUE(made) << made.error().message;
  const std::vector<std::vector<std::size_t>> expected{{0, 3, 11, 29}, {0, 29}, {0, 5, 19}, {0, 7, 19}};
  const auto edges = edges_of(field);
  for (std::size_t k = 0; k < edges.size(); ++k) {
    std::vector<std::size_t> found;
    for (const auto& [i, z] : vertices_on(made->mesh, field, edges[k])) found.push_back(i);
    EXPECT_EQ(found, expected[k]);
  }
  options.goals.max_error = options.domain.border.max_error = 1;
  const auto loose = simplify(field.view(), options);
  ASSERT_FALSE(loose);
  EXPECT_NE(loose.error().message.find("the border's top edge misses sample"), std::string::npos);
  options.domain.border.vertices = EdgeVertices{{3, 30}, {}, {}, {}};
  EXPECT_EQ(simplify(field.view(), options).error().message,
            "vertex 30 of the border's top edge is no sample with a height beyond the one before it");
}

RC_GTEST_PROP(locked_border, breaklines_end_at_its_vertices, ()) {
  const Field field = testing::random_field(*rc::gen::arbitrary<std::uint32_t>(), *rc::gen::inRange(4, 50),
                                            *rc::gen::inRange(4, 60), Relief::kReal);
  const std::int32_t right = field.cols - 1, bottom = field.rows - 1;
  const auto top = *rc::gen::inRange(1, right), low = *rc::gen::inRange(1, right), left = *rc::gen::inRange(1, bottom);
  auto options = locked(1e5, any_effort());
  options.goals.max_error = *rc::gen::element(5.0, 40.0);
  options.domain.border.max_error = options.goals.max_error;
  // The line of an edge through one of its samples.
  const auto line_through = [&](const Edge& edge, std::int32_t at) {
    const auto middle = static_cast<std::size_t>(at);
    std::vector<std::int32_t> vertices =
        simplify_edge(std::span(edge.heights).first(middle + 1), *options.goals.max_error);
    for (const std::int32_t i : simplify_edge(std::span(edge.heights).subspan(middle), *options.goals.max_error)) {
      if (i > 0) vertices.push_back(at + i);
    }
    return vertices;
  };
  std::vector<std::vector<std::int32_t>> given;
  const std::array<std::int32_t, 4> ends{top, low, left, bottom};
  for (std::size_t k = 0; k < 4; ++k) given.push_back(line_through(edges_of(field)[k], ends[k]));
  options.domain.border.vertices = EdgeVertices{given[0], given[1], given[2], given[3]};
  const auto line = [&](std::vector<std::array<double, 2>> places) {
    Line made;
    for (const auto& [col, row] : places) made.points.push_back({col, row, NAN});
    made.name = "line";
    options.features.breaklines.lines.push_back(std::move(made));
  };
  const double inside = *rc::gen::inRange(1, right * 4) / 4.0, down = *rc::gen::inRange(1, bottom * 4) / 4.0;
  line({{double(top), 0}, {inside, down}, {double(low), double(bottom)}});
  line({{0, double(left)}, {inside, bottom / 2.0}});
  const auto made = simplify(field.view(), options);
  RC_ASSERT(made.has_value());
  const auto edges = edges_of(field);
  for (std::size_t k = 0; k < edges.size(); ++k) {
    std::vector<std::int32_t> found;
    for (const auto& [i, z] : vertices_on(made->mesh, field, edges[k])) found.push_back(static_cast<std::int32_t>(i));
    RC_ASSERT(found == given[k]);
  }
  const Measurement m = *measure(field.view(), made->mesh);
  RC_ASSERT(m.max_error <= *options.goals.max_error + 1e-9);
  RC_ASSERT(m.uncovered == 0u && m.is_sound());
  RC_ASSERT(made->lines_inserted == 2u);
}

TEST(locked_border, breaklines_that_end_elsewhere_are_refused) {
  const Field field = testing::random_field(3, 30, 20, Relief::kRidges);
  for (const double col : {8.0, 11.5}) {
    SimplifyOptions options = locked(400, Effort::kNormal);
    options.domain.border.vertices = EdgeVertices{{3, 11}, {}, {0, 5, 19}, {7}};
    Line line;
    line.points = {{col, 0, NAN}, {12, 9, NAN}};
    line.name = "line";
    options.features.breaklines.lines = {line};
    const auto made = simplify(field.view(), options);
    ASSERT_FALSE(made);
    EXPECT_NE(made.error().message.find("a line meets the raster's edge at sample ("), std::string::npos);
    options.features.breaklines.lines[0].points[0][0] = 11;
    EXPECT_TRUE(simplify(field.view(), options));
  }
}

TEST(locked_border, stays_that_of_the_max_error_when_a_budget_allows_less) {
  const Field field = testing::random_field(5, 60, 50, Relief::kRidges);
  for (const Effort effort : {Effort::kFast, Effort::kNormal, Effort::kHigh}) {
    SimplifyOptions options = locked(6, effort);
    options.goals.max_triangles = 4 * simplify(field.view(), options)->mesh.triangle_count() / 5;
    const auto made = simplify(field.view(), options);
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_EQ(made->stop, StopReason::kMaxTriangles);
    for (const Edge& edge : edges_of(field)) {
      std::vector<std::int32_t> found;
      for (const auto& [i, z] : vertices_on(made->mesh, field, edge)) found.push_back(static_cast<std::int32_t>(i));
      EXPECT_EQ(found, simplify_edge(edge.heights, 6));
    }
    options.goals.max_triangles = 20;
    const auto refused = simplify(field.view(), options);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("the locked border and the outline of the valid data alone need"),
              std::string::npos);
  }
  SimplifyOptions options = locked(20, Effort::kFast);
  options.goals = {.max_triangles = 200};
  EXPECT_EQ(simplify(field.view(), options).error().message,
            "a locked border needs a max error: a budget finds another one for each raster");
  options.goals.max_error = 1;
  options.domain.border.max_error = 2;
  EXPECT_EQ(simplify(field.view(), options).error().message,
            "the border's max error must lie in 0 … 1, that of the mesh, not 2");
}

/// The largest error over all triangles and samples.
double find_largest_error(const Mesh& mesh, const Field& field) {
  double largest = 0;
  for (std::int32_t row = 0; row < field.rows; ++row) {
    for (std::int32_t col = 0; col < field.cols; ++col) {
      const double z = field.raster().at({col, row}), x = col, y = field.rows - 1 - row;
      if (std::isnan(z)) continue;
      double least = HUGE_VAL;
      for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        const auto a = mesh.vertex(mesh.triangles[3 * t]), b = mesh.vertex(mesh.triangles[3 * t + 1]),
                   c = mesh.vertex(mesh.triangles[3 * t + 2]);
        const double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        const double v = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / area;
        const double w = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / area;
        if (v < -1e-12 || w < -1e-12 || v + w > 1 + 1e-12) continue;
        least = std::min(least, std::abs(a[2] + v * (b[2] - a[2]) + w * (c[2] - a[2]) - z));
      }
      if (!std::isinf(least)) largest = std::max(largest, least);
    }
  }
  return largest;
}

RC_GTEST_PROP(levels, keep_their_own_max_errors_on_one_outline, ()) {
  const Field field = any_field(30);
  const double ratio = *rc::gen::element(1.5, 2.0, 4.0), finest = *rc::gen::element(0.5, 2.0, 10.0);
  SimplifyOptions options;
  options.goals.max_error = finest;
  options.quality.effort = any_effort();
  const auto levels = simplify_levels(field.view(), options, {3, ratio});
  if (!levels) {
    RC_ASSERT(levels.error().kind == ErrorKind::kInput);
    return;
  }
  RC_ASSERT(levels->size() == 3u);
  const auto edges = edges_of(field);
  for (std::size_t k = 0; k < 3; ++k) {
    const Mesh& mesh = (*levels)[k].mesh;
    const double bound = finest * std::pow(ratio, static_cast<double>(k));
    RC_ASSERT(find_largest_error(mesh, field) <= bound * (1 + 1e-9));
    for (const Edge& edge : edges)
      RC_ASSERT(vertices_on(mesh, field, edge) == vertices_on(levels->front().mesh, field, edge));
    expect_line(mesh, field, finest);
  }
}

TEST(levels, share_an_outline_whose_heights_are_rounded) {
  Field field = testing::random_field(5, 60, 50, Relief::kRidges);
  for (float& height : field.samples) height *= 1.1f;  // no multiples of a power of two
  SimplifyOptions options;
  options.goals.max_error = 3;
  options.output.lattice = true;
  const auto levels = simplify_levels(field.view(), options, {3, 2});
  ASSERT_TRUE(levels);
  for (const Edge& edge : edges_of(field)) {
    const auto finest = vertices_on(levels->front().mesh, field, edge);
    EXPECT_GT(finest.size(), 2u);
    for (std::size_t k = 1; k < 3; ++k) EXPECT_EQ(vertices_on((*levels)[k].mesh, field, edge), finest);
  }
}

TEST(levels, say_what_they_need) {
  const Field field = testing::random_field(5, 20, 20, Relief::kRidges);
  SimplifyOptions options;
  options.goals.max_error = 1;
  const auto sentence = [&](const Levels& levels) {
    const auto made = simplify_levels(field.view(), options, levels);
    return made ? std::string() : made.error().message;
  };
  EXPECT_EQ(sentence({0, 2}), "the number of levels must lie in 1 … 32, not 0");
  EXPECT_EQ(sentence({2, 1}), "the ratio of levels must be a finite number above 1, not 1");
  options.goals.max_triangles = 100;
  EXPECT_EQ(
      sentence({2, 2}),
      "levels cannot be combined with max_triangles: levels are meshes of one max error each, from the finest on");
}

}  // namespace
}  // namespace scarp::locked_border_laws_test
