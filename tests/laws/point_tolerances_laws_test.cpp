// Laws of points with tolerances of their own: brute force at each point, and regions against a plain scan.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "laws/point_sets.h"
#include "scarp/measure.h"
#include "scarp/points.h"

namespace scarp::point_tolerances_laws_test {
namespace {

using testing::Heights;
using testing::Scatter;

constexpr float kNoBound = std::numeric_limits<float>::infinity();

PointSet any_points(int most) {
  const auto scatter = *rc::gen::element(Scatter::kWhole, Scatter::kUtm, Scatter::kFloats, Scatter::kStreets);
  return testing::random_points(*rc::gen::arbitrary<std::uint32_t>(), *rc::gen::inRange(4, most), scatter,
                                *rc::gen::element(Heights::kReal, Heights::kSteps));
}

std::vector<float> any_tolerances(std::size_t count) {
  std::vector<float> tolerances(count);
  for (float& tolerance : tolerances) tolerance = *rc::gen::element(0.0f, 0.01f, 0.3f, 2.0f, 9.0f, kNoBound);
  return tolerances;
}

PointSet only(const PointSet& points, std::size_t i) {
  PointSet one;
  one.x = {points.x[i]};
  one.y = {points.y[i]};
  one.z = {points.z[i]};
  return one;
}

/// Points that are the first at their place.
std::vector<std::size_t> firsts(const PointSet& points) {
  std::vector<std::size_t> firsts;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool is_first = std::none_of(firsts.begin(), firsts.end(), [&](std::size_t k) {
      return points.x[k] == points.x[i] && points.y[k] == points.y[i];
    });
    if (is_first) firsts.push_back(i);
  }
  return firsts;
}

RC_GTEST_PROP(point_tolerances, hold_at_every_point_by_brute_force, ()) {
  PointSet points = any_points(90);
  const std::vector<float> tolerances = any_tolerances(points.size());
  PointOptions options{.max_error = *rc::gen::element(0.5, 4.0, 20.0),
                       .float32_positions = *rc::gen::arbitrary<bool>(),
                       .tolerances = tolerances};
  options.quality.effort = *rc::gen::element(Effort::kFast, Effort::kNormal, Effort::kHigh, Effort::kMax);
  if (*rc::gen::inRange(0, 4) == 0) options.quality.shape.min_angle = 20;
  const auto made = simplify_points(points, options);
  if (!made) {
    RC_ASSERT(made.error().kind == ErrorKind::kInput ||
              (made.error().kind == ErrorKind::kPromise && (options.float32_positions || options.quality.shape.any())));
    RC_DISCARD("no surface, or float32 cannot hold it");
  }
  for (const std::size_t i : firsts(points)) {
    const double bound = std::min(*options.max_error, double{tolerances[i]});
    const auto [missed, error] = testing::judge_by_brute_force(only(points, i), made->simplified.mesh);
    // Rounding, and vertices for angles, move the hull slightly.
    RC_ASSERT(missed == 0 || options.float32_positions || options.quality.shape.any());
    RC_ASSERT(error <= bound + 1e-6);
  }
  MeasureOptions judge;
  judge.tolerance = tolerances;
  RC_ASSERT(measure_points(points, made->simplified.mesh, DuplicatePolicy::kFirst, judge)->over_tolerance == 0u);
}

RC_GTEST_PROP(point_tolerances, times_their_factor_hold_within_a_budget, ()) {
  PointSet points = any_points(90);
  const std::vector<float> tolerances = any_tolerances(points.size());
  const std::uint64_t budget = *rc::gen::inRange<std::uint64_t>(8, 150);
  PointOptions options{.max_error = *rc::gen::element(0.5, 4.0, 20.0),
                       .max_triangles = budget,
                       .float32_positions = false,
                       .tolerances = tolerances};
  options.quality.effort = *rc::gen::element(Effort::kFast, Effort::kNormal, Effort::kHigh);
  const auto made = simplify_points(points, options);
  if (!made) RC_DISCARD("no surface, or too few triangles");
  const Simplified& simplified = made->simplified;
  RC_ASSERT(simplified.mesh.triangle_count() <= budget);
  RC_ASSERT(simplified.tolerance_factor >= 1);
  RC_ASSERT(simplified.stop != StopReason::kMaxError || simplified.tolerance_factor == 1);
  for (const std::size_t i : firsts(points)) {
    const double bound = std::min(*options.max_error, double{tolerances[i]});
    const double error = testing::judge_by_brute_force(only(points, i), simplified.mesh).second;
    RC_ASSERT(error <= simplified.tolerance_factor * bound + 1e-6);
  }
  options.max_triangles = std::nullopt;
  const auto whole = simplify_points(points, options);
  // A budget with room for the tolerances changes nothing, unless the mesh of a larger factor already fills it.
  const bool is_full = 100 * simplified.mesh.triangle_count() >= 97 * budget;
  if (whole && whole->simplified.mesh.triangle_count() + 1 < budget)
    RC_ASSERT(simplified.tolerance_factor == 1 || is_full);
}

RC_GTEST_PROP(point_tolerances, at_or_above_the_max_error_change_no_byte, ()) {
  const PointSet points = any_points(120);
  std::vector<float> tolerances(points.size());
  for (float& tolerance : tolerances) tolerance = *rc::gen::element(4.0f, 5.0f, kNoBound);
  PointOptions options{.max_error = 4.0, .float32_positions = false};
  options.quality.effort = *rc::gen::element(Effort::kFast, Effort::kNormal, Effort::kHigh);
  const auto plain = simplify_points(points, options);
  options.tolerances = tolerances;
  const auto made = simplify_points(points, options);
  RC_ASSERT(plain.has_value() == made.has_value());
  if (!made) return;
  RC_ASSERT(plain->simplified.mesh.positions == made->simplified.mesh.positions);
  RC_ASSERT(plain->simplified.mesh.triangles == made->simplified.mesh.triangles);
}

RC_GTEST_PROP(point_tolerances, are_counted_by_the_judge_where_errors_exceed_them, ()) {
  const PointSet points = any_points(80);
  const auto made = simplify_points(points, {.max_error = 20.0, .float32_positions = false});
  if (!made) RC_DISCARD("no surface");
  const std::vector<float> tolerances = any_tolerances(points.size());
  MeasureOptions judge;
  judge.tolerance = tolerances;
  judge.collect_above = 100.0;
  const auto judged = *measure_points(points, made->simplified.mesh, DuplicatePolicy::kFirst, judge);
  std::uint64_t least = 0, most = 0;
  for (const std::size_t i : firsts(points)) {
    const double error = testing::judge_by_brute_force(only(points, i), made->simplified.mesh).second;
    least += error > double{tolerances[i]} + 1e-6;
    most += error > double{tolerances[i]} - 1e-6;
  }
  RC_ASSERT(judged.over_tolerance >= least && judged.over_tolerance <= most);
  RC_ASSERT(judged.offenders.size() <= judged.over_tolerance);
  RC_ASSERT(judged.offenders.empty() == (judged.over_tolerance == 0));
}

/// A rectangle, counter-clockwise or clockwise.
Line any_rectangle(LineRole role, std::uint32_t polygon, double size) {
  const double x = *rc::gen::inRange(-20, 100) / 100.0 * size, y = *rc::gen::inRange(-20, 100) / 100.0 * size;
  const double width = *rc::gen::inRange(1, 60) / 100.0 * size, height = *rc::gen::inRange(1, 60) / 100.0 * size;
  Line line;
  line.role = role;
  line.polygon = polygon;
  line.points = {{x, y, 0}, {x + width, y, 0}, {x + width, y + height, 0}, {x, y + height, 0}, {x, y, 0}};
  if (*rc::gen::arbitrary<bool>()) std::reverse(line.points.begin(), line.points.end());
  return line;
}

bool holds(const Line& rectangle, double x, double y) {
  const auto& a = rectangle.points[0];
  const auto& c = rectangle.points[2];
  return std::min(a[0], c[0]) <= x && x <= std::max(a[0], c[0]) && std::min(a[1], c[1]) <= y &&
         y <= std::max(a[1], c[1]);
}

double distance(const Line& line, double x, double y) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k + 1 < line.points.size(); ++k) {
    // Edges are along x or y.
    const auto &a = line.points[k], &b = line.points[k + 1];
    const double px = std::clamp(x, std::min(a[0], b[0]), std::max(a[0], b[0]));
    const double py = std::clamp(y, std::min(a[1], b[1]), std::max(a[1], b[1]));
    nearest = std::min(nearest, std::hypot(x - px, y - py));
  }
  return nearest;
}

RC_GTEST_PROP(point_tolerances, of_regions_grow_from_polygons_holes_and_lines, ()) {
  PointSet points;
  for (int i = 0; i < 60; ++i) {
    points.x.push_back(*rc::gen::inRange(0, 1000) + 0.37);
    points.y.push_back(*rc::gen::inRange(0, 1000) + 0.61);
    points.z.push_back(0);
  }
  const double falloff = *rc::gen::element(0.0, 50.0, 700.0);
  const double beyond = falloff == 0 && *rc::gen::arbitrary<bool>() ? double{kNoBound} : 10;
  std::vector<Region> regions;
  for (int k = 0, count = *rc::gen::inRange(1, 4); k < count; ++k) {
    Region region{{}, *rc::gen::element(0.5, 3.0, 12.0)};
    for (std::uint32_t polygon = 0; polygon < 2; ++polygon)
      region.lines.push_back(any_rectangle(LineRole::kOuter, polygon, 1000));
    if (*rc::gen::arbitrary<bool>()) {
      Line hole = region.lines[1];
      for (auto& p : hole.points) {
        p[0] = (p[0] + hole.points[2][0]) / 2;
        p[1] = (p[1] + hole.points[2][1]) / 2;
      }
      hole.role = LineRole::kHole;
      region.lines.push_back(hole);
    }
    Line line = any_rectangle(LineRole::kLine, kNoPolygon, 1000);
    line.points.pop_back();
    region.lines.push_back(line);
    regions.push_back(region);
  }
  std::vector<bool> found;
  const auto tolerances = region_tolerances(regions, points, falloff, beyond, &found);
  for (std::size_t i = 0; i < points.size(); ++i) {
    double expected = beyond;
    for (const Region& region : regions) {
      double away = std::numeric_limits<double>::infinity();
      for (const Line& line : region.lines) {
        bool is_inside = line.is_ring() && line.role != LineRole::kHole && holds(line, points.x[i], points.y[i]);
        for (const Line& hole : region.lines) {
          if (hole.role == LineRole::kHole && hole.polygon == line.polygon && holds(hole, points.x[i], points.y[i]))
            is_inside = false;
        }
        away = std::min(away, is_inside ? 0 : distance(line, points.x[i], points.y[i]));
      }
      if (region.tolerance >= beyond || away > falloff) continue;
      const double share = falloff > 0 ? away / falloff : 0;
      expected =
          std::min(expected, share == 0 ? region.tolerance : region.tolerance + (beyond - region.tolerance) * share);
    }
    RC_ASSERT(double{tolerances[i]} <= expected);
    RC_ASSERT(double{tolerances[i]} >= expected * (1 - 1e-6) || std::isinf(expected));
    RC_ASSERT(std::isinf(tolerances[i]) == std::isinf(expected));
  }
  RC_ASSERT(found.size() == regions.size());
}

TEST(point_tolerances, of_0_keep_the_heights_of_their_vertices_where_vertices_move) {
  PointSet points;
  points.x = {500777.7, 500859.43, 500965.75, 500758.58, 500609.04, 500794.02};
  points.y = {4649425.14, 4649576.99, 4649125.41, 4649317.41, 4649425.14, 4649449.13};
  points.z = {-26.2, 39.3, 47.3, 25.2, 27.6, -11.2};
  const std::vector<float> tolerances = {0, kNoBound, 2, 9, 0, 9};
  const auto made = simplify_points(
      points,
      {.max_error = 20.0, .float32_positions = false, .quality = {.effort = Effort::kMax}, .tolerances = tolerances});
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_LE(testing::judge_by_brute_force(only(points, 0), made->simplified.mesh).second, 1e-6);
}

TEST(point_tolerances, that_do_not_fit_are_refused) {
  const PointSet points = testing::random_points(1, 20, Scatter::kUtm, Heights::kReal);
  const std::vector<float> few(19, 1.0f), negative(20, -1.0f), nan(20, std::nanf("")), fine(20, 1.0f);
  const auto refused = [&](const PointOptions& options) {
    const auto made = simplify_points(points, options);
    return made ? "" : made.error().message;
  };
  const char* const invalid = "tolerances of points: give one for each, at least 0";
  for (const auto* tolerances : {&few, &negative, &nan})
    EXPECT_EQ(refused({.max_error = 2.0, .tolerances = *tolerances}), invalid);
  EXPECT_EQ(refused({.max_triangles = 9, .tolerances = fine}), "tolerances of points need a max error");
  MeasureOptions judge;
  judge.tolerance = few;
  const auto made = *simplify_points(points, {.max_error = 2.0, .tolerances = fine});
  EXPECT_EQ(measure_points(points, made.simplified.mesh, DuplicatePolicy::kFirst, judge).error().message, invalid);
}

}  // namespace
}  // namespace scarp::point_tolerances_laws_test
