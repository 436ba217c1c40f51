// Budgets with effort: the search for the error, on real meshes and on invented counts of triangles.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <functional>

#include "laws/any_field.h"
#include "laws/budgets.h"
#include "laws/fields.h"
#include "scarp/simplify.h"
#include "simplify/budget_search.h"

namespace scarp::budget_search_laws_test {
namespace {

using testing::any_field;
using testing::check_budget;
using testing::Field;
using testing::hills;
using testing::Relief;

SimplifyOptions any_budget() {
  SimplifyOptions options;
  const auto budget = *rc::gen::inRange<std::uint64_t>(2, 400);
  if (*rc::gen::arbitrary<bool>()) options.goals.max_vertices = budget;
  if (!options.goals.max_vertices || *rc::gen::arbitrary<bool>()) options.goals.max_triangles = 2 * budget;
  if (*rc::gen::element(false, false, true)) options.goals.max_error = *rc::gen::element(0.0, 0.7, 5.0);
  return options;
}

RC_GTEST_PROP(budget_search, budgets_are_kept_and_greedy_insertion_is_never_better, ()) {
  const Field field = any_field(40);
  SimplifyOptions options = any_budget();
  options.quality.effort = Effort::kFast;
  const auto greedy = simplify(field.view(), options);
  options.quality.effort = *rc::gen::element(Effort::kNormal, Effort::kHigh);
  options.goals.objective = *rc::gen::element(Objective::kMax, Objective::kRms);
  const auto made = simplify(field.view(), options);
  RC_ASSERT(made.has_value() == greedy.has_value());
  if (!made) {
    RC_ASSERT(made.error().kind == greedy.error().kind);
    RC_ASSERT(made.error().message == greedy.error().message);
    return;
  }
  const Measurement seen = *measure(field.view(), made->mesh);
  check_budget(seen, *made, options);
  if (greedy->stop == StopReason::kMaxError || greedy->stop == StopReason::kExact) {
    RC_ASSERT(made->stop == greedy->stop);
    // For the squared error, the max error is only a cap, and the whole budget is useful.
    const bool is_no_worse = options.goals.objective == Objective::kMax
                                 ? made->mesh.triangle_count() <= greedy->mesh.triangle_count()
                                 : seen.rmse <= greedy->measurement.rmse;
    RC_ASSERT(is_no_worse);
  } else if (made->stop != StopReason::kMaxError && options.goals.objective == Objective::kMax) {
    RC_ASSERT(seen.max_error <= greedy->measurement.max_error);
  } else if (made->stop != StopReason::kMaxError) {
    RC_ASSERT(seen.rmse <= greedy->measurement.rmse);
  }
}

RC_GTEST_PROP(budget_search, threads_change_nothing, ()) {
  const Field field = any_field(40);
  SimplifyOptions options = any_budget();
  options.quality.effort = *rc::gen::element(Effort::kNormal, Effort::kHigh);
  options.goals.objective = *rc::gen::element(Objective::kMax, Objective::kRms);
  options.run.threads = 1;
  const auto first = simplify(field.view(), options);
  RC_PRE(first.has_value());
  for (const int threads : {2, 5}) {
    options.run.threads = threads;
    const auto again = simplify(field.view(), options);
    RC_ASSERT(again.has_value());
    RC_ASSERT(again->mesh.positions == first->mesh.positions);
    RC_ASSERT(again->mesh.triangles == first->mesh.triangles);
    RC_ASSERT(again->stop == first->stop);
  }
}

TEST(budget_search, uses_the_budget_and_lowers_the_error_of_greedy_insertion) {
  const Field field = hills(200, 150);
  for (const std::uint64_t budget : {300u, 1000u, 3000u}) {
    const auto greedy =
        *simplify(field.view(), {.goals = {.max_triangles = budget}, .quality = {.effort = Effort::kFast}});
    const auto normal =
        *simplify(field.view(), {.goals = {.max_triangles = budget}, .quality = {.effort = Effort::kNormal}});
    const auto high =
        *simplify(field.view(), {.goals = {.max_triangles = budget}, .quality = {.effort = Effort::kHigh}});
    EXPECT_LT(normal.measurement.max_error, 0.85 * greedy.measurement.max_error) << budget;
    EXPECT_LT(high.measurement.max_error, 0.95 * normal.measurement.max_error) << budget;
    for (const Simplified* made : {&normal, &high}) {
      EXPECT_GE(made->mesh.triangle_count(), 97 * budget / 100);
      EXPECT_EQ(made->stop, StopReason::kMaxTriangles);
      EXPECT_EQ(made->passes.front().name, "search");
    }
  }
}

TEST(budget_search, a_much_larger_budget_never_has_a_larger_error) {
  for (const Relief relief : testing::kReliefs) {
    const Field field = testing::random_field(3, 50, 40, relief);
    double last = std::numeric_limits<double>::infinity();
    for (std::uint64_t budget = 20; budget < 10000; budget *= 4) {
      const auto made =
          simplify(field.view(), {.goals = {.max_vertices = budget}, .quality = {.effort = Effort::kHigh}});
      ASSERT_TRUE(made) << made.error().message;
      EXPECT_LE(made->measurement.max_error, last) << budget;
      last = made->measurement.max_error;
    }
  }
}

TEST(budget_search, a_bound_that_fits_is_the_goal) {
  const Field field = testing::random_field(3, 60, 60, Relief::kRidges);
  const auto bounded = *simplify(field.view(), {.goals = {.max_error = 30.0}, .quality = {.effort = Effort::kHigh}});
  // Fewer triangles than greedy insertion needs, so that a search is necessary.
  const std::uint64_t budget = bounded.mesh.triangle_count() * 11 / 10;
  ASSERT_LT(budget, simplify(field.view(), {.max_error = 30.0})->mesh.triangle_count());
  const auto made = *simplify(
      field.view(), {.goals = {.max_error = 30.0, .max_triangles = budget}, .quality = {.effort = Effort::kHigh}});
  EXPECT_EQ(made.stop, StopReason::kMaxError);
  EXPECT_EQ(made.mesh.positions, bounded.mesh.positions);
}

TEST(budget_search, a_squared_error_is_not_given_up_for_fewer_triangles) {
  // Greedy insertion reaches the max error with the last triangle of the budget; efforts reach it with fewer.
  const Field field = testing::random_field(3, 5, 18, Relief::kReal);
  SimplifyOptions options{.goals = {.max_error = 5.0, .max_triangles = 118}, .quality = {.effort = Effort::kFast}};
  const auto greedy = *simplify(field.view(), options);
  ASSERT_EQ(greedy.stop, StopReason::kMaxError);
  for (const Effort effort : {Effort::kNormal, Effort::kHigh}) {
    options.quality.effort = effort;
    options.goals.objective = Objective::kMax;
    EXPECT_LT(simplify(field.view(), options)->mesh.triangle_count(), greedy.mesh.triangle_count());
    options.goals.objective = Objective::kRms;
    const auto made = *simplify(field.view(), options);
    EXPECT_LE(made.measurement.rmse, greedy.measurement.rmse);
    EXPECT_LE(made.measurement.max_error, 5);
    EXPECT_EQ(made.stop, StopReason::kMaxError);
  }
}

TEST(budget_search, ends_with_its_time_and_the_best_mesh_so_far) {
  const Field field = testing::random_field(3, 60, 60, Relief::kRidges);
  const auto with = [&](const std::function<bool()>& is_time_up) {
    SimplifyOptions options{.goals = {.max_triangles = 1500}, .quality = {.effort = Effort::kHigh}};
    options.run.is_time_up = is_time_up;
    return *simplify(field.view(), options);
  };
  int asked = 0;
  const Simplified whole = with({}), waited = with([] { return false; }), cut = with([] { return true; });
  const Simplified late = with([&] { return ++asked > 3000; });
  EXPECT_EQ(waited.mesh.positions, whole.mesh.positions);
  EXPECT_FALSE(waited.is_cut_short);
  EXPECT_TRUE(cut.is_cut_short);
  EXPECT_EQ(
      cut.mesh.triangles,
      simplify(field.view(), {.goals = {.max_triangles = 1500}, .quality = {.effort = Effort::kFast}})->mesh.triangles);
  EXPECT_LE(late.mesh.triangle_count(), 1500u);
  EXPECT_LE(late.measurement.max_error, cut.measurement.max_error);
}

TEST(budget_search, refuses_what_no_search_can_serve) {
  const Field field = testing::random_field(3, 30, 30, Relief::kReal);
  const auto kind = [&](const SimplifyOptions& options) { return simplify(field.view(), options).error().kind; };
  EXPECT_EQ(kind({.goals = {.max_triangles = 1}, .quality = {.effort = Effort::kHigh}}), ErrorKind::kUsage);
  EXPECT_EQ(kind({.goals = {.max_error = 1, .objective = Objective::kRms}, .quality = {.effort = Effort::kHigh}}),
            ErrorKind::kUsage);
  EXPECT_EQ(kind({.goals = {.max_triangles = 99, .objective = Objective::kRms}}), ErrorKind::kUsage);
}

TEST(budget_search, is_told_as_one_pass_and_can_be_cancelled) {
  const Field field = hills(200, 150);
  SimplifyOptions options{.goals = {.max_triangles = 1000}, .quality = {.effort = Effort::kHigh}};
  double last = 0;
  int calls = 0;
  options.run.progress = [&](const Progress& progress) {
    EXPECT_EQ(progress.pass, "search");
    EXPECT_GE(progress.fraction, last);
    last = progress.fraction;
    return ++calls < 1000;
  };
  ASSERT_TRUE(simplify(field.view(), options));
  EXPECT_GT(calls, 3);
  for (const int allowed : {0, 1, 2, 3}) {
    calls = 0;
    options.run.progress = [&](const Progress&) { return calls++ < allowed; };
    const auto cancelled = simplify(field.view(), options);
    ASSERT_FALSE(cancelled);
    EXPECT_EQ(cancelled.error().kind, ErrorKind::kCancelled);
  }
}

/// Invented runs: a bound needs a number of triangles, with effort `share` of that; budgets use all.
struct MadeUp {
  std::function<double(double error)> triangles;
  double share = 0.42;
  double least = 0;  // bounds below it cannot be kept
  int runs = 0;      // with effort

  Result<Simplified> operator()(const SimplifyOptions& options, const pieces::Scale& scale) {
    const bool has_effort = !scale.refines_only;
    runs += has_effort ? 1 : 0;
    double error = options.goals.max_error.value_or(0);
    Simplified made;
    if (options.goals.max_triangles) {
      error = 1e6;
      while (triangles(0.999 * error) <= static_cast<double>(*options.goals.max_triangles)) error *= 0.999;
      made.stop = StopReason::kMaxTriangles;
    }
    if (error < least) return fail(ErrorKind::kPromise, "too small");
    made.mesh.triangles.resize(3 * static_cast<std::size_t>((has_effort ? share : 1) * triangles(error)));
    made.measurement.samples = 1000000;
    made.judged_max_error = made.judged_rmse = error;
    return made;
  }
};

TEST(budget_search, takes_few_runs_where_triangles_follow_a_power) {
  for (const double power : {0.8, 1.0, 1.3, 2.0}) {
    for (const double share : {0.25, 0.42, 0.7}) {
      MadeUp made_up{[&](double error) { return 1e6 * std::pow(error, -power); }, share};
      const SimplifyOptions options{.goals = {.max_triangles = 50000}};
      const auto found =
          *run::search_budget(options, {.run = std::ref(made_up), .traits = pieces::traits_of(Effort::kHigh)});
      EXPECT_GE(found.mesh.triangle_count(), 49500u) << power << " " << share;
      EXPECT_LE(found.mesh.triangle_count(), 50000u) << power << " " << share;
      EXPECT_LE(made_up.runs, 4) << power << " " << share;
    }
  }
}

TEST(budget_search, stops_where_triangles_jump_over_the_budget) {
  // 10,000 triangles for an error of 1 or more, far too many below.
  MadeUp made_up{[](double error) { return error >= 1 ? 20000 + 30000 / error : 1e6; }};
  const SimplifyOptions options{.goals = {.max_triangles = 50000}};
  const auto found =
      *run::search_budget(options, {.run = std::ref(made_up), .traits = pieces::traits_of(Effort::kHigh)});
  EXPECT_LE(found.judged_max_error, 1.05);
  EXPECT_LE(made_up.runs, run::kMostRuns);
}

TEST(budget_search, goes_around_bounds_that_cannot_be_kept) {
  MadeUp made_up{[](double error) { return 1e5 / error; }, 0.42, 0.9};
  const SimplifyOptions options{.goals = {.max_triangles = 100000}};
  const auto found =
      *run::search_budget(options, {.run = std::ref(made_up), .traits = pieces::traits_of(Effort::kHigh)});
  EXPECT_LE(found.judged_max_error, 0.95);
  EXPECT_GE(found.judged_max_error, 0.9);
  EXPECT_LE(made_up.runs, run::kMostRuns);
}

}  // namespace
}  // namespace scarp::budget_search_laws_test
