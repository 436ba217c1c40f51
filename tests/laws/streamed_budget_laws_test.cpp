// Laws of budgets with samples read by strips: the search for an error keeps sufficient budgets.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstdint>

#include "laws/array_source.h"
#include "laws/budgets.h"
#include "laws/fields.h"
#include "scarp/measure.h"
#include "scarp/simplify.h"

namespace scarp::streamed_budget_laws_test {
namespace {

using testing::ArraySource;
using testing::check_budget;
using testing::Field;
using testing::hills;
using testing::Relief;
using testing::with_source;

SimplifyOptions any_budget() {
  SimplifyOptions options;
  const auto budget = *rc::gen::inRange<std::uint64_t>(1, 600);
  if (*rc::gen::arbitrary<bool>()) options.goals.max_vertices = budget;
  if (!options.goals.max_vertices || *rc::gen::arbitrary<bool>()) options.goals.max_triangles = 2 * budget;
  if (*rc::gen::element(false, false, true)) options.goals.max_error = *rc::gen::element(0.0, 0.7, 5.0);
  options.quality.effort = *rc::gen::element(Effort::kFast, Effort::kFast, Effort::kNormal, Effort::kHigh);
  return options;
}

RC_GTEST_PROP(streamed_budgets, are_kept_by_sound_meshes_whatever_the_threads, ()) {
  const Field field = testing::random_field(
      *rc::gen::arbitrary<std::uint32_t>(), *rc::gen::inRange(2, 60), *rc::gen::inRange(2, 60),
      testing::kReliefs[static_cast<std::size_t>(*rc::gen::inRange(0, 5))], *rc::gen::element(0.0, 0.0, 0.05, 0.4));
  const ArraySource source(field.view());
  const HeightField streamed = with_source(field.view(), source);
  SimplifyOptions options = any_budget();
  options.run.threads = 1;
  const auto made = simplify(streamed, options);
  options.run.threads = 3;
  const auto again = simplify(streamed, options);
  RC_ASSERT(made.has_value() == again.has_value());
  if (!made) {
    RC_ASSERT(made.error().message == again.error().message);
    RC_ASSERT(made.error().kind == ErrorKind::kInput || made.error().kind == ErrorKind::kUsage);
    return;
  }
  RC_ASSERT(made->mesh.positions == again->mesh.positions);
  RC_ASSERT(made->mesh.triangles == again->mesh.triangles);
  const Measurement seen = *measure(field.view(), made->mesh);
  check_budget(seen, *made, options);
}

TEST(streamed_budgets, are_used_in_low_strips_with_about_the_error_of_samples_in_memory) {
  const Field field = hills(300, 240);
  const ArraySource source(field.view());
  const HeightField streamed = with_source(field.view(), source);
  for (const Effort effort : {Effort::kFast, Effort::kNormal}) {
    SimplifyOptions options;
    options.goals.max_triangles = 4000;
    options.quality.effort = effort;
    const auto whole = simplify(field.view(), options);
    ASSERT_TRUE(whole) << whole.error().message;
    options.run.memory.limit = 2'500'000;
    const auto made = simplify(streamed, options);
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_LE(made->mesh.triangle_count(), 4000u);
    EXPECT_GE(made->mesh.triangle_count(), 4000u * 97 / 100);
    EXPECT_EQ(made->stop, StopReason::kMaxTriangles);
    EXPECT_EQ(made->passes.front().name, "search");
    EXPECT_LE(made->measurement.max_error, 1.25 * whole->measurement.max_error);
  }
}

TEST(streamed_budgets, that_memory_has_no_room_for_are_refused_for_that) {
  const Field field = testing::random_field(7, 300, 240, Relief::kRidges);
  const ArraySource source(field.view());
  SimplifyOptions options;
  options.goals.max_triangles = 100'000;
  options.quality.effort = Effort::kFast;
  options.run.memory.limit = 2'500'000;
  const auto made = simplify(with_source(field.view(), source), options);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().kind, ErrorKind::kMemory);
  EXPECT_EQ(made.error().message.rfind("the memory limit is too little", 0), 0u) << made.error().message;
}

TEST(streamed_budgets, that_are_too_small_are_refused_with_the_least_that_would_do) {
  const Field field = hills(300, 240);
  const ArraySource source(field.view());
  SimplifyOptions options;
  options.goals.max_triangles = 1;
  const auto made = simplify(with_source(field.view(), source), options);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().message,
            "1 triangle is too few: the outline of the valid data and its strips alone need 2; "
            "allow more");
}

TEST(streamed_budgets, end_with_what_the_source_says_where_it_breaks) {
  const Field field = hills(300, 240);
  const ArraySource source(field.view(), 200);
  SimplifyOptions options;
  options.goals.max_triangles = 100;
  const auto made = simplify(with_source(field.view(), source), options);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().kind, ErrorKind::kInput);
  EXPECT_EQ(made.error().message, "row 200 is broken");
}

}  // namespace
}  // namespace scarp::streamed_budget_laws_test
