// Laws of points in blocks: the guarantee at all points, and independence of threads.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "laws/point_sets.h"
#include "scarp/measure.h"
#include "scarp/point_blocks.h"
#include "scarp/points.h"

namespace scarp::point_blocks_laws_test {
namespace {

using testing::Heights;
using testing::Scatter;

/// Consecutive parts of a set as blocks, some of them empty.
class Parts final : public PointBlocks {
 public:
  Parts(PointSet points, std::vector<std::size_t> ends) : points_(std::move(points)), ends_(std::move(ends)) {
    ends_.push_back(points_.size());
    std::sort(ends_.begin(), ends_.end());
  }
  std::uint64_t size() const override { return points_.size(); }
  std::size_t block_count() const override { return ends_.size(); }
  Result<PointSet> read(std::size_t block) const override {
    PointSet part;
    for (std::size_t i = block == 0 ? 0 : ends_[block - 1]; i < ends_[block]; ++i) {
      part.x.push_back(points_.x[i]);
      part.y.push_back(points_.y[i]);
      part.z.push_back(points_.z[i]);
    }
    return part;
  }
  const PointSet& points() const { return points_; }

 private:
  PointSet points_;
  std::vector<std::size_t> ends_;
};

/// Up to `most` sorted points at distinct places. Rolling land has runs that need few of them.
PointSet any_points(int most) {
  const Scatter scatter =
      *rc::gen::elementOf(std::vector<Scatter>(std::begin(testing::kScatters), std::end(testing::kScatters)));
  const PointSet all = testing::random_points(*rc::gen::arbitrary<std::uint32_t>(), *rc::gen::inRange(3, most), scatter,
                                              *rc::gen::element(Heights::kReal, Heights::kSteps));
  const bool is_rolling = *rc::gen::arbitrary<bool>();
  PointSet points;
  std::set<std::pair<double, double>> places;
  const auto [west, east] = std::minmax_element(all.x.begin(), all.x.end());
  const double size = std::max(*east - *west, 1e-9);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!places.emplace(all.x[i], all.y[i]).second) continue;
    const double u = (all.x[i] - *west) / size, v = (all.y[i] - all.y[0]) / size;
    points.x.push_back(all.x[i]);
    points.y.push_back(all.y[i]);
    points.z.push_back(is_rolling ? 30 * std::sin(9 * u) * std::cos(7 * v) + 0.03 * all.z[i] : all.z[i]);
  }
  sort_points(points);
  return points;
}

Parts any_parts(int most) {
  PointSet points = any_points(most);
  const int size = static_cast<int>(points.size());
  std::vector<std::size_t> ends;
  for (int k = *rc::gen::inRange(0, 6); k > 0; --k)
    ends.push_back(static_cast<std::size_t>(*rc::gen::inRange(0, size + 1)));
  return {std::move(points), std::move(ends)};
}

Quality any_quality() { return {.effort = *rc::gen::element(Effort::kAuto, Effort::kFast, Effort::kNormal)}; }

/// False if all points are on one line; then nothing is guaranteed.
bool has_area(const PointSet& points) {
  return simplify_points(points, {.max_error = 1000, .float32_positions = false, .quality = {.effort = Effort::kFast}})
      .has_value();
}

RC_GTEST_PROP(point_blocks, keep_the_promise_in_the_eyes_of_the_textbook, ()) {
  const Parts parts = any_parts(1500);
  RC_PRE(has_area(parts.points()));
  const double goal = *rc::gen::element(0.5, 1.0, 3.0, 20.0);
  const auto result = simplify_points(parts, {.max_error = goal, .float32_positions = false, .quality = any_quality()});
  if (!result) RC_FAIL(result.error().message);
  const Measurement& m = result->made.simplified.measurement;
  RC_ASSERT(m.is_sound());
  RC_ASSERT(m.uncovered == 0u);
  RC_ASSERT(m.samples == parts.size() && result->made.points == parts.size());
  RC_ASSERT(m.max_error <= goal + 1e-12 * (goal + 50));
  const Mesh& mesh = result->made.simplified.mesh;
  const Measurement whole = *measure_points(parts.points(), mesh, DuplicatePolicy::kFirst, {});
  RC_ASSERT(whole.uncovered == 0u && whole.max_error == m.max_error);
  // The textbook does not find a point that lies a rounding error outside the hull.
  RC_ASSERT(testing::judge_by_brute_force(parts.points(), mesh).second < m.max_error + 1e-5);
}

RC_GTEST_PROP(point_blocks, have_the_errors_of_all_points_within_a_budget, ()) {
  const Parts parts = any_parts(800);
  RC_PRE(has_area(parts.points()));
  const auto result = simplify_points(
      parts, {.max_triangles = *rc::gen::inRange(300u, 600u), .float32_positions = false, .quality = any_quality()});
  if (!result) {  // the hull of points on a circle alone is larger
    RC_ASSERT(result.error().kind == ErrorKind::kUsage);
    return;
  }
  const Simplified& made = result->made.simplified;
  const auto judged = *measure_points(parts.points(), made.mesh, DuplicatePolicy::kFirst, {});
  RC_ASSERT(judged.max_error == made.measurement.max_error);
  RC_ASSERT(judged.samples == made.measurement.samples);
  RC_ASSERT(std::abs(judged.rmse - made.measurement.rmse) <= 1e-9 * judged.rmse);
  const auto worst = static_cast<std::size_t>(made.measurement.max_error_at[0]);
  PointSet at_worst;
  at_worst.x = {result->kept.x[worst]};
  at_worst.y = {result->kept.y[worst]};
  at_worst.z = {result->kept.z[worst]};
  const auto [missed, error] = testing::judge_by_brute_force(at_worst, made.mesh);
  RC_ASSERT(missed == 1 || std::abs(error - judged.max_error) < 1e-5);  // it may lie a rounding error outside the hull
}

RC_GTEST_PROP(point_blocks, give_one_mesh_for_any_number_of_threads, ()) {
  const Parts parts = any_parts(1500);
  RC_PRE(has_area(parts.points()));
  PointOptions options{.max_error = *rc::gen::element(0.5, 2.0), .quality = any_quality()};
  options.run.threads = 1;
  const auto one = simplify_points(parts, options);
  options.run.threads = 3;
  const auto three = simplify_points(parts, options);
  RC_ASSERT(one.has_value() == three.has_value());
  if (!one) return;
  RC_ASSERT(one->made.simplified.mesh.positions == three->made.simplified.mesh.positions);
  RC_ASSERT(one->made.simplified.mesh.triangles == three->made.simplified.mesh.triangles);
}

RC_GTEST_PROP(point_blocks, judge_like_one_set, ()) {
  const Parts parts = any_parts(600);
  RC_PRE(has_area(parts.points()));
  auto made = simplify_points(parts.points(), {.max_error = 5, .float32_positions = false});
  if (!made) RC_FAIL(made.error().message);
  Mesh& mesh = made->simplified.mesh;
  const bool is_damaged = mesh.triangle_count() > 1 && *rc::gen::arbitrary<bool>();
  if (is_damaged) mesh.triangles.resize(mesh.triangles.size() - 3);
  const Measurement whole = *measure_points(parts.points(), mesh, DuplicatePolicy::kFirst, {});
  const auto judged = measure_points(parts, mesh, MeasureOptions());
  if (!judged) RC_FAIL(judged.error().message);
  const Measurement& m = judged->measured;
  RC_ASSERT(m.max_error == whole.max_error && m.samples == whole.samples && m.uncovered == whole.uncovered);
  RC_ASSERT(m.p50 == whole.p50 && m.p999 == whole.p999 && std::abs(m.rmse - whole.rmse) <= 1e-9 * whole.rmse);
  RC_ASSERT(m.is_sound() == whole.is_sound() && m.gaps == whole.gaps && m.open_edges == whole.open_edges);
}

TEST(PointBlocks, options_that_need_all_points_are_refused) {
  PointSet points = testing::random_points(1, 200, Scatter::kFloats, Heights::kReal);
  const Parts parts(points, {});
  const std::vector<float> tolerances(200, 1.0f);
  const auto kind = [&](const PointOptions& options) { return simplify_points(parts, options).error().kind; };
  EXPECT_EQ(kind({.max_error = 1, .boundary_length = 0.5}), ErrorKind::kUsage);
  EXPECT_EQ(kind({.max_error = 1, .tolerances = tolerances}), ErrorKind::kUsage);
  EXPECT_EQ(kind({}), ErrorKind::kUsage);
  EXPECT_EQ(kind({.max_error = 1, .quality = {.effort = Effort::kHigh}}), ErrorKind::kUsage);
  EXPECT_EQ(kind({.max_error = 1, .quality = {.vertices = Vertices::kFree}}), ErrorKind::kUsage);
  EXPECT_EQ(simplify_points(Parts({}, {}), {.max_error = 1}).error().kind, ErrorKind::kInput);
  MeasureOptions judge;
  judge.collect_above = 1;
  EXPECT_EQ(measure_points(parts, Mesh(), judge).error().kind, ErrorKind::kUsage);
}

TEST(PointBlocks, a_limit_without_space_for_the_points_of_the_run_is_refused) {
  const Parts parts(testing::random_points(1, 20000, Scatter::kFloats, Heights::kReal), {5000, 10000});
  PointOptions options{.max_error = 0.1};
  options.run.memory.limit = 1'000'000;
  const auto made = simplify_points(parts, options);
  ASSERT_FALSE(made.has_value());
  EXPECT_EQ(made.error().kind, ErrorKind::kMemory) << made.error().message;
}

TEST(PointBlocks, cancelling_ends_the_run) {
  const Parts parts(testing::random_points(1, 2000, Scatter::kFloats, Heights::kReal), {500, 1000});
  for (const int after : {0, 2, 5, 9}) {
    PointOptions options{.max_error = 1};
    int calls = 0;
    options.run.progress = [&](const Progress&) { return calls++ < after; };
    const auto made = simplify_points(parts, options);
    ASSERT_FALSE(made.has_value());
    EXPECT_EQ(made.error().kind, ErrorKind::kCancelled);
  }
}

}  // namespace
}  // namespace scarp::point_blocks_laws_test
