// Laws of scattered points: the guarantee, the oracle, the judge, and a raster as a set of points.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <set>

#include "grid/snapped_points.h"
#include "laws/fields.h"
#include "laws/point_sets.h"
#include "refine/scattered.h"
#include "scarp/measure.h"
#include "scarp/points.h"

namespace scarp::points_laws_test {
namespace {

using testing::Heights;
using testing::Scatter;

Scatter any_scatter() {
  return *rc::gen::elementOf(std::vector<Scatter>(std::begin(testing::kScatters), std::end(testing::kScatters)));
}

PointSet any_points(int most, Scatter scatter, Heights heights) {
  return testing::random_points(*rc::gen::arbitrary<std::uint32_t>(), *rc::gen::inRange(3, most), scatter, heights);
}

/// False if all points are collinear; then nothing is guaranteed.
bool has_area(const PointSet& points) {
  const auto snapped = grid::snap_points(points, DuplicatePolicy::kFirst);
  return snapped && refine::build_domain(*snapped).has_value();
}

Quality any_quality() {
  const Effort effort =
      *rc::gen::element(Effort::kAuto, Effort::kFast, Effort::kNormal, Effort::kHigh, Effort::kMax);
  if (effort == Effort::kFast) return {.effort = effort};
  return {.effort = effort, .vertices = *rc::gen::element(Vertices::kAuto, Vertices::kSamples, Vertices::kFree)};
}

RC_GTEST_PROP(points, far_from_all_but_one_of_eight_neighbours_are_spikes, ()) {
  const PointSet points = any_points(150, any_scatter(), *rc::gen::element(Heights::kReal, Heights::kSteps));
  const double most = *rc::gen::element(0.0, 0.5, 5.0, 40.0);
  PointSet expected;
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::vector<std::pair<double, std::size_t>> others;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double dx = points.x[k] - points.x[i], dy = points.y[k] - points.y[i];
      if (k != i) others.emplace_back(dx * dx + dy * dy, k);
    }
    std::sort(others.begin(), others.end());
    others.resize(std::min<std::size_t>(others.size(), 8));
    const auto near = std::count_if(others.begin(), others.end(), [&](const auto& other) {
      return std::abs(points.z[other.second] - points.z[i]) <= most;
    });
    if (others.size() > 1 && near <= 1) continue;
    expected.x.push_back(points.x[i]);
    expected.y.push_back(points.y[i]);
    expected.z.push_back(points.z[i]);
  }
  PointSet kept = points;
  const std::uint64_t dropped = drop_spikes(most, *rc::gen::element(1, 3), kept);
  RC_ASSERT(dropped == points.size() - kept.size() && kept.spikes == dropped);
  RC_ASSERT(kept.x == expected.x && kept.y == expected.y && kept.z == expected.z);
}

RC_GTEST_PROP(points, keep_the_promise_in_the_eyes_of_the_textbook, ()) {
  const Scatter scatter = any_scatter();
  const PointSet points = any_points(120, scatter, *rc::gen::element(Heights::kReal, Heights::kSteps));
  RC_PRE(has_area(points));
  const double goal = *rc::gen::element(0.0, 0.5, 1.0, 3.0, 20.0);
  const auto policy = *rc::gen::element(DuplicatePolicy::kFirst, DuplicatePolicy::kLast, DuplicatePolicy::kHighest,
                                        DuplicatePolicy::kLowest, DuplicatePolicy::kMean);
  const auto result = simplify_points(
      points, {.max_error = goal, .float32_positions = false, .duplicates = policy, .quality = any_quality()});
  if (!result) RC_FAIL(result.error().message);
  const Measurement& m = result->simplified.measurement;
  const auto snapped = *grid::snap_points(points, policy);
  RC_ASSERT(m.is_sound());
  RC_ASSERT(m.border_loops == 1u);
  RC_ASSERT(m.uncovered == 0u);
  RC_ASSERT(m.samples + result->duplicates == points.size());
  RC_ASSERT(m.max_error <= goal + 1e-12 * (goal + 50));
  PointSet merged;
  for (std::size_t i = 0; i < snapped.size(); ++i) {
    merged.x.push_back(points.x[snapped.source[i]]);
    merged.y.push_back(points.y[snapped.source[i]]);
    merged.z.push_back(snapped.z[i]);
  }
  const auto [missed, naive] = testing::judge_by_brute_force(merged, result->simplified.mesh);
  RC_ASSERT(missed == 0);
  RC_ASSERT(std::abs(naive - m.max_error) < 1e-5);
}

RC_GTEST_PROP(points, are_the_vertices_and_no_vertex_is_anything_else, ()) {
  const PointSet points = any_points(120, any_scatter(), Heights::kReal);
  RC_PRE(has_area(points));
  const auto result = simplify_points(points, {.max_error = 5.0, .float32_positions = false});
  if (!result) RC_FAIL(result.error().message);
  const Mesh& mesh = result->simplified.mesh;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    bool is_point = false;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double off = std::hypot(mesh.vertex(v)[0] - points.x[i], mesh.vertex(v)[1] - points.y[i]);
      is_point =
          is_point || (off <= 1e-15 * std::hypot(points.x[i], points.y[i]) + 1e-16 && mesh.vertex(v)[2] == points.z[i]);
    }
    RC_ASSERT(is_point);
  }
}

RC_GTEST_PROP(points, keep_the_promise_in_float32_or_say_that_they_cannot, ()) {
  const PointSet points = any_points(120, any_scatter(), *rc::gen::element(Heights::kReal, Heights::kSteps));
  RC_PRE(has_area(points));
  const double goal = *rc::gen::element(0.0, 0.5, 3.0, 20.0);
  const auto result = simplify_points(points, {.max_error = goal, .quality = any_quality()});
  if (!result) {
    RC_ASSERT(result.error().kind == ErrorKind::kPromise);
    return;
  }
  const auto judged = *measure_points(points, result->simplified.mesh, DuplicatePolicy::kFirst);
  RC_ASSERT(judged.max_error <= goal + 1e-12 * (goal + 50));
  RC_ASSERT(judged.is_sound());
  for (const double position : result->simplified.mesh.positions)
    RC_ASSERT(double{static_cast<float>(position)} == position);
}

RC_GTEST_PROP(points, end_with_any_shapes_and_keep_the_promise, ()) {
  const PointSet points = any_points(80, any_scatter(), *rc::gen::element(Heights::kReal, Heights::kSteps));
  RC_PRE(has_area(points));
  PointOptions options{.max_error = *rc::gen::element(0.0, 0.5, 3.0),
                       .float32_positions = *rc::gen::arbitrary<bool>(),
                       .quality = any_quality()};
  options.quality.shape.min_angle = *rc::gen::element(5.0, 20.0, 33.0);
  if (*rc::gen::arbitrary<bool>()) options.quality.shape.grade = 0.5;
  const auto result = simplify_points(points, options);
  if (!result) {
    RC_ASSERT(result.error().kind == ErrorKind::kPromise);
    return;
  }
  const auto judged = *measure_points(points, result->simplified.mesh, DuplicatePolicy::kFirst);
  RC_ASSERT(judged.max_error <= *options.max_error + 1e-12 * (*options.max_error + 50));
  RC_ASSERT(judged.is_sound());
  RC_ASSERT(judged.uncovered == 0u);
}

/// Algorithm I: examines everything before each insertion.
std::vector<std::uint32_t> insert_by_brute_force(const grid::SnappedPoints& snapped, double threshold) {
  refine::ScatteredDomain domain = *refine::build_domain(snapped);
  for (;;) {
    metric::Candidate worst{-1, {}};
    std::uint32_t worst_point = tin::kNone;
    for (tin::Triangle t = 0; t < domain.tin.triangle_count(); ++t) {
      if (domain.tin.is_outside(t)) continue;
      const auto corners = domain.tin.corners(t);
      std::array<double, 3> heights;
      for (std::uint32_t k = 0; k < 3; ++k) heights[k] = snapped.z[domain.point_of[domain.tin.origin(3 * t + k)]];
      const geom::Plane plane = geom::Plane::through_double(corners, heights);
      for (std::uint32_t point = 0; point < snapped.size(); ++point) {
        const Point p = snapped.at[point];
        bool is_inside = true;
        for (int k = 0; k < 3; ++k) is_inside = is_inside && orient(corners[k], corners[(k + 1) % 3], p) >= 0;
        const bool is_corner = p == corners[0] || p == corners[1] || p == corners[2];
        const metric::Candidate candidate{std::abs(plane.height_at(p) - snapped.z[point]), p};
        if (!is_inside || is_corner || !(candidate.error > threshold) || !metric::is_worse(candidate, worst)) continue;
        worst = candidate;
        worst_point = point;
      }
    }
    if (worst_point == tin::kNone) return domain.point_of;
    domain.insert(worst_point, worst.at, domain.tin.locate(worst.at, 0));
  }
}

RC_GTEST_PROP(points, are_inserted_in_the_order_of_brute_force, ()) {
  const PointSet points = any_points(70, any_scatter(), Heights::kReal);
  RC_PRE(has_area(points));
  const double goal = *rc::gen::element(0.0, 1.0, 10.0);
  const auto snapped = *grid::snap_points(points, DuplicatePolicy::kFirst);
  refine::ScatteredDomain domain = *refine::build_domain(snapped);
  refine::ScatteredRefinement refinement(snapped, snapped.z, domain, goal);
  std::uint64_t triangles = refinement.triangle_count();
  while (!refinement.done()) {
    triangles += refinement.next_gain();
    refinement.insert_worst();
    RC_ASSERT(refinement.triangle_count() == triangles);
  }
  const auto expected = insert_by_brute_force(snapped, goal);
  if (goal > 0) {
    RC_ASSERT(domain.point_of == expected);
  } else {
    // Only the engine distinguishes points that a plane explains within rounding.
    const std::size_t common = std::min(domain.point_of.size(), expected.size());
    RC_ASSERT(
        std::equal(expected.begin(), expected.begin() + static_cast<std::ptrdiff_t>(common), domain.point_of.begin()));
  }
}

RC_GTEST_PROP(points, keep_their_budgets, ()) {
  const PointSet points = any_points(200, any_scatter(), Heights::kReal);
  RC_PRE(has_area(points));
  const std::uint64_t budget = *rc::gen::inRange<std::uint64_t>(3, 120);
  const Quality quality = any_quality();
  const auto by_vertices =
      simplify_points(points, {.max_vertices = budget, .float32_positions = false, .quality = quality});
  if (by_vertices) RC_ASSERT(by_vertices->simplified.mesh.vertex_count() <= budget);
  if (!by_vertices) RC_ASSERT(by_vertices.error().kind == ErrorKind::kUsage);
  const auto by_triangles =
      simplify_points(points, {.max_triangles = budget, .float32_positions = false, .quality = quality});
  if (by_triangles) RC_ASSERT(by_triangles->simplified.mesh.triangle_count() <= budget);
  if (!by_triangles) RC_ASSERT(by_triangles.error().kind == ErrorKind::kUsage);
}

RC_GTEST_PROP(points, give_the_same_mesh_in_any_order_and_on_any_number_of_threads, ()) {
  const PointSet points = any_points(150, any_scatter(), *rc::gen::element(Heights::kReal, Heights::kSteps));
  RC_PRE(has_area(points));
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  std::shuffle(order.begin(), order.end(), random);
  PointSet shuffled;
  for (const std::size_t i : order) {
    shuffled.x.push_back(points.x[i]);
    shuffled.y.push_back(points.y[i]);
    shuffled.z.push_back(points.z[i]);
  }
  PointOptions options{.max_error = 1.0,
                       .float32_positions = *rc::gen::arbitrary<bool>(),
                       .duplicates = DuplicatePolicy::kHighest,
                       .quality = any_quality()};
  options.run.threads = 1;
  const auto a = simplify_points(points, options);
  options.run.threads = 4;
  const auto b = simplify_points(shuffled, options);
  RC_ASSERT(a.has_value() == b.has_value());
  if (!a) {
    RC_ASSERT(options.float32_positions && a.error().kind == ErrorKind::kPromise);
    return;
  }
  RC_ASSERT(a->simplified.mesh.positions == b->simplified.mesh.positions);
  RC_ASSERT(a->simplified.mesh.triangles == b->simplified.mesh.triangles);
  RC_ASSERT(a->duplicates == b->duplicates);
}

RC_GTEST_PROP(points, that_differ_keep_lattice_points_of_their_own, ()) {
  const Scatter scatter = any_scatter();
  const PointSet points = any_points(300, scatter, Heights::kReal);
  std::map<std::pair<double, double>, int> distinct;
  for (std::size_t i = 0; i < points.size(); ++i) ++distinct[{points.x[i], points.y[i]}];
  const auto snapped = *grid::snap_points(points, DuplicatePolicy::kFirst);
  RC_ASSERT(snapped.size() == distinct.size());
  RC_ASSERT(snapped.duplicates == points.size() - distinct.size());
  const auto [west, east] = std::minmax_element(points.x.begin(), points.x.end());
  const double extent = std::max(*east - *west, *std::max_element(points.y.begin(), points.y.end()) -
                                                    *std::min_element(points.y.begin(), points.y.end()));
  const double off = scatter == Scatter::kUtm ? 1e-9 : 0.51 * snapped.lattice.step + 1e-15 * extent;
  const double north = *std::max_element(points.y.begin(), points.y.end());
  for (std::size_t i = 0; i < snapped.size(); ++i) {
    const Point p = snapped.at[i];
    RC_ASSERT(p.x >= 0 && p.y >= 0 && p.x < snapped.lattice.cols && p.y < snapped.lattice.rows);
    RC_ASSERT(std::abs(*west + p.x * snapped.lattice.step - points.x[snapped.source[i]]) <= off);
    RC_ASSERT(std::abs(north - p.y * snapped.lattice.step - points.y[snapped.source[i]]) <= off);
  }
}

RC_GTEST_PROP(points, of_a_raster_give_the_mesh_of_the_raster, ()) {
  const auto cols = *rc::gen::inRange(2, 30), rows = *rc::gen::inRange(2, 30);
  const auto field = testing::random_field(*rc::gen::arbitrary<std::uint32_t>(), cols, rows,
                                           *rc::gen::element(testing::Relief::kReal, testing::Relief::kRidges));
  const double spacing = *rc::gen::element(1.0, 0.25, 30.0);
  PointSet points;
  for (std::int32_t y = 0; y < rows; ++y) {
    for (std::int32_t x = 0; x < cols; ++x) {
      points.x.push_back(500015 + spacing * x);
      points.y.push_back(spacing * (rows - 1 - y));
      points.z.push_back(field.samples[static_cast<std::size_t>(y * cols + x)]);
    }
  }
  const SimplifyOptions options{.goals = {.max_error = *rc::gen::element(0.5, 5.0, 20.0)},
                                .output = {.float32_positions = false}};
  const auto scattered = simplify_points(points, {.max_error = options.goals.max_error,
                                                  .float32_positions = options.output.float32_positions,
                                                  .quality = {.effort = Effort::kFast}});
  SimplifyOptions greedy = options;
  greedy.quality.order = Order::kGreedy;
  const auto raster = simplify(field.view(), greedy);
  if (!scattered) RC_FAIL(scattered.error().message);
  RC_ASSERT(scattered->lattice_step == spacing);
  std::set<std::array<double, 3>> a, b;
  const Mesh &m = scattered->simplified.mesh, &n = raster->mesh;
  for (std::size_t v = 0; v < m.vertex_count(); ++v)
    a.insert({(m.vertex(v)[0] - 500015) / spacing, m.vertex(v)[1] / spacing, m.vertex(v)[2]});
  for (std::size_t v = 0; v < n.vertex_count(); ++v) b.insert(n.vertex(v));
  RC_ASSERT(a == b);
}

// Slivers of millimetres along the hull, across which the surface rises by metres: a float32 step matters there.
TEST(points, keep_their_bound_where_slivers_along_the_hull_are_steep) {
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    std::mt19937 random(seed);
    const auto millimetres = [&](double range) {
      return static_cast<double>(random() % static_cast<std::uint32_t>(1000 * range)) / 1000;
    };
    PointSet points;
    for (int k = 0; k < 5000; ++k) {
      const double x = millimetres(10000), y = k % 20 == 0 ? 8000 - millimetres(1) : millimetres(8000);
      points.x.push_back(500000 + x);
      points.y.push_back(4000000 + y);
      points.z.push_back(100 * std::sin(x / 700) * std::cos(y / 900) + millimetres(2));
    }
    for (const double bound : {3.0, 6.0}) {
      const auto result = simplify_points(points, {.max_error = bound});
      ASSERT_TRUE(result) << seed << ", " << bound << ": " << result.error().message;
      const auto judged = measure_points(points, result->simplified.mesh, DuplicatePolicy::kFirst);
      ASSERT_TRUE(judged);
      EXPECT_TRUE(judged->is_sound());
      EXPECT_EQ(judged->uncovered, 0u);
      EXPECT_LE(judged->max_error, bound);
    }
  }
}

}  // namespace
}  // namespace scarp::points_laws_test
