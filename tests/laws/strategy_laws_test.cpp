// The bound holds for all choices: laws of importance, weights, tolerances, scripts, algorithms and batches.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numeric>
#include <set>

#include "laws/array_source.h"
#include "laws/strategies.h"
#include "metric/height_metric.h"
#include "metric/importance.h"
#include "metric/sample_metric.h"
#include "refine/domain.h"
#include "refine/refinement.h"

namespace scarp::strategy_laws_test {
namespace {

using testing::Field;
using testing::Relief;

constexpr double kRounding = 1e-6;  // rounding of the test's own interpolation

Field any_field(std::int32_t largest, std::vector<double> nodata = {0.0, 0.0, 0.1, 0.4}) {
  const auto cols = *rc::gen::inRange(2, largest), rows = *rc::gen::inRange(2, largest);
  const auto relief =
      *rc::gen::elementOf(std::vector<Relief>(std::begin(testing::kReliefs), std::end(testing::kReliefs)));
  return testing::random_field(*rc::gen::arbitrary<std::uint32_t>(), cols, rows, relief, *rc::gen::elementOf(nodata));
}

std::vector<float> any_values(const Field& field, std::vector<float> choices) {
  std::vector<float> values(field.samples.size());
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  std::mt19937 random(seed);
  for (float& value : values) value = choices[random() % choices.size()];
  return values;
}

RC_GTEST_PROP(strategies, keep_the_bound_whatever_is_chosen, ()) {
  const Field field = any_field(26);
  PaperOptions options = testing::any_strategy();
  options.goals.max_error = *rc::gen::element(0.0, 0.5, 1.0, 3.0, 20.0);
  const auto result = simplify_by_paper(field.view(), options);
  RC_PRE(result.has_value() || result.error().kind != ErrorKind::kInput);
  RC_ASSERT(result.has_value());
  const Measurement m = *measure(field.view(), result->mesh);
  RC_ASSERT(m.max_error <= *options.goals.max_error + 1e-9);
  RC_ASSERT(m.uncovered == 0u);
  RC_ASSERT(m.nodata_cells_covered == 0u);
  RC_ASSERT(m.is_sound());
  RC_ASSERT(result->stop == StopReason::kMaxError);
}

RC_GTEST_PROP(strategies, budgets_are_upper_bounds_whatever_is_chosen, ()) {
  const Field field = any_field(30, {0.0});
  PaperOptions options = testing::any_strategy();
  const auto budget = *rc::gen::inRange<std::uint64_t>(4, 400);
  (*rc::gen::arbitrary<bool>() ? options.goals.max_vertices : options.goals.max_triangles) = budget;
  options.strategy.best_of_budget = *rc::gen::arbitrary<bool>();
  const auto result = simplify_by_paper(field.view(), options);
  RC_ASSERT(result.has_value());
  RC_ASSERT(!options.goals.max_vertices || result->mesh.vertex_count() <= budget);
  RC_ASSERT(!options.goals.max_triangles || result->mesh.triangle_count() <= budget);
  RC_ASSERT(measure(field.view(), result->mesh)->is_sound());
}

RC_GTEST_PROP(strategies, algorithms_one_two_and_three_make_the_same_mesh, ()) {
  const Field field = any_field(18);
  PaperOptions options = testing::any_strategy();
  options.goals.max_error = *rc::gen::element(0.0, 1.0, 5.0);
  std::vector<Mesh> meshes;
  for (const Algorithm algorithm : {Algorithm::kHeap, Algorithm::kLocal, Algorithm::kBruteForce}) {
    options.strategy.algorithm = algorithm;
    auto result = simplify_by_paper(field.view(), options);
    RC_PRE(result.has_value());
    meshes.push_back(std::move(result->mesh));
  }
  for (const Mesh& mesh : meshes) {
    RC_ASSERT(mesh.positions == meshes[0].positions);
    RC_ASSERT(mesh.triangles == meshes[0].triangles);
  }
}

RC_GTEST_PROP(strategies, every_tolerance_is_kept, ()) {
  const Field field = any_field(22);
  PaperOptions options = testing::any_strategy();
  const auto tolerance = any_values(field, {0.0f, 0.25f, 1.0f, 2.0f, 50.0f, INFINITY});
  options.tolerances.values = tolerance;
  if (*rc::gen::arbitrary<bool>()) options.goals.max_error = 3.0;
  const auto result = simplify_by_paper(field.view(), options);
  RC_PRE(result.has_value() || result.error().kind != ErrorKind::kInput);
  RC_ASSERT(result.has_value());
  const HeightField view = field.view();
  for (int row = 0; row < field.rows; ++row) {
    for (int col = 0; col < field.cols; ++col) {
      const double error = testing::error_at(result->mesh, view, col, row);
      const double allowed = tolerance[static_cast<std::size_t>(row * field.cols + col)];
      if (!std::isnan(error))
        RC_ASSERT(error <= std::min(allowed, options.goals.max_error.value_or(HUGE_VAL)) + kRounding);
    }
  }
  RC_ASSERT(result->weighted_max_error <= 1 + kRounding || std::isinf(result->weighted_max_error));
  RC_ASSERT(measure(view, result->mesh)->is_sound());
}

RC_GTEST_PROP(strategies, a_mask_bounds_the_weighted_error_and_reports_the_true_one, ()) {
  const Field field = any_field(22);
  PaperOptions options = testing::any_strategy();
  const auto mask = any_values(field, {0.0f, 0.1f, 0.5f, 1.0f, 1.0f});
  options.tolerances.weights = mask;
  options.goals.max_error = *rc::gen::element(0.5, 2.0);
  const auto result = simplify_by_paper(field.view(), options);
  RC_PRE(result.has_value() || result.error().kind != ErrorKind::kInput);
  RC_ASSERT(result.has_value());
  const HeightField view = field.view();
  double largest = 0, weighted = 0;
  std::uint64_t ignored = 0;
  for (int row = 0; row < field.rows; ++row) {
    for (int col = 0; col < field.cols; ++col) {
      const auto i = static_cast<std::size_t>(row * field.cols + col);
      ignored += mask[i] == 0 && !std::isnan(field.samples[i]);
      const double error = testing::error_at(result->mesh, view, col, row);
      if (std::isnan(error)) continue;
      RC_ASSERT(mask[i] * error <= *options.goals.max_error + kRounding);
      largest = std::max(largest, error);
      weighted = std::max(weighted, mask[i] * error);
    }
  }
  RC_ASSERT(std::abs(result->measurement.max_error - largest) <= kRounding * (1 + largest));
  RC_ASSERT(std::abs(result->weighted_max_error - weighted) <= kRounding * (1 + weighted));
  RC_ASSERT(result->ignored == ignored);
}

RC_GTEST_PROP(strategies, a_mask_of_ones_changes_nothing, ()) {
  const Field field = any_field(22);
  PaperOptions options = testing::any_strategy();
  options.goals.max_error = *rc::gen::element(0.5, 1.0, 8.0);
  const auto without = simplify_by_paper(field.view(), options);
  RC_PRE(without.has_value());
  const std::vector<float> ones(field.samples.size(), 1.0f);
  options.tolerances.weights = ones;
  const auto with = simplify_by_paper(field.view(), options);
  RC_ASSERT(with.has_value());
  RC_ASSERT(with->mesh.positions == without->mesh.positions);
  RC_ASSERT(with->mesh.triangles == without->mesh.triangles);
  RC_ASSERT(std::abs(with->weighted_max_error - with->measurement.max_error) <=
            kRounding * (1 + *options.goals.max_error));
}

RC_GTEST_PROP(strategies, channels_are_bounded_by_their_norm_with_the_heights, ()) {
  const Field field = any_field(16);
  PaperOptions options = testing::any_strategy();
  const auto count = *rc::gen::inRange(1, 4);
  std::vector<Field> layers;
  for (int k = 0; k < count; ++k)
    layers.push_back(testing::random_field(*rc::gen::arbitrary<std::uint32_t>(), field.cols, field.rows,
                                           *rc::gen::element(Relief::kTies, Relief::kFlat, Relief::kRidges)));
  HeightField view = field.view();
  view.height_scale = *rc::gen::element(1.0, 1.0, 0.0, 2.0);
  for (const Field& layer : layers) view.channels.push_back({layer.samples.data(), *rc::gen::element(0.5, 1.0, 3.0)});
  options.goals.max_error = *rc::gen::element(0.0, 1.0, 7.0);
  const auto result = simplify_by_paper(view, options);
  RC_PRE(result.has_value() || result.error().kind != ErrorKind::kInput);
  RC_ASSERT(result.has_value());
  RC_ASSERT(result->mesh.channels.size() == static_cast<std::size_t>(count) * result->mesh.vertex_count());
  for (int row = 0; row < field.rows; ++row) {
    for (int col = 0; col < field.cols; ++col) {
      double sum = 0, squares = 0, largest = 0;
      bool covered = true;
      for (int k = -1; k < count; ++k) {
        const double scale = k < 0 ? view.height_scale : view.channels[static_cast<std::size_t>(k)].scale;
        const double error = scale * testing::error_at(result->mesh, view, col, row, k);
        covered = covered && !std::isnan(error);
        sum += error;
        squares += error * error;
        largest = std::max(largest, error);
      }
      if (!covered) continue;
      // The test uses each field's worst triangle at a shared sample, where all agree up to rounding.
      const double norm = options.goals.norm == Norm::kSum       ? sum
                          : options.goals.norm == Norm::kSquares ? std::sqrt(squares)
                                                                 : largest;
      RC_ASSERT(norm <= *options.goals.max_error + 1e-4 * (1 + norm));
    }
  }
  RC_ASSERT(result->channel_measurements.size() == static_cast<std::size_t>(count));
  RC_ASSERT(result->combined_max_error <= *options.goals.max_error * (1 + 1e-6));
}

// The plain metric measures one field with scale 1 under one bound; the general metric must agree.
RC_GTEST_PROP(metrics, the_general_one_agrees_with_the_plain_one, ()) {
  const Field field = any_field(22);
  const grid::Raster raster = field.raster();
  auto plain = refine::build_domain(raster, 0, grid_frame(field.rows)),
       general = refine::build_domain(raster, 0, grid_frame(field.rows));
  RC_PRE(plain.has_value());
  const double threshold = *rc::gen::element(0.0, 0.25, 1.0, 2.0, 7.3);
  const EdgeRule rule = *rc::gen::arbitrary<bool>() ? testing::any_edge_rule() : EdgeRule();
  const metric::HeightMetric height_metric(raster, threshold);
  metric::MetricSettings settings{raster, {{field.samples.data(), 1}}};
  settings.threshold = settings.goal = threshold;
  const metric::SampleMetric sample_metric(settings);
  refine::Refinement first(height_metric, plain->tin, Algorithm::kHeap, rule);
  refine::Refinement second(sample_metric, general->tin, Algorithm::kHeap, rule);
  while (!first.done() && !second.done()) {
    RC_ASSERT(first.worst_error() == second.worst_error());
    first.insert_worst();
    second.insert_worst();
    const auto last = static_cast<tin::Vertex>(plain->tin.vertex_count() - 1);
    RC_ASSERT(plain->tin.point(last) == general->tin.point(last));
  }
  RC_ASSERT(first.done() == second.done());
}

RC_GTEST_PROP(script, inserted_samples_are_vertices_and_ignored_ones_are_not_bound, ()) {
  const Field field = any_field(20, {0.0, 0.2});
  PaperOptions options = testing::any_strategy();
  options.goals.max_error = 1.0;
  std::set<std::pair<int, int>> inserted, ignored;
  std::vector<SampleAt> left_out;
  const auto steps = *rc::gen::inRange(0, 30);
  for (int k = 0; k < steps; ++k) {
    const bool inserts = *rc::gen::arbitrary<bool>();
    const SampleAt at{*rc::gen::inRange(0, field.cols), *rc::gen::inRange(0, field.rows)};
    (inserts ? options.points : left_out).push_back(at);
    (inserts ? inserted : ignored).insert({at.col, at.row});
  }
  options.tolerances.ignored = left_out;
  const auto result = simplify_by_paper(field.view(), options);
  RC_PRE(result.has_value() || result.error().kind != ErrorKind::kInput);
  RC_ASSERT(result.has_value());
  std::set<std::pair<int, int>> vertices;
  for (std::size_t v = 0; v < result->mesh.vertex_count(); ++v) {
    const auto p = result->mesh.vertex(v);
    vertices.insert({static_cast<int>(p[0]), field.rows - 1 - static_cast<int>(p[1])});
  }
  const HeightField view = field.view();
  for (int row = 0; row < field.rows; ++row) {
    for (int col = 0; col < field.cols; ++col) {
      const double error = testing::error_at(result->mesh, view, col, row);
      if (std::isnan(error)) continue;
      if (inserted.count({col, row}) != 0) RC_ASSERT(vertices.count({col, row}) == 1u);
      if (ignored.count({col, row}) == 0) RC_ASSERT(error <= 1.0 + kRounding);
    }
  }
}

TEST(script, a_sample_outside_the_raster_is_refused) {
  const Field field = testing::random_field(1, 9, 7, Relief::kReal);
  const SampleAt beyond[] = {{9, 0}};
  for (const bool inserts : {false, true}) {
    SimplifyOptions options{.goals = {.max_error = 1.0}};
    if (inserts) options.features.points = {beyond[0]};
    if (!inserts) options.tolerances.ignored = beyond;
    const auto result = simplify(field.view(), options);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().kind, ErrorKind::kUsage);
    EXPECT_NE(result.error().message.find("(9, 0)"), std::string::npos) << result.error().message;
  }
}

TEST(one_pass, keeps_the_samples_with_the_largest_feature) {
  const Field field = testing::random_field(5, 40, 31, Relief::kReal);
  PaperOptions options{.goals = {.max_vertices = 60}};
  options.strategy.importance = {false, Importance::Feature::kCurvature, Importance::Damping::kUndamped, true};
  const auto result = simplify_by_paper(field.view(), options);
  ASSERT_TRUE(result);
  const auto values = metric::measure_feature(field.raster(), options.strategy.importance);
  std::set<std::pair<int, int>> expected{{0, 0}, {39, 0}, {0, 30}, {39, 30}};
  for (Point p : metric::rank_samples(field.raster(), values)) {
    if (expected.size() == 60) break;
    expected.insert({p.x, p.y});
  }
  std::set<std::pair<int, int>> found;
  for (std::size_t v = 0; v < result->mesh.vertex_count(); ++v) {
    const auto p = result->mesh.vertex(v);
    found.insert({static_cast<int>(p[0]), 30 - static_cast<int>(p[1])});
  }
  EXPECT_EQ(found, expected);
}

TEST(one_pass, leaves_out_the_samples_that_a_script_ignores) {
  const Field field = testing::random_field(5, 40, 31, Relief::kReal);
  PaperOptions options{.goals = {.max_vertices = 60}};
  options.strategy.importance = {false, Importance::Feature::kCurvature, Importance::Damping::kUndamped, true};
  const auto ranked =
      metric::rank_samples(field.raster(), metric::measure_feature(field.raster(), options.strategy.importance));
  std::vector<SampleAt> left_out;
  for (std::size_t k = 0; k < 20; ++k) left_out.push_back({ranked[k].x, ranked[k].y});
  options.tolerances.ignored = left_out;
  const auto result = simplify_by_paper(field.view(), options);
  ASSERT_TRUE(result);
  const std::set<std::pair<int, int>> corners{{0, 0}, {39, 0}, {0, 30}, {39, 30}};
  for (std::size_t v = 0; v < result->mesh.vertex_count(); ++v) {
    const auto p = result->mesh.vertex(v);
    const Point at{static_cast<int>(p[0]), 30 - static_cast<int>(p[1])};
    const bool is_ranked_high = std::find(ranked.begin(), ranked.begin() + 20, at) != ranked.begin() + 20;
    EXPECT_TRUE(!is_ranked_high || corners.count({at.x, at.y}) == 1) << at.x << ", " << at.y;
  }
}

TEST(channels, no_sample_is_lost_where_squares_overflow) {
  const Field field = testing::random_field(1, 40, 31, Relief::kFlat),
              layer = testing::random_field(2, 40, 31, Relief::kReal);
  HeightField view = field.view();
  view.channels = {{layer.samples.data(), 1e160}};
  for (const bool data_dependent : {false, true}) {
    PaperOptions options{.goals = {.max_error = 5e160}};
    options.strategy.edges.data_dependent = data_dependent;
    const auto result = simplify_by_paper(view, options);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_GT(result->channel_measurements[0].max_error, 0);
    EXPECT_LE(result->channel_measurements[0].max_error, 5.00001);
  }
}

TEST(mask, must_be_finite) {
  const Field field = testing::random_field(1, 9, 7, Relief::kReal);
  std::vector<float> mask(63, 1.0f);
  mask[10] = std::numeric_limits<float>::infinity();
  SimplifyOptions options{.goals = {.max_error = 1.0}};
  options.tolerances.weights = mask;
  const auto result = simplify(field.view(), options);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, ErrorKind::kUsage);
  EXPECT_NE(result.error().message.find("(1, 1)"), std::string::npos) << result.error().message;
}

TEST(order, what_the_dominant_one_cannot_do_or_is_not_best_at_is_done_greedily) {
  const Field field = testing::random_field(1, 20, 17, Relief::kReal);
  const std::vector<float> ones(field.samples.size(), 1.0f);
  const auto check = [&](const char* words, auto change) {
    SimplifyOptions options{.goals = {.max_error = 5.0}, .quality = {.effort = Effort::kFast}};
    HeightField view = field.view();
    change(options, view);
    options.quality.order = Order::kDominant;
    const auto made = simplify(view, options);
    const bool has_bounds = !options.tolerances.weights.empty() || !options.tolerances.values.empty();
    ASSERT_EQ(made.has_value(), has_bounds) << words;
    if (!has_bounds) {
      EXPECT_EQ(made.error().kind, ErrorKind::kUsage) << words;
      EXPECT_NE(made.error().message.find(words), std::string::npos) << made.error().message;
    }
    options.quality.order = Order::kAuto;
    const auto automatic = simplify(view, options);
    options.quality.order = Order::kGreedy;
    const auto greedy = simplify(view, options);
    ASSERT_TRUE(automatic && greedy) << words;
    EXPECT_EQ(automatic->order, Order::kGreedy) << words;
    EXPECT_EQ(automatic->mesh.positions, greedy->mesh.positions) << words;
    EXPECT_EQ(automatic->mesh.triangles, greedy->mesh.triangles) << words;
  };
  check("mask", [&](auto& o, auto&) { o.tolerances.weights = ones; });
  check("tolerance", [&](auto& o, auto&) { o.tolerances.values = ones; });
  check("channels", [&](auto&, auto& v) { v.channels = {{ones.data(), 1}}; });
  check("points", [](auto& o, auto&) { o.features.points = {{3, 3}}; });
  check("outline", [](auto& o, auto&) { o.domain.outline_tolerance = 1; });
}

TEST(features, vanish_on_a_plane_and_know_a_quadratic) {
  Field plane{9, 8, {}}, bowl{9, 8, {}};
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 9; ++x) {
      plane.samples.push_back(static_cast<float>(3 * x - 2 * y));
      bowl.samples.push_back(static_cast<float>(x * x + 3 * x * y));
    }
  }
  using Feature = Importance::Feature;
  for (const Feature feature : {Feature::kLocal4, Feature::kLocal8, Feature::kCurvature}) {
    for (float value : metric::measure_feature(plane.raster(), {false, feature})) EXPECT_EQ(value, 0);
  }
  // z_xx = 2, z_xy = 3, z_yy = 0; the mean of the neighbours lies 1/2 above in 4, (2 + 0 + 8 − 4) / 8 in 8 directions.
  EXPECT_FLOAT_EQ(metric::measure_feature(bowl.raster(), {false, Feature::kCurvature})[4 * 9 + 4],
                  std::sqrt(4.0f + 18.0f));
  EXPECT_FLOAT_EQ(metric::measure_feature(bowl.raster(), {false, Feature::kLocal4})[4 * 9 + 4], 0.5f);
  EXPECT_FLOAT_EQ(metric::measure_feature(bowl.raster(), {false, Feature::kLocal8})[4 * 9 + 4], 0.75f);
  EXPECT_FLOAT_EQ(
      metric::measure_feature(bowl.raster(), {false, Feature::kLocal4, Importance::Damping::kPlusOne})[4 * 9 + 4],
      1.5f);
}

/// A spike next to a corner, and a lower bump far from corners: errors rank the spike first, errors times distance the
/// bump. One pass cannot rank by features of the mesh.
TEST(features, distance_attenuates_errors_near_vertices) {
  Field field{33, 33, std::vector<float>(33 * 33, 0.0f)};
  field.samples[1 * 33 + 2] = 10;
  field.samples[9 * 33 + 24] = 6;
  const auto first = [&](const Importance& importance) {
    PaperOptions options{.goals = {.max_vertices = 5}};
    options.strategy.importance = importance;
    const auto run = simplify_by_paper(field.view(), options);
    if (!run || run->mesh.vertex_count() != 5) return 0.0;
    double highest = 0;
    for (std::size_t v = 0; v < 5; ++v) highest = std::max(highest, run->mesh.vertex(v)[2]);
    return highest;
  };
  using Feature = Importance::Feature;
  using Damping = Importance::Damping;
  EXPECT_EQ(first({}), 10);
  EXPECT_EQ(first({.feature = Feature::kDistance}), 6);
  EXPECT_EQ(first({.feature = Feature::kDistance, .damping = Damping::kSqrtPlusOne}), 6);
  PaperOptions ranked{.goals = {.max_vertices = 5}};
  ranked.strategy.importance = {false, Feature::kDistance, Damping::kUndamped, true};
  const auto refused = simplify_by_paper(field.view(), ranked);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::kUsage);
}

TEST(batches, independent_ones_cost_few_vertices_and_few_passes) {
  const Field field = testing::random_field(21, 200, 160, Relief::kRidges);
  PaperOptions options{.goals = {.max_error = 4.0}};
  const auto sequential = simplify_by_paper(field.view(), options);
  options.strategy.batch.rule = Batch::Rule::kIndependent;
  const auto independent = simplify_by_paper(field.view(), options);
  options.strategy.batch.rule = Batch::Rule::kConstant;
  const auto constant = simplify_by_paper(field.view(), options);
  ASSERT_TRUE(sequential && independent && constant);
  EXPECT_LT(independent->mesh.vertex_count(), sequential->mesh.vertex_count() * 108 / 100);
  EXPECT_GT(constant->mesh.vertex_count(), independent->mesh.vertex_count());
  EXPECT_LT(independent->work.passes, sequential->work.passes / 10);
  EXPECT_LE(constant->work.passes, independent->work.passes);
}

TEST(strategies, the_default_one_is_the_greedy_order) {
  const Field field = testing::random_field(3, 60, 50, Relief::kRidges);
  for (const Goals& goals : {Goals{.max_error = 2}, Goals{.max_triangles = 300}}) {
    const auto paper = simplify_by_paper(field.view(), {.goals = goals});
    const auto greedy =
        simplify(field.view(), {.goals = goals, .quality = {.effort = Effort::kFast, .order = Order::kGreedy}});
    ASSERT_TRUE(paper && greedy);
    EXPECT_EQ(paper->mesh.positions, greedy->mesh.positions);
    EXPECT_EQ(paper->mesh.triangles, greedy->mesh.triangles);
  }
}

TEST(strategies, contradictions_are_refused_in_one_sentence) {
  const Field field = testing::random_field(1, 9, 7, Relief::kReal);
  const std::vector<float> ones(63, 1.0f), few(5, 1.0f), negative(63, -1.0f), gap(63, NAN);
  const testing::ArraySource stream(field.view());
  const auto refuses = [&](const char* words, auto change) {
    PaperOptions options{.goals = {.max_error = 1.0}};
    HeightField view = field.view();
    change(options, view);
    const auto result = simplify_by_paper(view, options);
    ASSERT_FALSE(result) << words;
    EXPECT_NE(result.error().message.find(words), std::string::npos) << result.error().message;
  };
  refuses("cannot be combined", [&](auto& o, auto&) { o.tolerances.weights = o.tolerances.values = ones; });
  refuses("5 values for 63 samples", [&](auto& o, auto&) { o.tolerances.weights = few; });
  refuses("at sample (0, 0)", [&](auto& o, auto&) { o.tolerances.values = negative; });
  refuses("ranks samples by a feature", [&](auto& o, auto&) { o.strategy.importance.one_pass = true; });
  refuses("leave the batches out", [&](auto& o, auto&) {
    o.strategy.importance = {false, Importance::Feature::kLocal4, Importance::Damping::kUndamped, true};
    o.strategy.batch.rule = Batch::Rule::kConstant;
  });
  refuses("cannot be combined with order = greedy", [&](auto&, auto& v) { v.samples = nullptr, v.source = &stream; });
  refuses("above 0 and at most 1", [&](auto& o, auto&) { o.strategy.batch = {Batch::Rule::kFraction, 1.5}; });
  refuses("shape threshold", [&](auto& o, auto&) { o.strategy.edges.shape_threshold = 2; });
  refuses("supersampling", [&](auto& o, auto&) { o.strategy.edges.supersample = -1; });
  refuses("65 channels", [&](auto&, auto& v) { v.channels.assign(65, {ones.data(), 1}); });
  refuses("weight of channel 1", [&](auto&, auto& v) { v.channels = {{ones.data(), -1}}; });
  refuses("channel 1 at sample (0, 0) has no value", [&](auto&, auto& v) { v.channels = {{gap.data(), 1}}; });
  refuses("every weight is 0", [&](auto&, auto& v) { v.height_scale = 0; });
}

}  // namespace
}  // namespace scarp::strategy_laws_test
