// Laws of budgets with lines: sufficient budgets are satisfied, errors name insufficient ones, and every mesh is that
// of some max error.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "laws/any_field.h"
#include "laws/any_lines.h"
#include "laws/budgets.h"
#include "scarp/simplify.h"

namespace scarp::line_budget_laws_test {
namespace {

using testing::any_field;
using testing::any_lines;
using testing::check_budget;
using testing::Field;
using testing::hills;
using testing::is_within;

/// Lines, polygons or both, and a budget that may be too small.
SimplifyOptions any_lines_and_budget(const Field& field) {
  SimplifyOptions options;
  options.features.breaklines = any_lines(field);
  if (*rc::gen::inRange(0, 3) == 0) {
    LineConstraints rings = any_lines(field);
    options.features.cutline.affine = rings.affine;
    for (std::uint32_t k = 0; k < rings.lines.size(); ++k) {
      Line& ring = rings.lines[k];
      ring.role = LineRole::kOuter;
      ring.polygon = k;
      ring.points.push_back(ring.points.front());
      if (ring.points.size() >= 4) options.features.cutline.rings.push_back(ring);
    }
    if (!options.features.cutline.rings.empty() && *rc::gen::arbitrary<bool>())
      options.features.breaklines.lines.clear();
  }
  const auto budget = *rc::gen::inRange<std::uint64_t>(2, 500);
  if (*rc::gen::arbitrary<bool>()) options.goals.max_vertices = budget;
  if (!options.goals.max_vertices || *rc::gen::arbitrary<bool>()) options.goals.max_triangles = 2 * budget;
  if (*rc::gen::element(false, false, true)) options.goals.max_error = *rc::gen::element(0.0, 0.7, 5.0);
  options.quality.effort = Effort::kFast;
  return options;
}

Field edited(Field field, const Simplified& made) {
  for (const SampleEdit& edit : made.edits)
    field.samples[static_cast<std::size_t>(edit.row) * static_cast<std::size_t>(field.cols) +
                  static_cast<std::size_t>(edit.col)] = edit.after;
  return field;
}

/// The sufficient number according to the message.
std::uint64_t needed(const std::string& sentence) {
  const auto at = sentence.find(" need ");
  return at == std::string::npos ? 0 : std::stoull(sentence.substr(at + 6));
}

RC_GTEST_PROP(line_budget, is_kept_and_the_mesh_is_that_of_the_error_it_was_made_for, ()) {
  const Field field = any_field(30);
  const SimplifyOptions options = any_lines_and_budget(field);
  const auto made = simplify(field.view(), options);
  if (!made) {
    RC_ASSERT(made.error().kind == ErrorKind::kInput || made.error().kind == ErrorKind::kUsage);
    return;
  }
  MeasureOptions judging;
  if (!options.features.cutline.rings.empty()) judging.cutline = &options.features.cutline;
  const Measurement seen = *measure(edited(field, *made).view(), made->mesh, judging);
  check_budget(seen, *made, options);
  RC_ASSERT(seen.max_error <= made->lines_for + 1e-9);
  SimplifyOptions towards_error = options;
  towards_error.goals.max_triangles = towards_error.goals.max_vertices = std::nullopt;
  towards_error.goals.max_error = made->lines_for;
  const auto again = simplify(field.view(), towards_error);
  RC_ASSERT(again.has_value());
  RC_ASSERT(again->mesh.positions == made->mesh.positions);
  RC_ASSERT(again->mesh.triangles == made->mesh.triangles);
}

RC_GTEST_PROP(line_budget, that_is_too_small_is_refused_with_the_least_that_will_do, ()) {
  const Field field = any_field(30);
  SimplifyOptions options = any_lines_and_budget(field);
  options.goals.max_triangles = std::nullopt;
  options.goals.max_vertices = 1;
  const auto none = simplify(field.view(), options);
  RC_ASSERT(!none.has_value());
  if (none.error().kind == ErrorKind::kInput) return;
  RC_ASSERT(none.error().kind == ErrorKind::kUsage);
  const std::uint64_t least = needed(none.error().message);
  RC_ASSERT(least >= 3u);
  options.goals.max_vertices = least - 1;
  RC_ASSERT(!simplify(field.view(), options).has_value());
  options.goals.max_vertices = least;
  const auto made = simplify(field.view(), options);
  RC_ASSERT(made.has_value());
  RC_ASSERT(made->mesh.vertex_count() == least);
}

RC_GTEST_PROP(line_budget, effort_never_has_the_larger_error, ()) {
  const Field field = any_field(30);
  SimplifyOptions options = any_lines_and_budget(field);
  const auto fast = simplify(field.view(), options);
  options.quality.effort = *rc::gen::element(Effort::kNormal, Effort::kHigh);
  const auto made = simplify(field.view(), options);
  RC_ASSERT(made.has_value() == fast.has_value());
  if (!made) {
    RC_ASSERT(made.error().message == fast.error().message);
    return;
  }
  RC_ASSERT(is_within(*made, options));
  const bool is_exact = fast->stop == StopReason::kMaxError || fast->stop == StopReason::kExact;
  if (is_exact) RC_ASSERT(made->mesh.triangle_count() <= fast->mesh.triangle_count());
  if (is_exact) RC_ASSERT(made->stop == fast->stop);
  if (!is_exact && made->stop != StopReason::kMaxError)
    RC_ASSERT(made->measurement.max_error <= fast->measurement.max_error);
}

RC_GTEST_PROP(line_budget, threads_change_nothing, ()) {
  const Field field = any_field(40);
  SimplifyOptions options = any_lines_and_budget(field);
  options.quality.effort = *rc::gen::element(Effort::kFast, Effort::kNormal);
  options.run.threads = 1;
  const auto one = simplify(field.view(), options);
  options.run.threads = 3;
  const auto three = simplify(field.view(), options);
  RC_ASSERT(one.has_value() == three.has_value());
  if (!one) return;
  RC_ASSERT(one->mesh.positions == three->mesh.positions);
  RC_ASSERT(one->mesh.triangles == three->mesh.triangles);
}

TEST(line_budget, is_used_where_triangles_grow_smoothly) {
  const Field field = hills(200, 150);
  SimplifyOptions options;
  options.features.breaklines.affine = grid_frame(field.rows).affine;
  Line line;
  line.points = {{10.3, 5.5, NAN}, {150.2, 120.7, NAN}, {190.4, 11.6, NAN}};
  options.features.breaklines.lines = {line};
  for (const std::uint64_t budget : {500u, 1000u, 5000u}) {
    options.goals.max_triangles = budget;
    for (const Effort effort : {Effort::kFast, Effort::kNormal}) {
      options.quality.effort = effort;
      const auto made = simplify(field.view(), options);
      ASSERT_TRUE(made) << made.error().message;
      EXPECT_GE(made->mesh.triangle_count(), 97 * budget / 100);
      EXPECT_EQ(made->stop, StopReason::kMaxTriangles);
      EXPECT_EQ(made->passes.front().name, "search");
      EXPECT_EQ(made->lines_inserted, 1u);
    }
  }
}

TEST(line_budget, fits_features_to_the_error_of_the_mesh) {
  const Field field = testing::random_field(5, 60, 50, testing::Relief::kRidges);
  SimplifyOptions options;
  options.goals.max_vertices = 200;
  options.quality.effort = Effort::kFast;
  options.features.ridges = RidgeGoals{1, true};
  const auto made = simplify(field.view(), options);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_LE(made->mesh.vertex_count(), 200u);
  const auto fitted = fit_features(field.view(), options.features, {made->lines_for});
  ASSERT_TRUE(fitted);
  ASSERT_GT(fitted->lines.lines.size(), 0u);
  ASSERT_EQ(made->features.lines.lines.size(), fitted->lines.lines.size());
  for (std::size_t k = 0; k < fitted->lines.lines.size(); ++k) {
    const auto &is = made->features.lines.lines[k].points, &was = fitted->lines.lines[k].points;
    ASSERT_EQ(is.size(), was.size()) << k;
    for (std::size_t i = 0; i < is.size(); ++i) {
      EXPECT_EQ(is[i][0], was[i][0]);
      EXPECT_EQ(is[i][1], was[i][1]);
    }
  }
}

}  // namespace
}  // namespace scarp::line_budget_laws_test
