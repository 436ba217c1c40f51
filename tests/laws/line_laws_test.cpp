// Laws of breaklines in the public interface.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "laws/any_field.h"
#include "laws/any_lines.h"
#include "scarp/simplify.h"

namespace scarp::line_laws_test {
namespace {

using testing::any_field;
using testing::any_lines;
using testing::Field;

RC_GTEST_PROP(lines, keep_the_bound_against_the_edited_raster_in_the_eyes_of_the_judge, ()) {
  Field field = any_field(40);
  SimplifyOptions options;
  options.goals.max_error = *rc::gen::element(0.0, 0.5, 1.0, 3.0, 20.0);
  options.quality.effort = *rc::gen::element(Effort::kFast, Effort::kNormal, Effort::kHigh);
  options.quality.order = *rc::gen::element(Order::kAuto, Order::kGreedy);
  options.output.float32_positions = *rc::gen::arbitrary<bool>();
  options.features.breaklines = any_lines(field);
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
  RC_ASSERT(m.max_error <= *options.goals.max_error + 1e-9);
  RC_ASSERT(m.uncovered == 0u);
  RC_ASSERT(m.nodata_cells_covered == 0u);
  RC_ASSERT(m.is_sound());
}

RC_GTEST_PROP(lines, give_the_same_mesh_on_any_number_of_threads, ()) {
  const Field field = any_field(60);
  SimplifyOptions options;
  options.goals.max_error = 2;
  options.quality.effort = *rc::gen::element(Effort::kFast, Effort::kNormal, Effort::kHigh);
  options.features.breaklines = any_lines(field);
  options.run.threads = 1;
  const auto one = simplify(field.view(), options);
  options.run.threads = 3;
  const auto three = simplify(field.view(), options);
  RC_ASSERT(one.has_value() == three.has_value());
  if (!one) return;
  RC_ASSERT(one->mesh.positions == three->mesh.positions);
  RC_ASSERT(one->mesh.triangles == three->mesh.triangles);
}

TEST(lines, contradict_edges_of_the_data_and_simpler_outlines) {
  const Field field = testing::random_field(3, 30, 20, testing::Relief::kRidges);
  SimplifyOptions options;
  Line line;
  line.points = {{1, 1, 5}, {20, 10, 5}};
  options.features.breaklines.lines = {line};
  options.goals.max_error = 1;
  ASSERT_TRUE(simplify(field.view(), options));
  auto with_outline = options;
  with_outline.domain.outline_tolerance = 1;
  EXPECT_EQ(simplify(field.view(), with_outline).error().kind, ErrorKind::kUsage);
}

}  // namespace
}  // namespace scarp::line_laws_test
