// Efforts in the public interface beyond heights on the exact outline: channels, simplified outlines.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <vector>

#include "laws/any_field.h"
#include "laws/fields.h"
#include "laws/sanitized.h"
#include "laws/strategies.h"
#include "scarp/simplify.h"

namespace scarp::effort_beyond_heights_laws_test {
namespace {

using testing::any_field;
using testing::Field;
using testing::Relief;

/// Heights and their channels.
struct Coloured {
  Field heights;
  std::vector<Field> layers;
  std::vector<double> scales;
  double height_scale = 1;

  HeightField view() const {
    HeightField view = heights.view();
    view.height_scale = height_scale;
    for (std::size_t k = 0; k < layers.size(); ++k) view.channels.push_back({layers[k].samples.data(), scales[k]});
    return view;
  }
};

Coloured any_coloured(std::int32_t largest) {
  Coloured made{any_field(largest), {}, {}, *rc::gen::element(1.0, 1.0, 0.0, 2.0, 0.25)};
  // No channels: only heights, with a different weight.
  const auto count = *rc::gen::inRange(made.height_scale == 1 || made.height_scale == 0 ? 1 : 0, 4);
  for (int k = 0; k < count; ++k) {
    made.layers.push_back(testing::random_field(*rc::gen::arbitrary<std::uint32_t>(), made.heights.cols,
                                                made.heights.rows,
                                                *rc::gen::element(Relief::kTies, Relief::kFlat, Relief::kRidges)));
    made.scales.push_back(k == 0 ? *rc::gen::element(0.5, 1.0, 3.0) : *rc::gen::element(0.0, 1.0));
  }
  return made;
}

/// Norm of a sample by brute force; NaN if uncovered.
double norm_at(const Mesh& mesh, const HeightField& view, Norm norm, int col, int row) {
  double sum = 0, squares = 0, largest = 0;
  for (int k = -1; k < static_cast<int>(view.channels.size()); ++k) {
    const double scale = k < 0 ? view.height_scale : view.channels[static_cast<std::size_t>(k)].scale;
    const double error = scale * testing::error_at(mesh, view, col, row, k);
    if (std::isnan(error)) return NAN;
    sum += error;
    squares += error * error;
    largest = std::max(largest, error);
  }
  return norm == Norm::kSum ? sum : norm == Norm::kSquares ? std::sqrt(squares) : largest;
}

/// Checks by brute force that all samples are covered and within the bound.
void expect_norm(const Simplified& made, const HeightField& view, const Goals& goals) {
  RC_ASSERT(made.measurement.uncovered == 0u);
  RC_ASSERT(measure(view, made.mesh)->is_sound());
  for (int row = 0; row < view.rows; ++row) {
    for (int col = 0; col < view.cols; ++col) {
      if (std::isnan(testing::error_at(made.mesh, view, col, row))) continue;
      RC_ASSERT(norm_at(made.mesh, view, goals.norm, col, row) <= *goals.max_error * (1 + 1e-9) + 1e-9);
    }
  }
}

bool is_same_mesh(const Simplified& a, const Simplified& b) {
  return a.mesh.positions == b.mesh.positions && a.mesh.triangles == b.mesh.triangles &&
         a.mesh.channels == b.mesh.channels;
}

RC_GTEST_PROP(channels_of_efforts, keep_their_norm_with_no_more_triangles_on_any_number_of_threads, ()) {
  const Coloured coloured = any_coloured(18);
  const HeightField view = coloured.view();
  SimplifyOptions options;
  options.goals.norm = *rc::gen::element(Norm::kSum, Norm::kSquares, Norm::kMax);
  options.goals.max_error = *rc::gen::element(0.0, 1.0, 2.0, 7.0, 40.0);
  options.quality.effort = Effort::kFast;
  options.run.threads = 1;
  const auto fast = simplify(view, options);
  RC_PRE(fast.has_value());
  options.quality.effort = *rc::gen::element(Effort::kNormal, Effort::kHigh, Effort::kMax);
  const auto made = simplify(view, options);
  RC_ASSERT(made.has_value());
  RC_ASSERT(made->vertices == Vertices::kSamples);
  RC_ASSERT(made->mesh.triangle_count() <= fast->mesh.triangle_count());
  RC_ASSERT(made->combined_max_error <= *options.goals.max_error * (1 + 1e-6));
  expect_norm(*made, view, options.goals);
  for (const int threads : {2, 4}) {
    options.run.threads = threads;
    RC_ASSERT(is_same_mesh(*simplify(view, options), *made));
  }
}

/// Columns [first, end).
Coloured columns(const Coloured& whole, std::int32_t first, std::int32_t end) {
  const auto cut = [&](const Field& field) {
    Field part{end - first, field.rows, {}};
    for (std::int32_t y = 0; y < field.rows; ++y)
      part.samples.insert(part.samples.end(), field.raster().row(y) + first, field.raster().row(y) + end);
    return part;
  };
  Coloured part{cut(whole.heights), {}, whole.scales, whole.height_scale};
  for (const Field& layer : whole.layers) part.layers.push_back(cut(layer));
  return part;
}

/// Height and channels of the vertices at column x, by row from the bottom.
std::map<double, std::vector<double>> values_on(const Mesh& mesh, double x) {
  std::map<double, std::vector<double>> found;
  const auto count = static_cast<std::size_t>(mesh.channel_count);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.vertex(v)[0] != x) continue;
    std::vector<double>& values = found[mesh.vertex(v)[1]];
    values.push_back(mesh.vertex(v)[2]);
    for (std::size_t k = 0; k < count; ++k) values.push_back(mesh.channels[count * v + k]);
  }
  return found;
}

RC_GTEST_PROP(channels_of_efforts, keep_their_norm_within_a_locked_border_that_neighbours_share, ()) {
  const Coloured whole = any_coloured(18);
  RC_PRE(whole.heights.cols > 2);
  const auto at = *rc::gen::inRange(1, whole.heights.cols - 1);
  const Coloured sides[] = {columns(whole, 0, at + 1), columns(whole, at, whole.heights.cols)};
  SimplifyOptions options;
  options.goals.norm = *rc::gen::element(Norm::kSum, Norm::kSquares, Norm::kMax);
  options.goals.max_error = *rc::gen::element(0.0, 1.0, 2.0, 7.0, 40.0);
  options.domain.border.is_locked = true;
  std::map<double, std::vector<double>> shared[2];
  for (int side = 0; side < 2; ++side) {
    const HeightField view = sides[side].view();
    options.quality.effort = *rc::gen::element(Effort::kFast, Effort::kNormal, Effort::kHigh);
    const auto made = simplify(view, options);
    if (!made) {
      RC_LOG() << made.error().message;
      RC_ASSERT(made.error().kind == ErrorKind::kInput);  // no surface
      return;
    }
    expect_norm(*made, view, options.goals);
    shared[side] = values_on(made->mesh, side == 0 ? at : 0);
  }
  const std::vector<float>& heights = whole.heights.samples;
  // Outlines of voids may have corners on the border that the neighbour does not need.
  if (std::none_of(heights.begin(), heights.end(), [](float z) { return std::isnan(z); }))
    RC_ASSERT(shared[0] == shared[1]);
}

RC_GTEST_PROP(channels_of_efforts, keep_bounds_of_samples, ()) {
  const Coloured coloured = any_coloured(18);
  const HeightField view = coloured.view();
  const float levels[] = {1, 1.5f, 8, 0, 300, std::numeric_limits<float>::infinity()};
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  std::vector<float> bounds, mask;
  for (std::size_t i = 0; i < coloured.heights.samples.size(); ++i) bounds.push_back(levels[random() % 6]);
  SimplifyOptions options;
  options.goals.norm = *rc::gen::element(Norm::kSum, Norm::kSquares, Norm::kMax);
  options.quality.effort = *rc::gen::element(Effort::kNormal, Effort::kHigh);
  if (*rc::gen::arbitrary<bool>()) {
    options.tolerances.values = bounds;
  } else {
    options.goals.max_error = 3;
    for (float& bound : bounds) {
      mask.push_back(bound > 0 ? 3 / bound : 4);
      bound = 3 / mask.back();
    }
    options.tolerances.weights = mask;
  }
  const auto made = simplify(view, options);
  RC_PRE(made.has_value());
  for (int row = 0; row < view.rows; ++row) {
    for (int col = 0; col < view.cols; ++col) {
      const double norm = norm_at(made->mesh, view, options.goals.norm, col, row);
      const double bound = bounds[static_cast<std::size_t>(row * view.cols + col)];
      RC_ASSERT(std::isnan(norm) || norm <= bound * (1 + 1e-6) + 1e-9);
    }
  }
}

RC_GTEST_PROP(channels_of_efforts, spend_budgets_on_their_norm, ()) {
  const Coloured coloured = any_coloured(30);
  const HeightField view = coloured.view();
  SimplifyOptions options;
  options.goals.norm = *rc::gen::element(Norm::kSum, Norm::kSquares, Norm::kMax);
  options.goals.max_triangles = *rc::gen::inRange<std::uint64_t>(4, 600);
  options.quality.effort = Effort::kFast;
  const auto greedy = simplify(view, options);
  options.quality.effort = *rc::gen::element(Effort::kNormal, Effort::kHigh);
  options.goals.objective = *rc::gen::element(Objective::kMax, Objective::kRms);
  const auto made = simplify(view, options);
  RC_ASSERT(made.has_value() == greedy.has_value());
  RC_PRE(made.has_value());
  RC_ASSERT(made->mesh.triangle_count() <= *options.goals.max_triangles);
  if (options.goals.objective == Objective::kMax) {
    RC_ASSERT(made->combined_max_error <= greedy->combined_max_error * (1 + 1e-6));
  } else {
    RC_ASSERT(made->combined_rmse <= greedy->combined_rmse * (1 + 1e-6));
  }
}

TEST(channels_of_efforts, take_fewer_triangles_with_each_level) {
  const int cols = testing::fewer(300), rows = testing::fewer(200);
  Coloured coloured{testing::random_field(21, cols, rows, Relief::kRidges, 0.02), {}, {}, 1};
  for (std::uint32_t k = 0; k < 3; ++k) {
    coloured.layers.push_back(testing::random_field(21 + k, cols, rows, Relief::kRidges));
    coloured.scales.push_back(0.5);
  }
  for (const Norm norm : {Norm::kSum, Norm::kSquares, Norm::kMax}) {
    std::size_t before = SIZE_MAX;
    for (const Effort effort : {Effort::kFast, Effort::kAuto, Effort::kHigh, Effort::kMax}) {
      if (testing::kIsSanitized && effort == Effort::kMax) continue;
      SimplifyOptions options;
      options.goals.norm = norm;
      options.goals.max_error = 20;
      options.quality.effort = effort;
      const auto made = simplify(coloured.view(), options);
      ASSERT_TRUE(made) << made.error().message;
      EXPECT_EQ(made->effort, effort == Effort::kAuto ? Effort::kNormal : effort);
      EXPECT_LT(static_cast<double>(made->mesh.triangle_count()), 0.97 * static_cast<double>(before));
      before = made->mesh.triangle_count();
    }
  }
}

TEST(channels_of_efforts, refuse_free_vertices) {
  Coloured coloured{testing::random_field(21, 30, 20, Relief::kRidges), {}, {}, 1};
  coloured.layers.push_back(coloured.heights);
  coloured.scales.push_back(1);
  SimplifyOptions options;
  options.goals.max_error = 1;
  options.quality.effort = Effort::kHigh;
  options.quality.vertices = Vertices::kFree;
  const auto made = simplify(coloured.view(), options);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().kind, ErrorKind::kUsage);
}

/// Area of the mesh seen from above, exact: lattice points are eighths of samples.
double area_of(const Mesh& mesh) {
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const auto a = mesh.vertex(mesh.triangles[3 * t]), b = mesh.vertex(mesh.triangles[3 * t + 1]),
               c = mesh.vertex(mesh.triangles[3 * t + 2]);
    area += (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }
  return area;
}

RC_GTEST_PROP(simplified_outlines, of_efforts_keep_the_promise_and_the_domain, ()) {
  const Field field = any_field(40);
  SimplifyOptions options;
  options.domain.outline_tolerance = *rc::gen::element(0.5, 1.0, 3.0, 20.0);
  options.goals.max_error = *rc::gen::element(0.0, 0.5, 1.0, 3.0, 20.0);
  options.quality.effort = Effort::kFast;
  options.run.threads = 1;
  const auto fast = simplify(field.view(), options);
  RC_ASSERT(fast || fast.error().kind == ErrorKind::kInput);
  RC_PRE(fast.has_value());
  options.quality.effort = *rc::gen::element(Effort::kNormal, Effort::kHigh, Effort::kMax);
  options.quality.vertices = *rc::gen::element(Vertices::kAuto, Vertices::kSamples);
  const auto made = simplify(field.view(), options);
  RC_ASSERT(made.has_value());
  RC_ASSERT(made->mesh.triangle_count() <= fast->mesh.triangle_count());
  const Measurement m = *measure(field.view(), made->mesh), before = *measure(field.view(), fast->mesh);
  RC_ASSERT(m.max_error <= *options.goals.max_error + 1e-9);
  RC_ASSERT(m.uncovered == 0u);
  RC_ASSERT(m.samples == before.samples);
  RC_ASSERT(m.is_sound());
  RC_ASSERT(area_of(made->mesh) == area_of(fast->mesh));
  for (const int threads : {2, 4}) {
    options.run.threads = threads;
    RC_ASSERT(is_same_mesh(*simplify(field.view(), options), *made));
  }
}

RC_GTEST_PROP(simplified_outlines, of_small_shapes_keep_every_sample, ()) {
  const Field field = testing::random_field(*rc::gen::arbitrary<std::uint32_t>(), *rc::gen::inRange(2, 14),
                                            *rc::gen::inRange(2, 14), Relief::kTies, *rc::gen::element(0.3, 0.5, 0.7));
  SimplifyOptions options{.goals = {.max_error = 1e6}, .quality = {.effort = Effort::kFast}};
  options.domain.outline_tolerance = *rc::gen::element(1.0, 4.0, 20.0);
  const auto made = simplify(field.view(), options);
  RC_ASSERT(made || made.error().kind == ErrorKind::kInput);
  if (made) RC_ASSERT(made->measurement.uncovered == 0u);
}

TEST(simplified_outlines, take_fewer_triangles_with_each_level) {
  const Field field = testing::random_field(22, testing::fewer(300), testing::fewer(200), Relief::kRidges, 0.2);
  std::size_t before = SIZE_MAX;
  for (const Effort effort : {Effort::kFast, Effort::kAuto, Effort::kHigh}) {
    SimplifyOptions options;
    options.goals.max_error = 8;
    options.domain.outline_tolerance = 3;
    options.quality.effort = effort;
    const auto made = simplify(field.view(), options);
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_EQ(made->effort, effort == Effort::kAuto ? Effort::kNormal : effort);
    EXPECT_LT(static_cast<double>(made->mesh.triangle_count()), 0.9 * static_cast<double>(before));
    before = made->mesh.triangle_count();
  }
}

}  // namespace
}  // namespace scarp::effort_beyond_heights_laws_test
