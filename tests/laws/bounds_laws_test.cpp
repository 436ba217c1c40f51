// Efforts with bounds of samples: every sample satisfies its own bound, even if that is 0, none, or a thousand times
// its neighbour's.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <utility>

#include "fit/fit.h"
#include "geom/exact_error.h"
#include "laws/array_bounds.h"
#include "laws/fit_meshes.h"
#include "laws/mesh_laws.h"
#include "laws/sanitized.h"
#include "laws/tile_meshes.h"
#include "metric/sample_metric.h"
#include "scarp/measure.h"
#include "scarp/simplify.h"

namespace scarp::bounds_laws_test {
namespace {

using testing::any_depth;
using testing::any_field;
using testing::Field;
using testing::is_same;
using testing::kNoBound;
using testing::Relief;

std::vector<float> any_bounds(const Field& field) { return testing::any_bounds(field.cols, field.rows); }

/// The greedy mesh; none without a surface.
std::optional<tin::Triangulation> refined(const Field& field, const std::vector<float>& bounds) {
  auto domain = refine::build_domain(field.raster(), 0, grid_frame(field.rows));
  if (!domain) return std::nullopt;
  metric::MetricSettings settings{field.raster(), {{field.samples.data(), 1}}};
  settings.bounds = bounds.data();
  const metric::SampleMetric metric(settings);
  refine::Refinement refinement(metric, domain->tin);
  while (!refinement.done()) refinement.insert_worst();
  return std::move(domain->tin);
}

float bound_at(const Field& field, const std::vector<float>& bounds, Point p) {
  return bounds[static_cast<std::size_t>(p.y) * static_cast<std::size_t>(field.cols) + static_cast<std::size_t>(p.x)];
}

/// A triangle on the lattice, by exact arithmetic and by doubles, at every sample of the field in it.
struct Oracle {
  bool keeps = true;
  double energy = 0, stiffness = 0, push = 0, worst = 0;  // over samples whose bound is at least `least`

  Oracle(const Field& field, const std::vector<float>& bounds, const std::array<Point, 3>& places,
         const std::array<float, 3>& heights, double least = 1e-2) {
    const auto area = static_cast<double>(orient(places[0], places[1], places[2]));
    const auto [left, right] = std::minmax({places[0].x, places[1].x, places[2].x});
    const auto [top, bottom] = std::minmax({places[0].y, places[1].y, places[2].y});
    for (Point p{0, top / grid::kLatticeSteps}; p.y * grid::kLatticeSteps <= bottom; ++p.y) {
      for (p.x = left / grid::kLatticeSteps; p.x * grid::kLatticeSteps <= right; ++p.x) {
        const double bound = bound_at(field, bounds, p);
        bool inside = field.raster().is_valid(p) && !std::isinf(bound);
        const Point at{p.x * grid::kLatticeSteps, p.y * grid::kLatticeSteps};
        double height = 0, share = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          const std::int64_t weight = orient(places[(k + 1) % 3], places[(k + 2) % 3], at);
          inside = inside && weight >= 0;
          height += static_cast<double>(weight) / area * double{heights[k]};
          if (k == 0) share = static_cast<double>(weight) / area / bound;
        }
        if (!inside) continue;
        keeps = keeps && !geom::exceeds_exactly(places, heights, at, field.raster().at(p), bound);
        if (bound < least) continue;
        const double error = (height - double{field.raster().at(p)}) / bound;
        energy += std::pow(error, 8);
        stiffness += std::pow(error, 6) * share * share;
        push += std::pow(error, 7) * share;
        worst = std::max(worst, std::abs(error));
      }
    }
  }
};

bool keeps_bounds(const Field& field, const std::vector<float>& bounds, const fit::Fitted& fitted) {
  const std::int32_t scale = grid::kLatticeSteps / fitted.lattice.steps;
  for (tin::Triangle t = 0; t < fitted.tin.triangle_count(); ++t) {
    if (fitted.tin.is_outside(t)) continue;
    std::array<Point, 3> places = fitted.tin.corners(t);
    std::array<float, 3> heights;
    for (unsigned k = 0; k < 3; ++k) {
      heights[k] = fitted.lattice.are_samples() ? field.raster().at(places[k])
                                                : fitted.lattice.heights[fitted.tin.origin(3 * t + k)];
      places[k] = {places[k].x * scale, places[k].y * scale};
    }
    if (!Oracle(field, bounds, places, heights).keeps) return false;
  }
  return true;
}

RC_GTEST_PROP(bounds, of_a_triangle_are_decided_as_exact_arithmetic_does, ()) {
  const Field field = any_field();
  const std::vector<float> bounds = any_bounds(field);
  const std::array<fit::FitCorner, 3> corners{any_corner(field), any_corner(field), any_corner(field)};
  RC_PRE(fit::area2(corners[0], corners[1], corners[2]) > 0);
  std::array<Point, 3> places;
  std::array<float, 3> heights;
  for (std::size_t k = 0; k < 3; ++k) {
    places[k] = {corners[k].x, corners[k].y};
    heights[k] = corners[k].z;
  }
  const Oracle oracle(field, bounds, places, heights);
  const fit::TriangleError error(field.raster(), {0, 0}, fit::SampleBounds{bounds.data(), 0.25},
                                 {1, *rc::gen::element(fit::ErrorRule::Power::kTwo, fit::ErrorRule::Power::kEight)});
  const auto verdict = error.assess(corners[0], corners[1], corners[2], std::numeric_limits<float>::infinity());
  RC_ASSERT((verdict.kind == fit::TriangleError::Verdict::Kind::kKeeps) == oracle.keeps);
  if (oracle.keeps) {
    RC_ASSERT(verdict.worst <= 1);
  } else {
    RC_ASSERT(geom::exceeds_exactly(
        places, heights, {verdict.witness.x * grid::kLatticeSteps, verdict.witness.y * grid::kLatticeSteps},
        field.raster().at(verdict.witness), double{bound_at(field, bounds, verdict.witness)}));
  }
  const double slack = 2.5;
  const fit::TriangleError loose = error.with({slack, fit::ErrorRule::Power::kEight});
  const auto passed = loose.assess(corners[0], corners[1], corners[2], std::numeric_limits<float>::infinity());
  if (passed.kind == fit::TriangleError::Verdict::Kind::kKeeps) {
    RC_ASSERT((passed.worst <= 1) == oracle.keeps);
  } else {
    RC_ASSERT(!oracle.keeps);
  }
}

RC_GTEST_PROP(bounds, pull_as_the_samples_do, ()) {
  const Field field = any_field();
  std::vector<float> bounds = any_bounds(field);
  for (float& bound : bounds) bound = std::max(bound, 0.5f);
  const std::array<fit::FitCorner, 3> corners{any_corner(field), any_corner(field), any_corner(field)};
  RC_PRE(fit::area2(corners[0], corners[1], corners[2]) > 0);
  const Oracle oracle(field, bounds,
                      {Point{corners[0].x, corners[0].y}, {corners[1].x, corners[1].y}, {corners[2].x, corners[2].y}},
                      {corners[0].z, corners[1].z, corners[2].z});
  RC_PRE(oracle.worst < 10);
  const double unit = 4;
  const fit::TriangleError error(field.raster(), {0, 0}, fit::SampleBounds{bounds.data(), unit},
                                 {1, fit::ErrorRule::Power::kEight});
  const auto pull = error.pull(corners[0], corners[1], corners[2]);
  const double stiffness = oracle.stiffness * unit * unit, push = oracle.push * unit;
  RC_ASSERT(std::abs(pull.stiffness - stiffness) <= 1e-2 * (1 + stiffness));
  RC_ASSERT(std::abs(pull.push - push) <= 1e-2 * (1 + unit * 2 * oracle.energy));
  fit::TriangleError::Moments moments{};
  error.add_moments(corners[0], corners[1], corners[2], moments);
  RC_ASSERT(std::abs(moments[0] - oracle.energy) <= 1e-2 * (1 + oracle.energy));
  RC_ASSERT(std::abs(moments[2] - stiffness) <= 1e-2 * (1 + stiffness));
}

RC_GTEST_PROP(bounds, are_kept_by_every_effort_on_any_number_of_threads, ()) {
  const Field field = any_field();
  const std::vector<float> bounds = any_bounds(field);
  RC_PRE(refined(field, bounds).has_value());
  fit::FitOptions options{.bounds = bounds,
                          .threads = 1,
                          .depth = any_depth(0),
                          .min_shape = *rc::gen::element(0.0, 0.1),
                          .vertices_are_free = *rc::gen::arbitrary<bool>(),
                          .patch_side = *rc::gen::element(0, 5, 16, 40)};
  const auto first = *fit::fit(field.raster(), *refined(field, bounds), options);
  RC_ASSERT(keeps_bounds(field, bounds, first));
  const std::int32_t steps = first.lattice.steps;
  const std::string unsound = testing::verify_triangulation(first.tin, (field.cols - 1) * steps + 1,
                                                            (field.rows - 1) * steps + 1, testing::Edges::kAny);
  RC_ASSERT(unsound == "");
  options.threads = 3;
  const auto again = *fit::fit(field.raster(), *refined(field, bounds), options);
  RC_ASSERT(is_same(again.tin, first.tin));
}

RC_GTEST_PROP(bounds, that_are_all_the_same_are_a_threshold, ()) {
  const Field field = any_field();
  const double threshold = testing::any_threshold();
  RC_PRE(testing::refined(field, threshold).has_value());
  fit::FitOptions options{.threshold = double{static_cast<float>(threshold)},
                          .depth = any_depth(0),
                          .vertices_are_free = *rc::gen::arbitrary<bool>(),
                          .patch_side = *rc::gen::element(0, 16)};
  auto tin = testing::refined(field, options.threshold);
  const auto plain = *fit::fit(field.raster(), std::move(*tin), options);
  const std::vector<float> bounds(field.samples.size(), static_cast<float>(threshold));
  options.bounds = bounds;
  const auto bounded = *fit::fit(field.raster(), *testing::refined(field, options.threshold), options);
  RC_ASSERT(is_same(bounded.tin, plain.tin));
}

TEST(bounds, that_are_all_but_one_the_same_take_as_many_triangles_as_a_threshold) {
  const Field field = testing::random_field(7, 200, 150, Relief::kRidges);
  std::vector<float> bounds(field.samples.size(), 4.0f);
  bounds[0] = 8;  // a corner, which is always a vertex
  for (const bool free : {false, true}) {
    const std::vector<fit::FitDepth> depths =
        testing::kIsSanitized ? std::vector{fit::FitDepth{}} : std::vector{fit::FitDepth{}, fit::kHighDepth};
    for (const fit::FitDepth& depth : depths) {
      fit::FitOptions options{.threshold = 4, .depth = depth, .vertices_are_free = free};
      const auto plain = *fit::fit(field.raster(), *testing::refined(field, 4), options);
      options.bounds = bounds;
      const auto bounded = *fit::fit(field.raster(), *testing::refined(field, 4), options);
      const auto count = static_cast<double>(plain.tin.triangle_count());
      EXPECT_NEAR(static_cast<double>(bounded.tin.triangle_count()), count, 0.01 * count);
    }
  }
}

TEST(bounds, that_fall_across_a_field_take_fewer_triangles_with_each_effort) {
  const Field field = testing::random_field(7, 200, 150, Relief::kRidges);
  std::vector<float> bounds;
  for (int i = 0; i < 200 * 150; ++i) bounds.push_back(2 * std::ldexp(1.0f, i % 200 / 20));
  std::size_t before = SIZE_MAX;
  for (const auto& [effort, vertices] : {std::pair{Effort::kFast, Vertices::kSamples},
                                         {Effort::kNormal, Vertices::kSamples},
                                         {Effort::kHigh, Vertices::kSamples},
                                         {Effort::kHigh, Vertices::kFree}}) {
    SimplifyOptions options;
    options.tolerances.values = bounds;
    options.quality.effort = effort;
    options.quality.vertices = vertices;
    if (effort != Effort::kFast) options.quality.min_shape = 0;
    const auto result = simplify(field.view(), options);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_LT(static_cast<double>(result->mesh.triangle_count()), 0.9 * static_cast<double>(before));
    before = result->mesh.triangle_count();
  }
}

RC_GTEST_PROP(bounds, are_kept_in_the_eyes_of_the_judge, ()) {
  const Field field = any_field();
  std::vector<float> bounds = any_bounds(field), mask;
  std::vector<SampleAt> ignored;
  SimplifyOptions options;
  options.quality.effort = *rc::gen::element(Effort::kFast, Effort::kNormal, Effort::kHigh);
  options.quality.order = *rc::gen::element(Order::kAuto, Order::kDominant);
  options.quality.vertices = *rc::gen::element(Vertices::kAuto, Vertices::kSamples);
  options.output.float32_positions = *rc::gen::arbitrary<bool>();
  const int kind = *rc::gen::inRange(0, 3);
  if (kind == 0) options.tolerances.values = bounds;
  if (kind == 1) {
    options.goals.max_error = 2;
    for (float& bound : bounds) {
      mask.push_back(std::isinf(bound) || bound == 0 ? 0 : 1 / bound);
      bound = mask.back() > 0 ? 2 / mask.back() : kNoBound;
    }
    options.tolerances.weights = mask;
  }
  if (kind == 2) {
    options.goals.max_error = 0.5;
    bounds.assign(bounds.size(), 0.5f);
    bounds[bounds.size() / 2] = kNoBound;
    const auto at = static_cast<std::int32_t>(bounds.size() / 2);
    ignored = {{at % field.cols, at / field.cols}};
    options.tolerances.ignored = ignored;
  }
  HeightField view = field.view();
  if (*rc::gen::arbitrary<bool>()) {
    view.frame.kind = Frame::Kind::kSource;
    view.frame.affine = {4321987.123, 6.7218131, 0, 5123456.789, 0, -6.7218131};
  }
  const auto result = simplify(view, options);
  if (!result) {
    RC_ASSERT(result.error().kind == ErrorKind::kInput || result.error().kind == ErrorKind::kPromise);
    RC_ASSERT(result.error().kind == ErrorKind::kInput || options.output.float32_positions);
    return;
  }
  for (float& bound : bounds) bound = bound * 1.000001f + 1e-6f;
  MeasureOptions metric;
  metric.tolerance = bounds;
  const Measurement m = *measure(view, result->mesh, metric);
  RC_ASSERT(m.over_tolerance == 0u);
  RC_ASSERT(m.uncovered == 0u);
  RC_ASSERT(m.is_sound());
}

TEST(bounds, are_kept_in_the_dominant_order_on_any_number_of_threads) {
  const int cols = testing::fewer(360), rows = testing::fewer(280);
  const Field field = testing::random_field(11, cols, rows, Relief::kRidges, 0.001);
  std::vector<float> bounds;
  for (int k = 0; k < cols * rows; ++k) bounds.push_back(k % cols < cols / 2 ? 12.0f : 4.0f);
  std::vector<float> mask = bounds;
  for (float& weight : mask) weight = 4 / weight;
  for (const bool is_mask : {false, true}) {
    SimplifyOptions options{.quality = {.effort = Effort::kFast, .order = Order::kDominant}};
    if (is_mask) options.tolerances.weights = mask, options.goals.max_error = 4;
    if (!is_mask) options.tolerances.values = bounds;
    options.run.threads = 1;
    const auto one = *simplify(field.view(), options);
    options.run.threads = 3;
    const auto three = *simplify(field.view(), options);
    EXPECT_EQ(one.order, Order::kDominant);
    EXPECT_EQ(one.mesh.positions, three.mesh.positions);
    EXPECT_EQ(one.mesh.triangles, three.mesh.triangles);
    MeasureOptions metric;
    metric.tolerance = bounds;
    const Measurement m = *measure(field.view(), one.mesh, metric);
    EXPECT_EQ(m.over_tolerance, 0u);
    EXPECT_EQ(m.uncovered, 0u);
    EXPECT_TRUE(m.is_sound());
    options.quality.order = Order::kGreedy;
    const auto greedy = *simplify(field.view(), options);
    EXPECT_EQ(greedy.order, Order::kGreedy);
    EXPECT_LT(static_cast<double>(one.mesh.triangle_count()), 1.1 * static_cast<double>(greedy.mesh.triangle_count()));
  }
}

TEST(bounds, that_some_samples_lack_leave_nothing_to_tiles) {
  const Field field = testing::random_field(11, 100, 80, Relief::kRidges);
  std::vector<float> bounds(field.samples.size(), 5.0f);
  bounds[4321] = kNoBound;
  SimplifyOptions options{.quality = {.effort = Effort::kFast}};
  options.tolerances.values = bounds;
  const auto plain = *simplify(field.view(), options);
  options.quality.order = Order::kDominant;
  const auto made = *simplify(field.view(), options);
  EXPECT_EQ(made.order, Order::kGreedy);
  EXPECT_EQ(made.mesh.positions, plain.mesh.positions);
}

TEST(bounds, of_a_mask_are_kept_by_efforts_within_a_budget) {
  const Field field = testing::random_field(25, 60, 50, Relief::kRidges);
  std::vector<float> mask(field.samples.size(), 1.0f);
  for (std::size_t k = 0; k < mask.size(); ++k) mask[k] = k % 60 < 30 ? 1.0f : 0.125f;
  SimplifyOptions options;
  options.tolerances.weights = mask;
  options.goals.max_triangles = 700;
  options.quality.effort = Effort::kFast;
  const auto fast = simplify(field.view(), options);
  options.quality.effort = Effort::kHigh;
  const auto high = simplify(field.view(), options);
  ASSERT_TRUE(fast && high);
  EXPECT_LE(high->mesh.triangle_count(), 700u);
  EXPECT_LT(high->weighted_max_error, 0.8 * fast->weighted_max_error);
}

TEST(bounds, points_stay_whatever_the_effort) {
  const Field field = testing::random_field(25, 40, 30, Relief::kRidges);
  SimplifyOptions options;
  options.goals.max_error = 5;
  for (std::int32_t k = 0; k < 12; ++k) options.features.points.push_back({3 * k + 2, 2 * k + 3});
  for (const Effort effort : {Effort::kFast, Effort::kNormal, Effort::kHigh, Effort::kMax}) {
    options.quality.effort = effort;
    const auto made = simplify(field.view(), options);
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_LE(made->measurement.max_error, 5);
    for (const SampleAt& step : options.features.points) {
      bool is_vertex = false;
      for (std::size_t v = 0; v < made->mesh.vertex_count(); ++v) {
        const auto at = made->mesh.vertex(v);
        is_vertex = is_vertex || (at[0] == step.col && at[1] == 29 - step.row);
      }
      EXPECT_TRUE(is_vertex) << step.col << ", " << step.row;
    }
  }
}

}  // namespace
}  // namespace scarp::bounds_laws_test
