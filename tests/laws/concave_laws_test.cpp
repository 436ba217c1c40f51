// Laws of the concave hull of scattered points, and of meshes bounded by it.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "grid/snapped_points.h"
#include "laws/point_sets.h"
#include "refine/concave_outline.h"
#include "refine/hull_fit.h"
#include "scarp/measure.h"
#include "scarp/points.h"

namespace scarp::concave_laws_test {
namespace {

using testing::Heights;
using testing::Scatter;
using Ring = std::vector<std::uint32_t>;
using Corners = std::array<std::uint32_t, 3>;

PointSet any_points(int most) {
  const auto scatter =
      *rc::gen::elementOf(std::vector<Scatter>(std::begin(testing::kScatters), std::end(testing::kScatters)));
  return testing::random_points(*rc::gen::arbitrary<std::uint32_t>(), *rc::gen::inRange(3, most), scatter,
                                *rc::gen::element(Heights::kReal, Heights::kSteps));
}

/// Points around a bay: a C that opens to the east.
PointSet around_a_bay(std::uint32_t seed, int count) {
  std::mt19937 random(seed);
  const auto metres = [&](int range) {
    return static_cast<double>(random() % static_cast<unsigned>(100 * range)) / 100;
  };
  PointSet points;
  while (points.size() < static_cast<std::size_t>(count)) {
    const double x = metres(1000), y = metres(1000);
    if (x > 400 && y > 300 && y < 700) continue;
    points.x.push_back(500000 + x);
    points.y.push_back(4000000 + y);
    points.z.push_back(20 * std::sin(x / 150) * std::cos(y / 90) + metres(1));
  }
  return points;
}

/// A length from a tenth of the mean distance between points to their extent.
double any_length(const PointSet& points) {
  const auto extent = [](const std::vector<double>& values) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    return *most - *least;
  };
  const double all = extent(points.x) + extent(points.y);
  return all * std::pow(10.0, -0.1 * *rc::gen::inRange(0, 25));
}

std::optional<refine::ScatteredDomain> hull_of(const grid::SnappedPoints& points) {
  auto hull = refine::build_domain(points);
  return hull ? std::optional(std::move(*hull)) : std::nullopt;
}

bool is_between(Point a, Point b, Point p) {
  return orient(a, b, p) == 0 && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

int side(Point a, Point b, Point p) {
  const std::int64_t turn = orient(a, b, p);
  return turn > 0 ? 1 : turn < 0 ? -1 : 0;
}

/// True if edges meet only in common corners.
bool is_simple(const grid::SnappedPoints& points, const Ring& ring) {
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point a = points.at[ring[i]], b = points.at[ring[(i + 1) % n]];
    for (std::size_t j = 0; j < n; ++j) {
      const Point c = points.at[ring[j]], d = points.at[ring[(j + 1) % n]];
      if (j != i && j != (i + 1) % n && is_between(a, b, c)) return false;
      if (side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0) return false;
    }
  }
  return true;
}

/// True if p is in the polygon or on its edges, by a ray to the east.
bool holds(const grid::SnappedPoints& points, const Ring& ring, Point p) {
  bool is_in = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = points.at[ring[i]], b = points.at[ring[(i + 1) % ring.size()]];
    if (is_between(a, b, p)) return true;
    if ((a.y > p.y) != (b.y > p.y) && (orient(a, b, p) > 0) == (b.y > a.y)) is_in = !is_in;
  }
  return is_in;
}

double area_of(const grid::SnappedPoints& points, const Ring& ring) {
  long double twice = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = points.at[ring[i]], b = points.at[ring[(i + 1) % ring.size()]];
    twice += static_cast<long double>(a.x) * b.y - static_cast<long double>(b.x) * a.y;
  }
  return static_cast<double>(twice / 2) * points.lattice.step * points.lattice.step;
}

/// Triangles of all triples whose circle contains no point; none if four points lie on one circle.
std::optional<std::vector<Corners>> delaunay_by_brute_force(const grid::SnappedPoints& points) {
  const auto count = static_cast<std::uint32_t>(points.size());
  std::vector<Corners> triangles;
  for (std::uint32_t a = 0; a < count; ++a) {
    for (std::uint32_t b = a + 1; b < count; ++b) {
      for (std::uint32_t c = b + 1; c < count; ++c) {
        Corners corners{a, b, c};
        if (orient(points.at[a], points.at[b], points.at[c]) == 0) return std::nullopt;
        if (orient(points.at[a], points.at[b], points.at[c]) < 0) std::swap(corners[1], corners[2]);
        bool is_empty = true;
        for (std::uint32_t p = 0; p < count && is_empty; ++p) {
          if (p == a || p == b || p == c) continue;
          const int where =
              geom::in_circle(points.at[corners[0]], points.at[corners[1]], points.at[corners[2]], points.at[p]);
          if (where == 0) return std::nullopt;
          is_empty = where < 0;
        }
        if (is_empty) triangles.push_back(corners);
      }
    }
  }
  return triangles;
}

/// The boundary of the triangles as one ring without repeated or missing points, if there is one.
std::optional<std::map<std::uint32_t, std::uint32_t>> boundary_of(const std::vector<Corners>& triangles,
                                                                  std::size_t count) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  std::set<std::uint32_t> corners;
  for (const Corners& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      edges.insert({t[k], t[(k + 1) % 3]});
      corners.insert(t[k]);
    }
  }
  if (corners.size() != count) return std::nullopt;
  std::map<std::uint32_t, std::uint32_t> next;
  for (const auto& [a, b] : edges) {
    if (!edges.contains({b, a}) && !next.emplace(a, b).second) return std::nullopt;
  }
  std::size_t around = 1;
  for (std::uint32_t v = next.begin()->second; v != next.begin()->first; v = next.at(v)) ++around;
  if (around != next.size()) return std::nullopt;
  return next;
}

/// The chi-shape by definition: removes the triangle at the longest removable edge, then examines everything again.
std::map<std::uint32_t, std::uint32_t> chi_by_brute_force(const grid::SnappedPoints& points,
                                                          std::vector<Corners> triangles, double longest) {
  for (;;) {
    const auto next = *boundary_of(triangles, points.size());
    double most = longest;
    std::optional<std::vector<Corners>> best;
    for (const auto& [a, b] : next) {
      const Point p = points.at[a], q = points.at[b];
      const double length = std::hypot(double(q.x) - p.x, double(q.y) - p.y);
      if (length <= most) continue;
      std::vector<Corners> rest;
      for (const Corners& t : triangles) {
        bool is_at = false;
        for (std::size_t k = 0; k < 3; ++k) is_at = is_at || (t[k] == a && t[(k + 1) % 3] == b);
        if (!is_at) rest.push_back(t);
      }
      if (rest.empty() || !boundary_of(rest, points.size())) continue;
      most = length;
      best = std::move(rest);
    }
    if (!best) return next;
    triangles = std::move(*best);
  }
}

RC_GTEST_PROP(concave, outline_is_that_of_the_definition, ()) {
  const PointSet given = testing::random_points(*rc::gen::arbitrary<std::uint32_t>(), *rc::gen::inRange(3, 22),
                                                *rc::gen::element(Scatter::kUtm, Scatter::kFloats), Heights::kReal);
  const auto points = *grid::snap_points(given, DuplicatePolicy::kFirst);
  const auto triangles = delaunay_by_brute_force(points);
  RC_PRE(triangles.has_value());
  auto domain = hull_of(points);
  const double longest = any_length(given) / points.lattice.step;
  refine::add_points(points, 1, *domain);
  refine::take_away_long(*domain, longest);
  const Ring ring = refine::outline_of(*domain);
  const auto next = chi_by_brute_force(points, *triangles, longest);
  RC_ASSERT(ring.size() == next.size());
  for (std::size_t i = 0; i < ring.size(); ++i) RC_ASSERT(next.at(ring[i]) == ring[(i + 1) % ring.size()]);
}

RC_GTEST_PROP(concave, outline_is_simple_holds_all_points_and_has_only_long_edges_that_must_stay, ()) {
  const PointSet given = any_points(120);
  const auto points = *grid::snap_points(given, DuplicatePolicy::kFirst);
  auto domain = hull_of(points);
  RC_PRE(domain.has_value());
  const double longest = any_length(given) / points.lattice.step;
  refine::add_points(points, 1, *domain);
  refine::take_away_long(*domain, longest);
  const Ring ring = refine::outline_of(*domain);
  RC_ASSERT(is_simple(points, ring));
  RC_ASSERT(area_of(points, ring) > 0);
  for (const Point p : points.at) RC_ASSERT(holds(points, ring, p));
  const auto on_ring = [&](Point p) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (is_between(points.at[ring[i]], points.at[ring[(i + 1) % ring.size()]], p)) return true;
    }
    return false;
  };
  const tin::Triangulation& tin = domain->tin;
  for (tin::HalfEdge h = 0; h < 3 * tin.triangle_count(); ++h) {
    const tin::HalfEdge g = tin.twin(h);
    if (tin.is_outside(h / 3) || (g != tin::kNone && !tin.is_outside(g / 3))) continue;
    const Point a = tin.point(tin.origin(h)), b = tin.point(tin.origin(tin::Triangulation::next(h)));
    if (std::hypot(double(b.x) - a.x, double(b.y) - a.y) > longest * (1 + 1e-9))
      RC_ASSERT(on_ring(tin.point(tin.origin(tin::Triangulation::previous(h)))));
  }
}

RC_GTEST_PROP(concave, hull_of_a_length_beyond_all_edges_is_the_convex_one, ()) {
  const PointSet points = any_points(120);
  RC_PRE(hull_of(*grid::snap_points(points, DuplicatePolicy::kFirst)).has_value());
  PointOptions options{.max_error = *rc::gen::element(0.0, 1.0, 10.0), .float32_positions = false};
  const auto convex = simplify_points(points, options);
  options.boundary_length = 1e9;
  const auto concave = simplify_points(points, options);
  if (!convex || !concave) RC_FAIL("not simplified");
  RC_ASSERT(convex->simplified.mesh.positions == concave->simplified.mesh.positions);
  RC_ASSERT(convex->simplified.mesh.triangles == concave->simplified.mesh.triangles);
}

double area_of(const Mesh& mesh) {
  double twice = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const auto a = mesh.vertex(mesh.triangles[3 * t]), b = mesh.vertex(mesh.triangles[3 * t + 1]),
               c = mesh.vertex(mesh.triangles[3 * t + 2]);
    twice += (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }
  return twice / 2;
}

RC_GTEST_PROP(concave, meshes_keep_the_promise_at_every_point_and_end_at_the_outline, ()) {
  const bool is_bay = *rc::gen::arbitrary<bool>();
  const PointSet points =
      is_bay ? around_a_bay(*rc::gen::arbitrary<std::uint32_t>(), *rc::gen::inRange(50, 200)) : any_points(120);
  const auto snapped = *grid::snap_points(points, DuplicatePolicy::kFirst);
  auto hull = hull_of(snapped);
  RC_PRE(hull.has_value() && snapped.duplicates == 0);
  const double goal = *rc::gen::element(0.0, 0.5, 3.0, 20.0), length = any_length(points);
  const auto result = simplify_points(
      points, {.max_error = goal,
               .float32_positions = false,
               .boundary_length = length,
               .quality = {.effort = *rc::gen::element(Effort::kFast, Effort::kNormal, Effort::kHigh)}});
  if (!result) RC_FAIL(result.error().message);
  const Mesh& mesh = result->simplified.mesh;
  const Measurement& m = result->simplified.measurement;
  RC_ASSERT(m.is_sound());
  RC_ASSERT(m.border_loops == 1u);
  RC_ASSERT(m.uncovered == 0u);
  RC_ASSERT(m.max_error <= goal + 1e-12 * (goal + 50));
  const auto [missed, worst] = testing::judge_by_brute_force(points, mesh);
  RC_ASSERT(missed == 0);
  RC_ASSERT(std::abs(worst - m.max_error) < 1e-5);
  const auto domain = refine::build_concave_domain(snapped, std::move(*hull), length);
  if (!domain) RC_FAIL(domain.error().message);
  RC_ASSERT(result->on_hull == domain->outlines.front().size());
  const double expected = area_of(snapped, domain->outlines.front());
  RC_ASSERT(std::abs(area_of(mesh) - expected) <= 1e-6 * expected + 4 * snapped.lattice.step * length);
}

RC_GTEST_PROP(concave, meshes_of_float32_keep_the_promise_or_say_that_they_cannot, ()) {
  const PointSet points = *rc::gen::arbitrary<bool>()
                              ? around_a_bay(*rc::gen::arbitrary<std::uint32_t>(), *rc::gen::inRange(50, 200))
                              : any_points(120);
  RC_PRE(hull_of(*grid::snap_points(points, DuplicatePolicy::kFirst)).has_value());
  const double goal = *rc::gen::element(0.0, 0.5, 3.0, 20.0);
  const auto result = simplify_points(points, {.max_error = goal, .boundary_length = any_length(points)});
  if (!result) {
    RC_ASSERT(result.error().kind == ErrorKind::kPromise);
    return;
  }
  MeasureOptions judge;
  judge.inlets = true;
  const auto judged = *measure_points(points, result->simplified.mesh, DuplicatePolicy::kFirst, judge);
  RC_ASSERT(judged.max_error <= goal + 1e-12 * (goal + 50));
  RC_ASSERT(judged.is_sound());
  RC_ASSERT(judged.uncovered == 0u);
}

TEST(concave, hull_takes_no_length_that_is_none) {
  const PointSet points = around_a_bay(1, 100);
  for (const double length : {0.0, -1.0, std::nan("")}) {
    const auto result = simplify_points(points, {.max_error = 1.0, .boundary_length = length});
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().kind, ErrorKind::kUsage);
    EXPECT_NE(result.error().message.find("boundary_length"), std::string::npos);
  }
}

/// `place` returns x and y of each point, rounded to centimetres.
template <class Place>
PointSet on_hills(int count, const Place& place) {
  PointSet points;
  for (int i = 0; i < count; ++i) {
    const auto [x, y] = place(i);
    points.x.push_back(500000 + std::nearbyint(100 * x) / 100);
    points.y.push_back(4649000 + std::nearbyint(100 * y) / 100);
    points.z.push_back(40 * std::sin(x / 90) * std::cos(y / 70));
  }
  return points;
}

HullFit fit_of(const PointSet& points) {
  return refine::find_hull_fit(*grid::snap_points(points, DuplicatePolicy::kFirst));
}

class Uniform {
 public:
  explicit Uniform(std::uint32_t seed) : random_(seed) {}
  double operator()(double range) { return range * (static_cast<double>(random_()) / 4294967296.0); }

 private:
  std::mt19937 random_;
};

TEST(concave, hull_is_not_suggested_for_points_scattered_evenly_or_on_grids) {
  for (std::uint32_t seed = 1; seed <= 8; ++seed) {
    Uniform any(seed);
    for (const int count : {3, 4, 10, 30, 100, 300, 1000, 3000, 10000}) {
      const double side = 10 * std::sqrt(count);
      const HullFit square = fit_of(on_hills(count, [&](int) { return std::pair(any(side), any(side)); }));
      EXPECT_EQ(square.boundary_length, 0) << seed << ", " << count << ": " << square.bridged << ", " << square.slivers;
      const HullFit disk = fit_of(on_hills(count, [&](int) {
        const double angle = any(6.2831853), radius = side * std::sqrt(any(1));
        return std::pair(radius * std::cos(angle), radius * std::sin(angle));
      }));
      EXPECT_EQ(disk.boundary_length, 0) << seed << ", " << count << ": " << disk.bridged << ", " << disk.slivers;
    }
    for (const double jitter : {0.0, 3.0}) {
      for (const int side : {3, 10, 100}) {
        const HullFit fit = fit_of(on_hills(side * side, [&](int i) {
          return std::pair(10.0 * (i % side) + any(jitter), 10.0 * (i / side) + any(jitter));
        }));
        EXPECT_EQ(fit.boundary_length, 0) << seed << ", " << jitter << ", " << side << ": " << fit.slivers;
      }
    }
  }
}

TEST(concave, hull_is_suggested_for_bays_and_not_in_pieces_for_tracks) {
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    const PointSet bay = around_a_bay(seed, 3000);
    const HullFit fit = fit_of(bay);
    EXPECT_GT(fit.bridged, 0.15);
    EXPECT_GT(fit.boundary_length, 40);
    EXPECT_LT(fit.boundary_length, 300);
    const auto points = *grid::snap_points(bay, DuplicatePolicy::kFirst);
    const auto domain = refine::build_concave_domain(points, *hull_of(points), fit.boundary_length);
    EXPECT_LT(area_of(points, domain->outlines.front()), 0.82 * 1e6);
    EXPECT_GT(area_of(points, domain->outlines.front()), 0.70 * 1e6);
    Uniform any(seed);
    for (const double across : {5.0, 20.0, 100.0}) {
      const HullFit tracks =
          fit_of(on_hills(4000, [&](int i) { return std::pair(i % 200 + any(0.3), across * (i / 200) + any(0.2)); }));
      EXPECT_TRUE(tracks.boundary_length == 0 || tracks.boundary_length > 1.2 * across) << tracks.boundary_length;
    }
  }
}

TEST(concave, hull_is_suggested_for_slivers_at_a_straight_rim_and_takes_most_of_them) {
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    Uniform any(seed);
    const PointSet points = on_hills(2860, [&](int i) {
      if (i < 2500) return std::pair(any(1000), any(800));
      if (i < 2600) return std::pair(10.0 * (i - 2500), any(0.3));
      if (i < 2700) return std::pair(10.0 * (i - 2600), 800 - any(0.3));
      if (i < 2780) return std::pair(any(0.3), 10.0 * (i - 2700));
      return std::pair(1000 - any(0.3), 10.0 * (i - 2780));
    });
    const HullFit fit = fit_of(points);
    EXPECT_GT(fit.slivers, 50u);
    ASSERT_GT(fit.boundary_length, 20);
    EXPECT_LT(fit.boundary_length, 100);
    const auto count_steep = [&](std::optional<double> length) {
      const auto result =
          simplify_points(points, {.max_error = 0.0, .float32_positions = false, .boundary_length = length});
      const Mesh& mesh = result->simplified.mesh;
      int steep = 0;
      for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        const auto a = mesh.vertex(mesh.triangles[3 * t]), b = mesh.vertex(mesh.triangles[3 * t + 1]),
                   c = mesh.vertex(mesh.triangles[3 * t + 2]);
        const double ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2], vx = c[0] - a[0], vy = c[1] - a[1],
                     vz = c[2] - a[2];
        steep += std::hypot(uy * vz - uz * vy, uz * vx - ux * vz) > 5.67 * std::abs(ux * vy - uy * vx);
      }
      return steep;
    };
    EXPECT_LT(2 * count_steep(fit.boundary_length), count_steep(std::nullopt));
  }
}

}  // namespace
}  // namespace scarp::concave_laws_test
