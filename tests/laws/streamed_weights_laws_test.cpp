// Weights, ignored samples and normals of rasters read by windows.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "laws/array_bounds.h"
#include "laws/array_source.h"
#include "laws/fields.h"
#include "laws/sanitized.h"
#include "measure/judge.h"
#include "pieces/normals.h"
#include "scarp/simplify.h"

namespace scarp::streamed_weights_laws_test {
namespace {

using testing::ArrayBounds;
using testing::ArraySource;
using testing::Field;
using testing::kNoBound;
using testing::Relief;
using testing::with_source;

/// Weights by blocks, some ignored samples, and a field that has several strips if it has many rows.
struct Scene {
  Field field;
  std::vector<float> weights = any_weights();
  ArraySource source{field.view()};
  ArrayBounds windows{weights, field.cols};
  HeightField streamed = with_source(field.view(), source);
  std::vector<SampleAt> ignored;
  bool has_weights = *rc::gen::arbitrary<bool>();

  explicit Scene(std::int32_t rows)
      : field(testing::random_field(*rc::gen::arbitrary<std::uint32_t>(), 120, rows,
                                    *rc::gen::element(Relief::kTies, Relief::kRidges), *rc::gen::element(0.0, 0.05))) {
    std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
    const auto count = *rc::gen::element(0, 1, 900);
    for (int k = has_weights ? 0 : -1; k < count; ++k)
      ignored.push_back({static_cast<std::int32_t>(random() % 120),
                         static_cast<std::int32_t>(random() % static_cast<unsigned>(field.rows))});
  }
  Scene(const Scene&) = delete;

  std::vector<float> any_weights() const {
    std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
    const float levels[] = {0, 0.25f, 0.3f, 1, 1, 4};
    std::vector<float> blocks(5000), all;
    for (float& weight : blocks) weight = levels[random() % 6];
    for (std::int32_t k = 0; k < field.rows * field.cols; ++k)
      all.push_back(blocks[static_cast<std::size_t>(k / field.cols / 9 * 17 + k % field.cols / 9)]);
    return all;
  }
  /// The bounds implied by a max error, plus the judge's arithmetic error.
  std::vector<float> promised(double max_error) const {
    std::vector<float> all(weights.size());
    for (std::size_t k = 0; k < all.size(); ++k) {
      const double weight = has_weights ? double{weights[k]} : 1;
      all[k] = weight > 0 ? static_cast<float>(max_error / weight * 1.000001 + 1e-6) : kNoBound;
    }
    for (const SampleAt& step : ignored)
      all[static_cast<std::size_t>(step.row) * static_cast<std::size_t>(field.cols) +
          static_cast<std::size_t>(step.col)] = kNoBound;
    return all;
  }
};

RC_GTEST_PROP(streamed_weights, and_ignored_samples_are_kept_by_the_mesh, ()) {
  const Scene scene(*rc::gen::element(60, testing::fewer(330)));
  SimplifyOptions options;
  options.goals.max_error = *rc::gen::element(0.0, 2.0, 7.3, 30.0);
  options.tolerances.ignored = scene.ignored;
  if (scene.has_weights) options.tolerances.weights_source = &scene.windows;
  options.quality.effort = *rc::gen::element(Effort::kFast, Effort::kNormal, Effort::kHigh);
  options.run.memory.limit = *rc::gen::element(0u, 1'200'000u);
  options.run.threads = *rc::gen::element(1, 2);
  options.output.normals = *rc::gen::arbitrary<bool>();
  if (*rc::gen::arbitrary<bool>()) {
    Line line;  // through all strips, at the heights of the raster
    line.points = {{3.25, 0.5, NAN}, {80.5, 0.4 * scene.field.rows, NAN}, {40.75, scene.field.rows - 1.5, NAN}};
    options.features.breaklines.lines = {line};
  }
  const auto made = simplify(scene.streamed, options);
  if (!made) {
    RC_ASSERT(made.error().kind == ErrorKind::kInput ||
              (made.error().kind == ErrorKind::kMemory && options.run.memory.limit > 0));
    RC_DISCARD("no surface, or no room");
  }
  const std::vector<float> promised = scene.promised(*options.goals.max_error);
  MeasureOptions judge;
  judge.tolerance = promised;
  const auto m = measure(scene.field.view(), made->mesh, judge);
  RC_ASSERT(m.has_value());
  RC_ASSERT(m->over_tolerance == 0u && m->uncovered == 0u && m->is_sound());
  RC_ASSERT(made->mesh.normals.size() == (options.output.normals ? made->mesh.positions.size() : 0u));
  std::uint64_t ignored = 0;
  for (std::size_t k = 0; k < promised.size(); ++k)
    ignored += std::isinf(promised[k]) && !std::isnan(scene.field.samples[k]);
  RC_ASSERT(made->ignored == ignored);
  if (scene.has_weights && scene.ignored.empty())
    RC_ASSERT(made->weighted_max_error <= *options.goals.max_error * 1.000001 + 1e-6);
}

void expect_same(const judge::LargestError& a, const judge::LargestError& b) {
  RC_ASSERT(a.value == b.value && a.at == b.at);
}

RC_GTEST_PROP(streamed_weights, and_ignored_samples_are_judged_as_those_of_an_array, ()) {
  const Scene scene(40);
  const Field other = testing::random_field(*rc::gen::arbitrary<std::uint32_t>(), scene.field.cols, scene.field.rows,
                                            Relief::kRidges, *rc::gen::element(0.0, 0.3));
  const auto mesh = simplify(other.view(), {.goals = {.max_error = *rc::gen::element(2.0, 20.0)}});
  RC_PRE(mesh.has_value());
  judge::JudgeOptions array, windows;
  array.tolerances.ignored = windows.tolerances.ignored = scene.ignored;
  array.max_error = windows.max_error = *rc::gen::element<std::optional<double>>(std::nullopt, 5.0, 100.0);
  array.weigh = windows.weigh = *rc::gen::arbitrary<bool>();
  windows.run.threads = 2;
  array.keep_errors = true;
  if (scene.has_weights) {
    array.tolerances.weights = scene.weights;
    windows.tolerances.weights_source = &scene.windows;
  }
  std::vector<float> rows;
  windows.on_row = [&](int, std::span<const float> errors) { rows.insert(rows.end(), errors.begin(), errors.end()); };
  const auto a = judge::judge_mesh(scene.field.view(), mesh->mesh, array);
  const auto b = judge::judge_mesh(scene.streamed, mesh->mesh, windows);
  RC_ASSERT(a.has_value() && b.has_value());
  if (array.weigh) RC_ASSERT(a->ignored == b->ignored);
  expect_same(a->bounded, b->bounded);
  RC_ASSERT(a->weighted.has_value() == b->weighted.has_value());
  if (a->weighted) {
    expect_same(a->weighted->largest, b->weighted->largest);
    expect_same(a->weighted->bounded, b->weighted->bounded);
    RC_ASSERT(a->weighted->rmse == b->weighted->rmse && a->weighted->over == b->weighted->over);
  }
  RC_ASSERT(std::equal(rows.begin(), rows.end(), a->height_errors.begin(), a->height_errors.end(),
                       [](float x, float y) { return x == y || (std::isnan(x) && std::isnan(y)); }));
}

RC_GTEST_PROP(streamed_normals, are_those_of_samples_in_memory, ()) {
  const Field field = testing::random_field(*rc::gen::arbitrary<std::uint32_t>(), *rc::gen::inRange(2, 40),
                                            *rc::gen::element(2, 63, 64, 65, 130, 300), Relief::kRidges, 0.1);
  const ArraySource source(field.view());
  const std::int32_t steps = *rc::gen::element(1, 8);
  pieces::LatticePoints at{steps, {}};
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  for (int k = 0; k < 400; ++k) {
    const Point p{static_cast<std::int32_t>(random() % static_cast<unsigned>((field.cols - 1) * steps + 1)),
                  static_cast<std::int32_t>(random() % static_cast<unsigned>((field.rows - 1) * steps + 1))};
    const Point sample{p.x / steps, p.y / steps};
    const auto index =
        static_cast<std::size_t>(sample.y) * static_cast<std::size_t>(field.cols) + static_cast<std::size_t>(sample.x);
    if (!std::isnan(field.samples[index])) at.points.push_back(p);
  }
  const bool is_same =
      pieces::sample_normals(field.view(), at, {}) == pieces::sample_normals(with_source(field.view(), source), at, {});
  RC_ASSERT(is_same);
}

}  // namespace
}  // namespace scarp::streamed_weights_laws_test
