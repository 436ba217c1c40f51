// Fitting with norms of heights and channels: it accepts the same triangles as refinement's error metric.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "fit/fit.h"
#include "fit/norm_error.h"
#include "laws/fit_meshes.h"
#include "laws/mesh_laws.h"
#include "metric/sample_metric.h"

namespace scarp::norm_laws_test {
namespace {

using testing::any_depth;
using testing::Field;
using testing::is_same;
using testing::Relief;

/// Heights, channels with other reliefs, and their scales.
struct Stack {
  std::vector<Field> layers;  // the first is the heights
  std::vector<metric::MetricField> judged;
  Norm norm = Norm::kSum;
  double threshold = 0;
  std::vector<float> bounds;

  const Field& heights() const { return layers[0]; }
  metric::MetricSettings settings() const {
    metric::MetricSettings settings{heights().raster(), judged, norm, threshold};
    if (!bounds.empty()) settings.bounds = bounds.data();
    return settings;
  }
  fit::FitNorm fit_norm(const metric::ErrorMetric& metric) const {
    fit::FitNorm of;
    for (const metric::MetricField& field : judged) of.fields.push_back({field.samples, field.scale});
    of.norm = norm;
    of.find_breach = [&metric](const std::array<Point, 3>& corners) {
      const auto candidate = metric.find_candidate(corners, metric.fit(corners, {}));
      return candidate ? std::optional(candidate->at) : std::nullopt;
    };
    return of;
  }
  double bound_at(Point p) const {
    return bounds.empty() ? threshold : double{bounds[static_cast<std::size_t>(p.y * heights().cols + p.x)]};
  }
  fit::NormError errors(const fit::FitNorm& of, double unit) const {
    fit::NormError::Samples samples{heights().raster(), {}, {0, 0}, {0, 0}};
    for (const metric::MetricField& field : judged) samples.fields.push_back(field.samples);
    return bounds.empty() ? fit::NormError(of, std::move(samples), threshold)
                          : fit::NormError(of, std::move(samples), fit::SampleBounds{bounds.data(), unit});
  }
};

Stack any_stack(std::int32_t largest) {
  const auto cols = *rc::gen::inRange(2, largest), rows = *rc::gen::inRange(2, largest);
  Stack stack;
  const auto count = *rc::gen::element(1, 1, 2, 3, 5);
  for (int k = 0; k <= count; ++k) {
    const int relief = *rc::gen::inRange(0, 5);
    const double nodata = k == 0 ? *rc::gen::element(0.0, 0.0, 0.05, 0.3) : 0.0;
    stack.layers.push_back(
        testing::random_field(*rc::gen::arbitrary<std::uint32_t>(), cols, rows, testing::kReliefs[relief], nodata));
  }
  for (std::size_t k = 0; k < stack.layers.size(); ++k) {
    const double scale = *rc::gen::element(1.0, 1.0, 0.3, 20.0);
    const bool counts = k > 0 || *rc::gen::arbitrary<bool>();
    if (counts) stack.judged.push_back({stack.layers[k].samples.data(), scale});
  }
  // Channels may have any value at nodata heights.
  for (std::size_t i = 0; i < stack.layers[0].samples.size(); ++i) {
    if (std::isnan(stack.layers[0].samples[i])) stack.layers[1].samples[i] = std::numeric_limits<float>::infinity();
  }
  stack.norm = *rc::gen::element(Norm::kSum, Norm::kSquares, Norm::kMax);
  stack.threshold = *rc::gen::element(0.0, 0.5, 1.0, 2.0, 7.3, 30.0, 400.0);
  if (*rc::gen::inRange(0, 3) == 0) {
    std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
    const float levels[] = {1, 4, 4.5f, 90, 0, std::numeric_limits<float>::infinity()};
    for (std::size_t i = 0; i < stack.heights().samples.size(); ++i) stack.bounds.push_back(levels[random() % 6]);
  }
  return stack;
}

fit::FitCorner at_sample(const Stack& stack, Point p) {
  return {p.x * grid::kLatticeSteps, p.y * grid::kLatticeSteps, stack.heights().raster().at(p)};
}

/// Three valid samples, counter-clockwise; none if all or too many samples are collinear.
std::optional<std::array<Point, 3>> any_corners(const Stack& stack) {
  std::vector<Point> valid;
  for (Point p{0, 0}; p.y < stack.heights().rows; ++p.y) {
    for (p.x = 0; p.x < stack.heights().cols; ++p.x) {
      if (stack.heights().raster().is_valid(p)) valid.push_back(p);
    }
  }
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  for (int tries = 0; tries < 100 && !valid.empty(); ++tries) {
    std::array<Point, 3> corners;
    for (Point& p : corners) p = valid[random() % valid.size()];
    if (orient(corners[0], corners[1], corners[2]) < 0) std::swap(corners[1], corners[2]);
    if (orient(corners[0], corners[1], corners[2]) > 0) return corners;
  }
  return std::nullopt;
}

/// Computes in double, sample by sample.
struct Oracle {
  double worst = 0, energy = 0;         // in bounds
  std::vector<double> stiffness, push;  // for each field
  double excess = 0, over_bound = 0;    // largest norm minus slack bounds; minus bounds

  Oracle(const Stack& stack, const std::array<Point, 3>& corners, double unit, double slack = 1)
      : stiffness(stack.judged.size(), 0), push(stack.judged.size(), 0) {
    excess = over_bound = -std::numeric_limits<double>::infinity();
    const Field& heights = stack.heights();
    const auto area = static_cast<double>(orient(corners[0], corners[1], corners[2]));
    for (Point p{0, 0}; p.y < heights.rows; ++p.y) {
      for (p.x = 0; p.x < heights.cols; ++p.x) {
        std::array<double, 3> weights;
        bool inside = heights.raster().is_valid(p);
        for (std::size_t k = 0; k < 3; ++k) {
          weights[k] = static_cast<double>(orient(corners[(k + 1) % 3], corners[(k + 2) % 3], p)) / area;
          inside = inside && weights[k] >= 0;
        }
        if (inside) add(stack, corners, p, weights, unit, slack);
      }
    }
  }

 private:
  void add(const Stack& stack, const std::array<Point, 3>& corners, Point p, const std::array<double, 3>& weights,
           double unit, double slack) {
    std::vector<double> errors;
    double sum = 0, squares = 0, largest = 0;
    for (const metric::MetricField& field : stack.judged) {
      const grid::Raster values{field.samples, stack.heights().cols, stack.heights().rows};
      double error = -values.at(p);
      for (std::size_t k = 0; k < 3; ++k) error += weights[k] * double{values.at(corners[k])};
      errors.push_back(field.scale * error);
      sum += std::abs(errors.back());
      squares += errors.back() * errors.back();
      largest = std::max(largest, std::abs(errors.back()));
    }
    const double norm = stack.norm == Norm::kSum ? sum : stack.norm == Norm::kMax ? largest : std::sqrt(squares);
    const double bound = stack.bound_at(p);
    if (std::isinf(bound)) return;
    excess = std::max(excess, norm - slack * bound);
    over_bound = std::max(over_bound, norm - bound);
    if (!(bound > 1e-3)) return;
    worst = std::max(worst, norm / bound);
    energy += std::pow(norm / bound, 8);
    const double share = weights[0] * unit / bound;
    for (std::size_t k = 0; k < errors.size(); ++k) {
      const double t = errors[k] / bound;
      const double weight = std::pow(stack.norm == Norm::kMax ? t : norm / bound, 6);
      stiffness[k] += weight * share * share;
      push[k] += weight * t * share;
    }
  }
};

constexpr float kAnyEnergy = std::numeric_limits<float>::infinity();
using Kind = fit::TriangleError::Verdict::Kind;

RC_GTEST_PROP(norms, of_a_triangle_are_decided_as_refinement_does, ()) {
  const Stack stack = any_stack(*rc::gen::element(6, 30));
  const auto corners = any_corners(stack);
  RC_PRE(corners.has_value());
  const metric::SampleMetric metric(stack.settings());
  const fit::FitNorm norm = stack.fit_norm(metric);
  const double unit = stack.bounds.empty() ? stack.threshold : 4;
  const fit::NormError error = stack.errors(norm, unit);
  const fit::NormError::Corners at{at_sample(stack, (*corners)[0]), at_sample(stack, (*corners)[1]),
                                   at_sample(stack, (*corners)[2])};
  const auto power = *rc::gen::element(fit::ErrorRule::Power::kTwo, fit::ErrorRule::Power::kEight);
  const bool keeps = !norm.find_breach(*corners);
  const auto verdict = error.assess(at, kAnyEnergy, {1, power});
  RC_ASSERT((verdict.kind == Kind::kKeeps) == keeps);
  const Oracle strict(stack, *corners, unit);
  if (keeps) {
    RC_ASSERT(verdict.worst <= 1);
    RC_ASSERT(strict.over_bound <= 1e-9 * (1 + strict.worst));
  } else {
    const Point p = verdict.witness;
    RC_ASSERT(stack.heights().raster().is_valid(p));
    for (std::size_t k = 0; k < 3; ++k) RC_ASSERT(orient((*corners)[k], (*corners)[(k + 1) % 3], p) >= 0);
  }
  if (!error.has_energy()) return;
  const double slack = 2.5;
  const auto loose = error.assess(at, kAnyEnergy, {slack, fit::ErrorRule::Power::kEight});
  const Oracle wide(stack, *corners, unit, slack);
  constexpr double kDoubtful = 1e-2;
  if (std::abs(wide.excess) > kDoubtful) RC_ASSERT((loose.kind == Kind::kKeeps) == (wide.excess < 0));
  if (loose.kind != Kind::kKeeps) return;
  RC_ASSERT((loose.worst <= 1) == keeps);
  RC_ASSERT(std::abs(double{loose.energy} - wide.energy) <= 1e-2 * (1 + wide.energy));
  RC_ASSERT(error.assess(at, 0, {slack, fit::ErrorRule::Power::kEight}).kind == Kind::kCostly);
}

RC_GTEST_PROP(norms, pull_as_the_samples_do, ()) {
  Stack stack = any_stack(20);
  stack.threshold = std::max(stack.threshold, 0.5);
  for (float& bound : stack.bounds) bound = std::max(bound, 0.5f);
  const auto corners = any_corners(stack);
  RC_PRE(corners.has_value());
  const double unit = stack.bounds.empty() ? stack.threshold : 4;
  const Oracle oracle(stack, *corners, unit);
  RC_PRE(oracle.worst < 10);
  const metric::SampleMetric metric(stack.settings());
  const fit::FitNorm norm = stack.fit_norm(metric);
  std::vector<fit::TriangleError::Pull> pulls;
  stack.errors(norm, unit)
      .pull({at_sample(stack, (*corners)[0]), at_sample(stack, (*corners)[1]), at_sample(stack, (*corners)[2])},
            fit::ErrorRule::Power::kEight, pulls);
  RC_ASSERT(pulls.size() == stack.judged.size());
  for (std::size_t k = 0; k < pulls.size(); ++k) {
    RC_ASSERT(std::abs(pulls[k].stiffness - oracle.stiffness[k]) <= 1e-2 * (1 + oracle.stiffness[k]));
    RC_ASSERT(std::abs(pulls[k].push - oracle.push[k]) <= 1e-2 * (1 + 8 * oracle.energy + oracle.stiffness[k]));
  }
}

std::optional<tin::Triangulation> refined(const Stack& stack) {
  auto domain = refine::build_domain(stack.heights().raster(), 0, grid_frame(stack.heights().rows));
  if (!domain) return std::nullopt;
  const metric::SampleMetric metric(stack.settings());
  refine::Refinement refinement(metric, domain->tin);
  while (!refinement.done()) refinement.insert_worst();
  return std::move(domain->tin);
}

RC_GTEST_PROP(norms, are_kept_by_every_effort_on_any_number_of_threads, ()) {
  const Stack stack = any_stack(*rc::gen::element(10, 50));
  auto tin = refined(stack);
  RC_PRE(tin.has_value());
  const std::size_t before = tin->triangle_count();
  const metric::SampleMetric metric(stack.settings());
  const fit::FitNorm norm = stack.fit_norm(metric);
  fit::FitOptions options{.threshold = stack.threshold,
                          .bounds = stack.bounds,
                          .norm = &norm,
                          .threads = 1,
                          .depth = any_depth(0),
                          .min_shape = *rc::gen::element(0.0, 0.1),
                          .vertices_are_free = *rc::gen::arbitrary<bool>(),
                          .patch_side = *rc::gen::element(0, 5, 16)};
  const auto first = *fit::fit(stack.heights().raster(), std::move(*tin), options);
  RC_ASSERT(first.lattice.are_samples());
  RC_ASSERT(first.tin.triangle_count() <= before);
  for (tin::Triangle t = 0; t < first.tin.triangle_count(); ++t)
    RC_ASSERT(first.tin.is_outside(t) || !norm.find_breach(first.tin.corners(t)));
  RC_ASSERT(
      testing::verify_triangulation(first.tin, stack.heights().cols, stack.heights().rows, testing::Edges::kAny) == "");
  options.threads = 3;
  const auto again = *fit::fit(stack.heights().raster(), *refined(stack), options);
  RC_ASSERT(is_same(again.tin, first.tin));
}

// Channels without new information count like heights.
TEST(norms, of_the_same_field_thrice_take_as_many_triangles_as_heights_alone) {
  const Field field = testing::random_field(7, 200, 150, Relief::kRidges);
  Stack stack{{field}, {}, Norm::kMax, 4, {}};
  for (int k = 0; k < 3; ++k) stack.judged.push_back({stack.layers[0].samples.data(), 1});
  const metric::SampleMetric metric(stack.settings());
  const fit::FitNorm norm = stack.fit_norm(metric);
  for (const fit::FitDepth& depth : {fit::FitDepth{}, fit::kHighDepth}) {
    fit::FitOptions options{.threshold = 4, .depth = depth};
    const auto plain = *fit::fit(field.raster(), *testing::refined(field, 4), options);
    options.norm = &norm;
    const auto combined = *fit::fit(field.raster(), *refined(stack), options);
    const auto count = static_cast<double>(plain.tin.triangle_count());
    EXPECT_NEAR(static_cast<double>(combined.tin.triangle_count()), count, 0.01 * count);
  }
}

}  // namespace
}  // namespace scarp::norm_laws_test
