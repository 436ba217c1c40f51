// Laws of compressed GLB: the decoded bytes satisfy the mesh's guarantees.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "laws/any_field.h"
#include "laws/fields.h"
#include "laws/sanitized.h"
#include "scarp/io.h"
#include "scarp/simplify.h"

namespace scarp::glb_laws_test {
namespace {

using testing::any_field;
using testing::Field;

Frame frame_of(int kind, int rows) {
  Frame frame = grid_frame(rows);
  if (kind == 1) frame.affine = {4321987.123, 6.7218131, 0, 5123456.789, 0, -6.7218131};  // no float32 fits
  if (kind == 2) frame.affine = {1000, -30, 0, 500, 0, 92.5};                             // turned by 180 degrees
  if (kind == 3) frame.affine = {0, 20, 10, 0, 10, -20};                                  // rows slant
  return frame;
}

RC_GTEST_PROP(compressed_glb, keeps_the_promise_once_decoded, ()) {
  const Field field = any_field(40);
  HeightField view = field.view();
  view.frame = frame_of(*rc::gen::inRange(0, 4), view.rows);
  SimplifyOptions options;
  const double goal = *rc::gen::element(0.0, 0.01, 0.5, 3.0, 20.0);
  options.goals.max_error = goal;
  options.quality.effort = *rc::gen::element(Effort::kFast, Effort::kNormal, Effort::kHigh);
  options.output.lattice = true;
  options.output.normals = *rc::gen::arbitrary<bool>();
  const auto result = simplify(view, options);
  if (!result) {
    RC_ASSERT(result.error().kind == ErrorKind::kInput || (goal == 0 && view.frame.affine[2] != 0));
    return;
  }
  const auto bytes = encode_glb(result->mesh, {.compress = true, .cell = {view.frame.affine[1], view.frame.affine[5]}});
  RC_ASSERT(bytes.has_value());
  const auto decoded = decode_mesh(*bytes, "x.glb");
  RC_ASSERT(decoded.has_value());
  const Measurement m = *measure(view, *decoded);
  RC_ASSERT(m.max_error <= goal + 1e-9);
  RC_ASSERT(std::abs(m.max_error - result->measurement.max_error) <= 1e-9);
  RC_ASSERT(m.uncovered == 0u);
  RC_ASSERT(m.nodata_cells_covered == 0u);
  RC_ASSERT(m.is_sound());
}

TEST(compressed_glb, heights_have_few_digits_where_an_error_allows_it) {
  const Field field = testing::random_field(5, 60, 50, testing::Relief::kRidges, 0.02);
  SimplifyOptions options;
  options.goals.max_error = 3;
  options.quality.effort = Effort::kHigh;
  options.output.lattice = true;
  const auto result = simplify(field.view(), options);
  ASSERT_TRUE(result) << result.error().message;
  const double step = 1.0 / 64;  // the power of two below 3 / 128
  for (std::size_t i = 2; i < result->mesh.positions.size(); i += 3) {
    const double multiple = result->mesh.positions[i] / step;
    EXPECT_EQ(multiple, std::floor(multiple));
  }
  EXPECT_LE(result->measurement.max_error, 3);
}

}  // namespace
}  // namespace scarp::glb_laws_test
