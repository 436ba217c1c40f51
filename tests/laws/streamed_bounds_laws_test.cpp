// Laws of tolerances read in windows: in all strips, each sample satisfies its own, and reports equal those for an
// array.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "laws/any_field.h"
#include "laws/any_lines.h"
#include "laws/array_bounds.h"
#include "laws/array_source.h"
#include "laws/mesh_laws.h"
#include "lines/field_lines.h"
#include "pieces/border_chain.h"
#include "pieces/freeze.h"
#include "pieces/strips.h"
#include "refine/domain.h"
#include "scarp/features.h"
#include "scarp/measure.h"
#include "scarp/simplify.h"

namespace scarp::streamed_bounds_laws_test {
namespace {

using testing::ArrayBounds;
using testing::ArraySource;
using testing::Field;
using testing::kNoBound;
using testing::Relief;
using testing::with_source;

/// A field and bounds, both read in windows.
struct Scene {
  Field field = testing::any_field(50);
  std::vector<float> bounds = testing::any_bounds(field.cols, field.rows);
  ArraySource source{field.view()};
  ArrayBounds tolerances{bounds, field.cols};
  HeightField streamed = with_source(field.view(), source);
  SimplifyOptions options;

  Scene() {
    options.goals.max_error = *rc::gen::element<std::optional<double>>(std::nullopt, 0.0, 1.0, 7.3, 30.0, 1e6);
    options.tolerances.source = &tolerances;
    options.quality.effort = *rc::gen::element(Effort::kFast, Effort::kNormal, Effort::kHigh, Effort::kMax);
    options.quality.vertices = *rc::gen::element(Vertices::kAuto, Vertices::kSamples);
    options.run.threads = *rc::gen::element(1, 2);
    // Beyond values that exact arithmetic distinguishes from 0.
    const auto few = *rc::gen::element<std::size_t>(1 << 20, 7);
    for (std::size_t i = 0; i < bounds.size(); i += few) bounds[i] *= 1e-30f;
  }
  Scene(const Scene&) = delete;

  /// The guaranteed bound of each sample, plus the judge's arithmetic error.
  std::vector<float> promised() const {
    std::vector<float> all = bounds;
    for (float& bound : all) {
      bound = static_cast<float>(std::min(double{bound}, options.goals.max_error.value_or(HUGE_VAL)));
      bound = bound * 1.000001f + 1e-6f;
    }
    return all;
  }
  SimplifyOptions in_memory() const {
    SimplifyOptions array = options;
    array.tolerances.values = bounds;
    array.tolerances.source = nullptr;
    return array;
  }
};

Measurement judged(const HeightField& field, const Mesh& mesh, const std::vector<float>& bounds) {
  MeasureOptions judge;
  judge.tolerance = bounds;
  const auto measured = measure(field, mesh, judge);
  RC_ASSERT(measured.has_value());
  return *measured;
}

void expect_kept(const Measurement& m) {
  RC_ASSERT(m.over_tolerance == 0u);
  RC_ASSERT(m.uncovered == 0u);
  RC_ASSERT(m.nodata_cells_covered == 0u);
  RC_ASSERT(m.is_sound());
}

/// Refines in strips of tiles with that side.
Result<std::optional<pieces::Tiled>> refine(const Scene& scene, std::int32_t side, const lines::FieldLines* lines) {
  const double most = scene.options.goals.max_error.value_or(HUGE_VAL),
               threshold = scene.options.goals.max_error.value_or(0);
  const metric::SourceBounds bounds(scene.tolerances, most, {});
  pieces::StripTotals fits;
  pieces::TiledOptions tiles{.threshold = threshold, .threads = scene.options.run.threads, .tile_side = side};
  pieces::work_by_strips(pieces::Recipe(scene.streamed, scene.options), lines != nullptr ? &lines->graph : nullptr,
                         &bounds, threshold, fits, tiles);
  return pieces::refine_tiled(lines != nullptr ? lines->apply(scene.streamed) : scene.streamed, tiles);
}

grid::VertexLattice places_of(const pieces::Tiled& tiled) {
  return {tiled.steps, tiled.steps > 1 ? tiled.heights : std::vector<float>(), {}};
}

RC_GTEST_PROP(streamed_bounds, are_kept_by_every_sample_in_small_strips, ()) {
  const Scene scene;
  const auto domain = refine::build_domain(scene.field.raster(), 0, grid_frame(scene.field.rows));
  const auto made = refine(scene, *rc::gen::element(8, 16, 31), nullptr);
  RC_ASSERT(made.has_value() == domain.has_value());
  if (!made) return;
  const pieces::Tiled& tiled = **made;
  const tin::Triangulation& tin = tiled.domain.tin;
  const std::string unsound = testing::verify_triangulation(
      tin, (scene.field.cols - 1) * tiled.steps + 1, (scene.field.rows - 1) * tiled.steps + 1, testing::Edges::kAny);
  RC_ASSERT(unsound == "");
  const Mesh mesh = pieces::freeze(
      tin, {pieces::SampleHeights(scene.streamed, tiled.heights), places_of(tiled), scene.field.view().frame, false});
  expect_kept(judged(scene.field.view(), mesh, scene.promised()));
}

RC_GTEST_PROP(streamed_bounds, are_kept_beside_lines, ()) {
  Scene scene;
  LineConstraints& constraints = scene.options.features.breaklines = testing::any_lines(scene.field);
  if (*rc::gen::arbitrary<bool>()) {
    for (Line& line : constraints.lines) {
      if (std::isnan(line.points[0][2]))
        line.kind = *rc::gen::element(LineKind::kBreakline, LineKind::kRidge, LineKind::kKeptRidge);
    }
  }
  const std::int32_t side = *rc::gen::element(8, 16, 31);
  const auto lines =
      lines::prepare_lines(scene.streamed, constraints, {}, scene.options.goals.max_error.value_or(50) / 2, 1,
                           pieces::shared_rows(scene.streamed, side));
  RC_PRE(lines.has_value());
  const auto made = refine(scene, side, &*lines);
  RC_PRE(made.has_value());
  const HeightField edited = lines->apply(scene.streamed);
  const Mesh mesh = pieces::freeze(
      (*made)->domain.tin, {pieces::SampleHeights(edited, {}), places_of(**made), scene.field.view().frame, false});
  expect_kept(judged(edited, mesh, scene.promised()));
}

RC_GTEST_PROP(streamed_bounds, make_the_same_mesh_on_any_number_of_threads, ()) {
  Scene scene;
  const std::int32_t side = *rc::gen::element(8, 31);
  scene.options.run.threads = 1;
  const auto first = refine(scene, side, nullptr);
  RC_PRE(first.has_value());
  scene.options.run.threads = 3;
  const auto again = refine(scene, side, nullptr);
  RC_ASSERT(again.has_value());
  RC_ASSERT(testing::is_same((*first)->domain.tin, (*again)->domain.tin));
}

/// In memory and in the public interface, also with a single row, reports name the same samples.
RC_GTEST_PROP(streamed_bounds, are_promised_and_counted_as_those_in_memory, ()) {
  Scene scene;
  HeightField view = scene.field.view();
  if (*rc::gen::arbitrary<bool>()) {
    view.frame.kind = Frame::Kind::kSource;
    view.frame.affine = {4321987.123, 6.7218131, 0, 5123456.789, 0, -6.7218131};
    scene.streamed.frame = view.frame;
  }
  scene.options.output.float32_positions = *rc::gen::arbitrary<bool>();
  view.sample_rounding = scene.streamed.sample_rounding = *rc::gen::element(0.0, 0.0, 0.01);
  const auto held = simplify(view, scene.in_memory());
  const auto made = simplify(scene.streamed, scene.options);
  if (!made || !held) {
    RC_ASSERT(made.has_value() == held.has_value() || scene.options.output.float32_positions);
    if (!made && !held) {
      RC_ASSERT(made.error().kind == held.error().kind);
      if (view.sample_rounding > 0) RC_ASSERT(made.error().message == held.error().message);
    }
    return;
  }
  RC_ASSERT(made->ignored == held->ignored);
  const Measurement m = judged(view, made->mesh, scene.promised());
  RC_ASSERT(m.over_tolerance == 0u);
  RC_ASSERT(m.uncovered == 0u);
  RC_ASSERT(m.is_sound());
  RC_ASSERT(m.max_error == made->measurement.max_error);
  if (scene.options.goals.max_error || scene.options.quality.effort != Effort::kFast ||
      !scene.field.raster().is_valid({0, 0}))
    return;
  // Rows are refined like everything in memory.
  RC_ASSERT(made->mesh.triangle_count() == held->mesh.triangle_count());
  RC_ASSERT(std::abs(made->weighted_max_error - held->weighted_max_error) <= 1e-6 * held->weighted_max_error);
}

RC_GTEST_PROP(streamed_bounds, are_judged_as_those_of_an_array, ()) {
  const Scene scene;
  const Field other = testing::random_field(*rc::gen::arbitrary<std::uint32_t>(), scene.field.cols, scene.field.rows,
                                            Relief::kRidges, *rc::gen::element(0.0, 0.3));
  const auto result = simplify(other.view(), {.goals = {.max_error = *rc::gen::element(0.0, 2.0, 20.0)}});
  RC_PRE(result.has_value());
  MeasureOptions array, windows;
  array.tolerance = scene.bounds;
  windows.tolerance_source = &scene.tolerances;
  array.collect_above = windows.collect_above = *rc::gen::element<std::optional<double>>(std::nullopt, 0.0, 5.0);
  windows.run.threads = *rc::gen::element(1, 3);
  const auto a = measure(scene.field.view(), result->mesh, array);
  const auto b = measure(*rc::gen::arbitrary<bool>() ? scene.streamed : scene.field.view(), result->mesh, windows);
  RC_ASSERT(a.has_value() && b.has_value());
  RC_ASSERT(a->over_tolerance == b->over_tolerance);
  RC_ASSERT(a->max_error == b->max_error && a->rmse == b->rmse);
  RC_ASSERT(a->offenders.size() == b->offenders.size());
  for (std::size_t i = 0; i < a->offenders.size(); ++i) {
    const Offender &x = a->offenders[i], &y = b->offenders[i];
    RC_ASSERT(x.col == y.col && x.row == y.row && x.error == y.error);
  }
}

RC_GTEST_PROP(streamed_bounds, of_a_border_are_kept_by_what_splits_it, ()) {
  const Field field = testing::any_field(60);
  const std::vector<float> bounds = testing::any_bounds(field.cols, field.rows);
  const std::int32_t y = *rc::gen::inRange(0, field.rows);
  const pieces::BorderLine line{0, y, field.cols - 1, false};
  const double threshold = *rc::gen::element(0.5, 7.3, 100.0);
  std::vector<float> own(bounds.begin() + std::ptrdiff_t{y} * field.cols,
                         bounds.begin() + (std::ptrdiff_t{y} + 1) * field.cols);
  for (float& bound : own) bound = std::min(bound, static_cast<float>(threshold));
  std::vector<std::int32_t> kept = *pieces::simplify_border(field.view(), line, threshold);
  const auto more = *pieces::split_border(field.view(), line, kept, pieces::LineBound(own));
  for (const std::int32_t step : more) RC_ASSERT(std::find(kept.begin(), kept.end(), step) == kept.end());
  kept.insert(kept.end(), more.begin(), more.end());
  std::sort(kept.begin(), kept.end());
  RC_ASSERT(pieces::split_border(field.view(), line, kept, pieces::LineBound(own))->empty());
}

/// Memory for several strips.
TEST(streamed_bounds, take_about_as_many_triangles_as_in_memory_at_the_public_door) {
  Field field{400, 500, {}};
  std::vector<float> bounds;
  for (std::int32_t y = 0; y < field.rows; ++y) {
    for (std::int32_t x = 0; x < field.cols; ++x) {
      field.samples.push_back(static_cast<float>(50 * std::sin(0.05 * x) + 30 * std::cos(0.07 * y + 0.02 * x)));
      bounds.push_back(x < 100 ? kNoBound : static_cast<float>(1 + 0.01 * x));
    }
  }
  const ArraySource source(field.view());
  const ArrayBounds tolerances(bounds, field.cols);
  const HeightField streamed = with_source(field.view(), source);
  SimplifyOptions options;
  options.run.memory.limit = 4ull * 4 * 300 * static_cast<std::uint64_t>(field.cols);
  options.run.threads = 1;
  double normal = 0;  // triangles in memory
  for (const Effort effort : {Effort::kFast, Effort::kNormal, Effort::kHigh}) {
    for (const auto most : {std::optional<double>(), std::optional(4.0)}) {
      if (effort == Effort::kHigh && most) continue;
      SimplifyOptions held;
      held.quality.effort = options.quality.effort = effort;
      held.goals.max_error = options.goals.max_error = most;
      held.tolerances.values = bounds;
      options.tolerances.source = &tolerances;
      const auto made = simplify(streamed, options), in_memory = simplify(field.view(), held);
      ASSERT_TRUE(made) << made.error().message;
      ASSERT_TRUE(in_memory) << in_memory.error().message;
      if (effort == Effort::kNormal && !most) normal = static_cast<double>(in_memory->mesh.triangle_count());
      EXPECT_LT(static_cast<double>(made->mesh.triangle_count()),
                effort == Effort::kHigh ? 0.56 * normal : 1.15 * static_cast<double>(in_memory->mesh.triangle_count()));
      EXPECT_EQ(made->ignored, most ? 0u : 50'000u);
      EXPECT_LE(made->weighted_max_error, 1 + 1e-6);
      EXPECT_GT(made->weighted_max_error, 0.9);
    }
  }
}

RC_GTEST_PROP(streamed_bounds, are_kept_beside_goals_of_shapes, ()) {
  Scene scene;
  if (!scene.options.goals.max_error) scene.options.goals.max_error = 50;
  scene.options.quality.shape.min_angle = *rc::gen::element(0.0, 20.0);
  scene.options.quality.shape.max_edge = 7.0;
  if (*rc::gen::arbitrary<bool>()) scene.options.quality.shape.grade = 0.5;
  const auto made = simplify(scene.streamed, scene.options);
  RC_ASSERT(made || made.error().kind == ErrorKind::kInput);
  if (!made) return;
  expect_kept(judged(scene.field.view(), made->mesh, scene.promised()));
  RC_ASSERT(made->shape->below == 0u);
  RC_ASSERT(made->shape->longest_edge <= 7);
}

TEST(streamed_bounds, are_refused_beside_samples_in_memory_and_where_they_are_none) {
  const Field field = testing::random_field(3, 30, 20, Relief::kRidges);
  std::vector<float> bounds(600, 2.0f);
  const ArraySource source(field.view());
  const ArrayBounds tolerances(bounds, 30);
  const HeightField streamed = with_source(field.view(), source);
  SimplifyOptions options;
  options.tolerances.source = &tolerances;
  EXPECT_EQ(simplify(field.view(), options).error().kind, ErrorKind::kUsage);
  ASSERT_TRUE(simplify(streamed, options));
  bounds[7 * 30 + 4] = -1;
  EXPECT_EQ(simplify(streamed, options).error().message, "the tolerance at sample (4, 7) is -1: it must be at least 0");
  bounds[7 * 30 + 4] = 0.25f;
  HeightField rounded = streamed;
  rounded.sample_rounding = 0.5;
  const auto refused = simplify(rounded, options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::kPromise);
  EXPECT_EQ(refused.error().message.substr(0, 38), "the bound at sample (4, 7) is 0.25, bu");
}

}  // namespace
}  // namespace scarp::streamed_bounds_laws_test
