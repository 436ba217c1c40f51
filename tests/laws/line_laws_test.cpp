// Laws of breaklines at the public door.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "laws/any_field.h"
#include "scarp/simplify.h"

namespace scarp::line_laws_test {
namespace {

using testing::any_field;
using testing::Field;

/// Walks of any kind, within the raster and beyond, some with heights near those of the raster.
LineConstraints any_lines(const Field& field) {
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  const auto between = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  LineConstraints constraints;
  constraints.affine = grid_frame(field.rows).affine;
  constraints.conflict = *rc::gen::element(LineConflict::kFirst, LineConflict::kMean, LineConflict::kHighest);
  const int count = *rc::gen::inRange(1, 6);
  const bool is_on_samples = *rc::gen::arbitrary<bool>();
  for (int k = 0; k < count; ++k) {
    Line line;
    line.name = "line";
    const bool is_hard = random() % 3 == 0;
    for (auto n = 2 + random() % 5; n > 0; --n) {
      const double reach = random() % 8 == 0 ? 100 : 0.5;
      double x = between(-reach, field.cols + reach), y = between(-reach, field.rows + reach);
      if (is_on_samples) x = std::round(x), y = std::round(y);
      line.points.push_back({x, y, is_hard ? between(-20, 60) : std::numeric_limits<double>::quiet_NaN()});
    }
    constraints.lines.push_back(line);
  }
  return constraints;
}

RC_GTEST_PROP(lines, keep_the_bound_against_the_edited_raster_in_the_eyes_of_the_judge, ()) {
  Field field = any_field(40);
  SimplifyOptions options;
  options.max_error = *rc::gen::element(0.0, 0.5, 1.0, 3.0, 20.0);
  options.effort = *rc::gen::element(Effort::kFast, Effort::kNormal, Effort::kHigh);
  options.order = *rc::gen::element(Order::kAuto, Order::kGreedy);
  options.float32_positions = *rc::gen::arbitrary<bool>();
  options.breaklines = any_lines(field);
  const auto result = simplify(field.view(), options);
  if (!result) {
    RC_ASSERT(result.error().kind == ErrorKind::kInput);
    return;
  }
  for (const SampleEdit& edit : result->edits) {
    float& sample = field.samples[static_cast<std::size_t>(edit.row) * static_cast<std::size_t>(field.cols) +
                                  static_cast<std::size_t>(edit.col)];
    RC_ASSERT(sample == edit.before);
    sample = edit.after;
  }
  const Measurement m = *measure(field.view(), result->mesh);
  RC_ASSERT(m.max_error <= *options.max_error + 1e-9);
  RC_ASSERT(m.uncovered == 0u);
  RC_ASSERT(m.void_cells_covered == 0u);
  RC_ASSERT(m.is_sound());
}

RC_GTEST_PROP(lines, give_the_same_mesh_on_any_number_of_threads, ()) {
  const Field field = any_field(60);
  SimplifyOptions options;
  options.max_error = 2;
  options.effort = *rc::gen::element(Effort::kFast, Effort::kNormal, Effort::kHigh);
  options.breaklines = any_lines(field);
  options.threads = 1;
  const auto one = simplify(field.view(), options);
  options.threads = 3;
  const auto three = simplify(field.view(), options);
  RC_ASSERT(one.has_value() == three.has_value());
  RC_ASSERT(!one || (one->mesh.positions == three->mesh.positions && one->mesh.triangles == three->mesh.triangles));
}

TEST(lines, contradict_budgets_strategies_and_frames) {
  const Field field = testing::random_field(3, 30, 20, testing::Relief::kRidges);
  SimplifyOptions options;
  Line line;
  line.points = {{1, 1, 5}, {20, 10, 5}};
  options.breaklines.lines = {line};
  options.max_error = 1;
  ASSERT_TRUE(simplify(field.view(), options));
  auto with_budget = options;
  with_budget.max_triangles = 50;
  EXPECT_EQ(simplify(field.view(), with_budget).error().kind, ErrorKind::kUsage);
  auto without_error = options;
  without_error.max_error = std::nullopt;
  without_error.max_vertices = 50;
  EXPECT_EQ(simplify(field.view(), without_error).error().kind, ErrorKind::kUsage);
  auto with_edges = options;
  with_edges.edges.data_dependent = true;
  EXPECT_EQ(simplify(field.view(), with_edges).error().kind, ErrorKind::kUsage);
  auto with_outline = options;
  with_outline.outline_tolerance = 1;
  EXPECT_EQ(simplify(field.view(), with_outline).error().kind, ErrorKind::kUsage);
}

}  // namespace
}  // namespace scarp::line_laws_test
