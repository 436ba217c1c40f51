// Laws of shapes: the returned mesh satisfies the bound, angles, lengths and their growth for any raster.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <utility>

#include "laws/any_field.h"
#include "laws/array_source.h"
#include "scarp/measure.h"
#include "scarp/simplify.h"

namespace scarp::shape_laws_test {
namespace {

using testing::Field;

double length(const Mesh& mesh, std::uint32_t v, std::uint32_t w) {
  return std::hypot(mesh.positions[3 * v] - mesh.positions[3 * w],
                    mesh.positions[3 * v + 1] - mesh.positions[3 * w + 1]);
}

/// Angle at the corner of a triangle, in degrees.
double angle(const Mesh& mesh, std::size_t corner) {
  const std::size_t t = corner / 3;
  const std::uint32_t apex = mesh.triangles[corner], v = mesh.triangles[3 * t + (corner + 1) % 3],
                      w = mesh.triangles[3 * t + (corner + 2) % 3];
  const double a = length(mesh, v, w), b = length(mesh, apex, v), c = length(mesh, apex, w);
  return std::acos(std::clamp((b * b + c * c - a * a) / (2 * b * c), -1.0, 1.0)) * 180 / std::numbers::pi;
}

/// Triangles with an angle below this, counted independently of the engine.
std::uint64_t count_below(const Mesh& mesh, double degrees) {
  std::uint64_t below = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    bool is_below = false;
    for (std::size_t corner = 3 * t; corner < 3 * t + 3; ++corner)
      is_below = is_below || angle(mesh, corner) < degrees - 1e-4;
    below += is_below;
  }
  return below;
}

double longest_edge(const Mesh& mesh) {
  double longest = 0;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k)
    longest = std::max(longest, length(mesh, mesh.triangles[k], mesh.triangles[k % 3 == 2 ? k - 2 : k + 1]));
  return longest;
}

/// Visits the ends of every edge, some twice.
template <class Visit>
void visit_edges(const Mesh& mesh, Visit&& visit) {
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k)
    visit(mesh.triangles[k], mesh.triangles[k % 3 == 2 ? k - 2 : k + 1]);
}

/// The largest ratio of an edge's length to the length that a grade allows. By definition, sizes spread along edges
/// until no size decreases.
double worst_growth(const Mesh& mesh, double grade, double least) {
  std::vector<double> sizes(mesh.vertex_count(), std::numeric_limits<double>::infinity());
  visit_edges(mesh, [&](std::uint32_t v, std::uint32_t w) {
    for (const std::uint32_t u : {v, w}) sizes[u] = std::min(sizes[u], std::max(length(mesh, v, w), least));
  });
  for (bool falls = true; falls;) {
    falls = false;
    visit_edges(mesh, [&](std::uint32_t v, std::uint32_t w) {
      for (const auto& [from, to] : {std::pair{v, w}, std::pair{w, v}}) {
        const double size = sizes[from] + grade * length(mesh, v, w);
        if (!(size < sizes[to])) continue;
        sizes[to] = size;
        falls = true;
      }
    });
  }
  double worst = 0;
  visit_edges(mesh, [&](std::uint32_t v, std::uint32_t w) {
    worst = std::max(worst, length(mesh, v, w) / (2 * std::max(sizes[v], sizes[w])));
  });
  return worst;
}

SimplifyOptions any_run() {
  SimplifyOptions options;
  options.goals.max_error = *rc::gen::element(0.0, 0.5, 2.0, 20.0, 2000.0);
  options.quality.effort = *rc::gen::element(Effort::kFast, Effort::kNormal, Effort::kHigh);
  options.quality.order = *rc::gen::element(Order::kAuto, Order::kGreedy);
  options.output.float32_positions = *rc::gen::arbitrary<bool>();
  options.run.threads = 1;
  return options;
}

/// Non-square samples in a frame that may be rotated.
Frame any_frame(int rows) {
  Frame frame = grid_frame(rows);
  if (*rc::gen::inRange(0, 3) > 0) return frame;
  const double across = *rc::gen::element(0.5, 1.0, 3.0), down = *rc::gen::element(-2.0, -1.0, 1.0);
  frame.affine = {100, across, *rc::gen::element(0.0, 0.25), 2000, *rc::gen::element(0.0, 0.125), down};
  return frame;
}

double longer_side(const Frame& frame) {
  return std::max(std::hypot(frame.affine[1], frame.affine[4]), std::hypot(frame.affine[2], frame.affine[5]));
}

/// Two lines of the map over the raster.
std::vector<Line> any_two_lines(const Field& field) {
  std::vector<Line> lines(2);
  for (Line& line : lines) {
    line.name = "line";
    for (int k = 0; k < 3; ++k) {
      const auto at = [](int most) { return *rc::gen::inRange(-100, 100 * most) / 100.0; };
      line.points.push_back({at(field.cols), at(field.rows), std::numeric_limits<double>::quiet_NaN()});
    }
    line.points.erase(std::unique(line.points.begin(), line.points.end(),
                                  [](const auto& a, const auto& b) { return a[0] == b[0] && a[1] == b[1]; }),
                      line.points.end());
    if (line.points.size() < 2) line.points.push_back({-1, -1, 0});
  }
  return lines;
}

/// Simplifies samples in memory or of a source; checks the bound, soundness and the report.
Simplified simplified(const HeightField& field, SimplifyOptions options) {
  const testing::ArraySource source(field);
  const bool is_streamed = *rc::gen::arbitrary<bool>();
  if (is_streamed) options.quality.order = Order::kAuto;
  auto result = simplify(is_streamed ? testing::with_source(field, source) : field, options);
  RC_ASSERT(result.has_value() || result.error().kind == ErrorKind::kInput);
  RC_PRE(result.has_value());
  const auto judged = measure(field, result->mesh);
  RC_ASSERT(judged.has_value());
  RC_ASSERT(judged->max_error <= *options.goals.max_error * (1 + 1e-9) + 1e-9 || !result->edits.empty());
  RC_ASSERT(judged->uncovered == 0u);
  RC_ASSERT(judged->is_sound());
  RC_ASSERT(result->shape.has_value());
  RC_ASSERT(std::abs(result->shape->min_angle - judged->min_angle) < 1e-6);
  RC_ASSERT(std::abs(result->shape->longest_edge - longest_edge(result->mesh)) < 1e-6);
  std::uint64_t total = 0;
  for (const std::uint64_t count : result->shape->histogram) total += count;
  RC_ASSERT(total == result->mesh.triangle_count());
  return std::move(*result);
}

RC_GTEST_PROP(shape, angles_that_theory_grants_hold_without_an_exception, ()) {
  const Field field = testing::any_field(14);
  HeightField view = field.view();
  view.frame = any_frame(field.rows);
  SimplifyOptions options = any_run();
  options.quality.shape.min_angle = *rc::gen::element(5.0, 15.0, 20.0);
  // A goal of lower priority does not harm angles.
  if (*rc::gen::arbitrary<bool>()) options.quality.shape.min_edge = *rc::gen::element(0.5, 2.0, 5.0);
  const Simplified result = simplified(view, options);
  // Corners of nodata have at least 45 degrees if samples are square.
  const bool has_squares = view.frame.kind == Frame::Kind::kGrid && view.frame.affine[1] == -view.frame.affine[5] &&
                           view.frame.affine[2] == 0 && view.frame.affine[4] == 0;
  RC_CLASSIFY(has_squares);
  if (has_squares) RC_ASSERT(count_below(result.mesh, options.quality.shape.min_angle) == 0u);
  RC_ASSERT(count_below(result.mesh, options.quality.shape.min_angle) <= result.shape->below);
}

RC_GTEST_PROP(shape, edges_are_never_too_long, ()) {
  const Field field = testing::any_field(12);
  HeightField view = field.view();
  view.frame = any_frame(field.rows);
  SimplifyOptions options = any_run();
  options.quality.shape.max_edge = longer_side(view.frame) * *rc::gen::element(0.3, 1.0, 2.5, 7.0);
  if (*rc::gen::arbitrary<bool>()) options.quality.shape.min_angle = 25;
  if (*rc::gen::arbitrary<bool>()) {
    options.features.breaklines.lines = any_two_lines(field);
    options.features.breaklines.affine = {0, 1, 0, 0, 0, 1};
  }
  const Simplified result = simplified(view, options);
  RC_ASSERT(longest_edge(result.mesh) <= *options.quality.shape.max_edge);
}

RC_GTEST_PROP(shape, edges_grow_no_faster_than_asked, ()) {
  const Field field = testing::any_field(20);
  HeightField view = field.view();
  view.frame = any_frame(field.rows);
  SimplifyOptions options = any_run();
  options.quality.shape.grade = *rc::gen::element(0.05, 0.2, 1.0);
  if (*rc::gen::arbitrary<bool>()) options.quality.shape.min_angle = 25;
  // A goal of lower priority does not harm the grade.
  if (*rc::gen::arbitrary<bool>())
    options.quality.shape.min_edge = longer_side(view.frame) * *rc::gen::element(0.7, 2.0, 6.0);
  if (*rc::gen::element(false, false, true)) {
    options.features.breaklines.lines = any_two_lines(field);
    options.features.breaklines.affine = {0, 1, 0, 0, 0, 1};
  }
  const Simplified result = simplified(view, options);
  RC_ASSERT(worst_growth(result.mesh, *options.quality.shape.grade, longer_side(view.frame) / 2) <= 1);
}

RC_GTEST_PROP(shape, it_ends_whatever_is_asked, ()) {
  const Field field = testing::any_field(12);
  SimplifyOptions options = any_run();
  options.quality.shape.min_angle = 33;
  options.features.breaklines.lines = any_two_lines(field);
  options.features.breaklines.affine = {0, 1, 0, 0, 0, 1};
  const Simplified result = simplified(field.view(), options);
  RC_ASSERT(count_below(result.mesh, 33) <= result.shape->below);
  RC_ASSERT(result.shape->forced <= result.shape->below);
}

TEST(shape, lines_that_are_halved_stay_where_they_are) {
  const Field field = testing::random_field(3, 60, 40, testing::Relief::kRidges);
  SimplifyOptions options;
  options.goals.max_error = 5;
  options.run.threads = 1;
  options.output.float32_positions = false;
  options.quality.shape.max_edge = 0.7;
  Line line;
  line.name = "dike";
  line.points = {{3.3, 2.1, 100}, {50.7, 33.9, 160}};
  options.features.breaklines.lines = {line};
  options.features.breaklines.affine = {0, 1, 0, 0, 0, 1};
  const auto result = simplify(field.view(), options);
  ASSERT_TRUE(result.has_value()) << result.error().message;
  // Positions along the line of vertices within 1.5 steps of it at its height.
  std::vector<double> along;
  const double dx = 50.7 - 3.3, dy = 33.9 - 2.1, size = std::hypot(dx, dy);
  for (std::size_t v = 0; v < result->mesh.vertex_count(); ++v) {
    const auto [x, y, z] = result->mesh.vertex(v);
    const double u = x - 3.3, w = field.rows - 1 - y - 2.1, at = (u * dx + w * dy) / size;
    const double off = std::abs(u * dy - w * dx) / size;
    if (off < 1.5 / 256 && at > -0.01 && at < size + 0.01 && std::abs(z - 100 - 60 * at / size) < 0.02)
      along.push_back(at);
  }
  std::sort(along.begin(), along.end());
  ASSERT_GT(along.size(), size / 0.7);
  EXPECT_NEAR(along.front(), 0, 0.01);
  EXPECT_NEAR(along.back(), size, 0.01);
  for (std::size_t k = 1; k < along.size(); ++k) EXPECT_LE(along[k] - along[k - 1], 0.71);
}

TEST(shape, goals_out_of_range_are_refused_in_a_sentence) {
  const Field field = testing::random_field(1, 9, 9, testing::Relief::kRidges);
  const auto refuses = [&](const ShapeGoals& goals, const char* words) {
    SimplifyOptions options;
    options.goals.max_error = 1;
    options.quality.shape = goals;
    const auto result = simplify(field.view(), options);
    ASSERT_FALSE(result.has_value());
    EXPECT_EQ(result.error().kind, ErrorKind::kUsage);
    EXPECT_NE(result.error().message.find(words), std::string::npos) << result.error().message;
  };
  refuses({.min_angle = 34}, "0 … 33");
  refuses({.min_angle = std::nan("")}, "0 … 33");
  refuses({.max_edge = 0.1}, "at least 0.125");
  refuses({.grade = 0}, "above 0");
  refuses({.min_edge = 0}, "above 0");
  refuses({.max_edge = 3, .min_edge = 2}, "at most half of the max edge, that is 1.5");
  SimplifyOptions options;
  options.goals.max_triangles = 1;
  options.quality.shape.min_angle = 20;
  const auto result = simplify(field.view(), options);
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().kind, ErrorKind::kUsage);
  EXPECT_NE(result.error().message.find("the angles and edges alone need"), std::string::npos);
}

/// Edges shorter than this, each once.
std::uint64_t count_shorter(const Mesh& mesh, double least) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  visit_edges(mesh, [&](std::uint32_t v, std::uint32_t w) {
    if (length(mesh, v, w) < least) edges.insert({std::min(v, w), std::max(v, w)});
  });
  return edges.size();
}

/// Any combination of goals, and lines.
void ask_anything(const Field& field, SimplifyOptions& options) {
  ShapeGoals& goals = options.quality.shape;
  goals.min_angle = *rc::gen::element(0.0, 10.0, 20.0, 25.0, 30.0);
  goals.min_edge = *rc::gen::element<std::optional<double>>(std::nullopt, 0.5, 2.0, 3.0);
  goals.max_edge = *rc::gen::element<std::optional<double>>(std::nullopt, 6.0, 9.0);
  goals.grade = *rc::gen::element<std::optional<double>>(std::nullopt, std::nullopt, 0.3);
  RC_PRE(goals.any());
  if (!*rc::gen::arbitrary<bool>()) return;
  options.features.breaklines.lines = any_two_lines(field);
  options.features.breaklines.affine = {0, 1, 0, 0, 0, 1};
}

RC_GTEST_PROP(shape, goals_that_fight_yield_by_their_rank, ()) {
  const Field field = testing::any_field(16);
  SimplifyOptions options = any_run();
  ask_anything(field, options);
  options.output.float32_positions = false;
  const Simplified result = simplified(field.view(), options);
  const ShapeGoals& goals = options.quality.shape;
  const ShapeReport& shape = *result.shape;
  RC_ASSERT(!goals.max_edge || longest_edge(result.mesh) <= *goals.max_edge);
  RC_ASSERT(!goals.grade || worst_growth(result.mesh, *goals.grade, longer_side(grid_frame(field.rows)) / 2) <= 1);
  RC_ASSERT(count_below(result.mesh, goals.min_angle) <= shape.below);
  RC_ASSERT(shape.below <= count_below(result.mesh, goals.min_angle + 2e-4));
  RC_ASSERT(shape.shorter == (goals.min_edge ? count_shorter(result.mesh, *goals.min_edge) : 0));
  RC_ASSERT(shape.forced + shape.below_beside_lines <= shape.below);
  RC_ASSERT(shape.shorter_beside_lines <= shape.shorter);
  if (options.features.breaklines.lines.empty() && goals.min_angle <= 20) RC_ASSERT(shape.below == 0u);
}

RC_GTEST_PROP(shape, more_effort_never_takes_more_triangles, ()) {
  const Field field = testing::any_field(16);
  SimplifyOptions options = any_run();
  ask_anything(field, options);
  std::size_t before = std::numeric_limits<std::size_t>::max();
  for (const Effort effort : {Effort::kNormal, Effort::kHigh, Effort::kMax}) {
    options.quality.effort = effort;
    const auto result = simplify(field.view(), options);
    RC_ASSERT(result.has_value() || result.error().kind == ErrorKind::kInput);
    RC_PRE(result.has_value());
    RC_ASSERT(result->effort == effort);
    RC_ASSERT(result->mesh.triangle_count() <= before);
    before = result->mesh.triangle_count();
    RC_ASSERT(measure(field.view(), result->mesh)->max_error <= *options.goals.max_error || !result->edits.empty());
  }
}

RC_GTEST_PROP(shape, edges_that_are_too_short_are_counted_and_cost_no_promise, ()) {
  const Field field = testing::any_field(30);
  auto options = any_run();
  options.quality.shape.min_edge = *rc::gen::element(0.5, 2.0, 4.0);
  if (*rc::gen::arbitrary<bool>()) options.quality.shape.min_angle = 20;
  if (*rc::gen::arbitrary<bool>()) options.quality.shape.max_edge = 9.0;
  const Simplified result = simplified(field.view(), options);
  RC_ASSERT(result.shape->shorter == count_shorter(result.mesh, *options.quality.shape.min_edge));
}

TEST(shape, vertices_for_angles_and_lengths_make_no_short_edge) {
  // A plane with a peak: the bound needs the peak's foot and top, four samples apart; angles would require more
  // vertices.
  Field field = testing::random_field(1, 81, 81, testing::Relief::kRidges);
  std::fill(field.samples.begin(), field.samples.end(), 0.0f);
  field.samples[40 * 81 + 40] = 10;
  SimplifyOptions options;
  options.goals.max_error = 4;
  options.quality.shape = {.min_angle = 20, .max_edge = 30.0};
  for (const Effort effort : {Effort::kFast, Effort::kNormal, Effort::kHigh}) {
    options.quality.effort = effort;
    options.quality.shape.min_edge = std::nullopt;
    const auto free = *simplify(field.view(), options);
    options.quality.shape.min_edge = 4.0;
    const auto held = *simplify(field.view(), options);
    EXPECT_LE(held.measurement.max_error, 4);
    EXPECT_LE(held.shape->shorter, count_shorter(free.mesh, 4.0));
    EXPECT_LE(held.shape->longest_edge, 30.0);
  }
}

TEST(shape, high_effort_gives_up_short_edges) {
  const Field field = testing::random_field(7, 150, 130, testing::Relief::kRidges);
  SimplifyOptions options;
  options.goals.max_error = 4;
  options.quality.effort = Effort::kNormal;
  const auto normal = *simplify(field.view(), options);
  options.quality.effort = Effort::kHigh;
  const auto free = *simplify(field.view(), options);
  options.quality.shape.min_edge = 3.0;
  const auto held = *simplify(field.view(), options);
  EXPECT_GT(held.shape->shorter, 0u);
  EXPECT_LT(held.shape->shorter, count_shorter(free.mesh, 3.0));
  EXPECT_LT(held.shape->shorter, 0.174 * static_cast<double>(count_shorter(normal.mesh, 3.0)));
}

TEST(shape, budgets_are_met_with_all_angles) {
  const Field field = testing::random_field(5, 60, 50, testing::Relief::kRidges);
  for (const Effort effort : {Effort::kFast, Effort::kNormal, Effort::kHigh}) {
    SimplifyOptions options;
    options.goals.max_triangles = 2500;
    options.quality.shape.min_angle = 20;
    options.quality.effort = effort;
    const auto made = simplify(field.view(), options);
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_LE(made->mesh.triangle_count(), 2500u);
    EXPECT_GE(made->mesh.triangle_count(), 2000u);
    EXPECT_EQ(made->shape->below, 0u);
  }
}

TEST(shape, meshes_that_nobody_could_hold_are_refused_before_they_are_begun) {
  constexpr int kSide = 3201;
  const std::vector<float> flat(std::size_t{kSide} * kSide, 0.0f);
  HeightField field;
  field.samples = flat.data();
  field.cols = field.rows = kSide;
  field.frame = grid_frame(kSide);
  SimplifyOptions options;
  options.goals.max_error = 1;
  options.quality.effort = Effort::kFast;
  options.quality.shape.max_edge = 0.125;
  const auto none = simplify(field, options);
  ASSERT_FALSE(none.has_value());
  EXPECT_EQ(none.error().kind, ErrorKind::kInput);
  EXPECT_NE(none.error().message.find("at least 1513 million triangles"), std::string::npos) << none.error().message;
  options.quality.shape.max_edge = 0.2;
  options.run.memory.limit = 1'000'000'000;
  const auto large = simplify(field, options);
  ASSERT_FALSE(large.has_value());
  EXPECT_EQ(large.error().kind, ErrorKind::kMemory);
  EXPECT_NE(large.error().message.find("at least 591 million triangles"), std::string::npos) << large.error().message;
}

}  // namespace
}  // namespace scarp::shape_laws_test
