// Fitting: a mesh with fewer vertices and the same bound, domain and constraints.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <functional>
#include <limits>
#include <set>
#include <utility>

#include "fit/fit.h"
#include "fit/height_room.h"
#include "fit/ring_search.h"
#include "geom/exact_error.h"
#include "laws/fit_meshes.h"
#include "laws/mesh_laws.h"
#include "laws/tile_meshes.h"

namespace scarp::fit_laws_test {
namespace {

using testing::any_field;
using testing::any_threshold;
using testing::Field;
using testing::includes;
using testing::is_on_side;
using testing::is_same;
using testing::outline_of;
using testing::Points;
using testing::refined;
using testing::Relief;
using testing::vertices_of;

RC_GTEST_PROP(fit, keeps_the_bound_the_domain_and_the_outline, ()) {
  const Field field = any_field();
  const double threshold = any_threshold();
  auto tin = refined(field, threshold);
  RC_PRE(tin.has_value());
  const Points vertices = vertices_of(*tin), outline = outline_of(*tin, field);
  const std::int64_t outside = testing::outside_area2(*tin);
  const auto fitted =
      *fit::fit(field.raster(), std::move(*tin),
                {.threshold = threshold, .threads = 2, .patch_side = *rc::gen::element(0, 1, 5, 16, 40)});
  const std::string unsound = testing::verify_triangulation(fitted.tin, field.cols, field.rows, testing::Edges::kAny);
  RC_ASSERT(unsound == "");
  const std::string broken = testing::find_broken_bound(field.raster(), fitted.tin, threshold);
  RC_ASSERT(broken == "");
  RC_ASSERT(testing::outside_area2(fitted.tin) == outside);
  const Points left = vertices_of(fitted.tin);
  RC_ASSERT(left.size() == fitted.tin.vertex_count());
  RC_ASSERT(left.size() + fitted.counts.removed == vertices.size());
  RC_ASSERT(includes(vertices, left));
  RC_ASSERT(outline_of(fitted.tin, field) == outline);
}

RC_GTEST_PROP(fit, raises_the_threshold_until_the_mesh_is_within_the_budgets, ()) {
  const Field field = any_field();
  const double threshold = any_threshold();
  auto tin = refined(field, threshold);
  RC_PRE(tin.has_value());
  const auto count = [](const tin::Triangulation& of) {
    std::uint64_t inside = 0;
    for (tin::Triangle t = 0; t < of.triangle_count(); ++t) inside += of.is_outside(t) ? 0 : 1;
    return inside;
  };
  fit::FitOptions options{.threshold = threshold, .threads = 2, .depth = testing::any_depth(0)};
  options.vertices_are_free = *rc::gen::arbitrary<bool>();
  options.patch_side = *rc::gen::element(0, 5, 16, 40);
  options.room = fit::Room{.highest = threshold * *rc::gen::element(1.0, 1.3, 4.0)};
  RC_PRE(count(*tin) >= 16);
  const auto share = *rc::gen::element<std::uint64_t>(2, 3, 8);
  if (*rc::gen::arbitrary<bool>()) {
    options.room->most_triangles = std::max<std::uint64_t>(count(*tin) / share, 1);
  } else {
    options.room->most_vertices = std::max<std::uint64_t>(tin->vertex_count() / share, 3);
  }
  const std::int64_t outside = testing::outside_area2(*tin);
  const auto fitted = *fit::fit(field.raster(), std::move(*tin), options);
  RC_ASSERT(fitted.threshold >= threshold);
  RC_ASSERT(fitted.threshold <= options.room->highest);
  const bool is_within =
      count(fitted.tin) <= options.room->most_triangles && fitted.tin.vertex_count() <= options.room->most_vertices;
  RC_ASSERT(is_within || fitted.threshold == options.room->highest);
  const std::string broken = fitted.lattice.steps == 1
                                 ? testing::find_broken_bound(field.raster(), fitted.tin, fitted.threshold)
                                 : testing::find_broken_bound(field.raster(), fitted, fitted.threshold);
  RC_ASSERT(broken == "");
  const std::int64_t area = fitted.lattice.steps * fitted.lattice.steps;
  RC_ASSERT(testing::outside_area2(fitted.tin) == outside * area);
}

RC_GTEST_PROP(fit, keeps_the_worst_shape_above_the_floor_or_no_worse_than_it_was, ()) {
  const Field field = any_field();
  const double threshold = any_threshold();
  auto tin = refined(field, threshold);
  RC_PRE(tin.has_value());
  const double floor = *rc::gen::element(0.03125, 0.125, 0.25, 0.5), aspect = *rc::gen::element(1.0, 0.5, 2.0);
  const auto worst = testing::worst_shape(*tin, aspect, testing::ShapeOracle(floor));
  const auto fitted = *fit::fit(field.raster(), std::move(*tin),
                                {.threshold = threshold,
                                 .threads = 2,
                                 .depth = testing::any_depth(0),
                                 .min_shape = floor,
                                 .aspect = aspect,
                                 .vertices_are_free = *rc::gen::arbitrary<bool>(),
                                 .patch_side = *rc::gen::element(0, 5, 16)});
  RC_ASSERT(!(testing::worst_shape(fitted.tin, aspect, testing::ShapeOracle(floor)) < worst));
}

RC_GTEST_PROP(fit, leaves_the_sides_alone_where_they_are_not_free, ()) {
  const Field field = any_field();
  const double threshold = any_threshold();
  auto tin = refined(field, threshold);
  RC_PRE(tin.has_value());
  const auto on_sides = [&](const tin::Triangulation& of) {
    Points points;
    for (const auto& [x, y] : vertices_of(of)) {
      if (is_on_side({x, y}, field)) points.insert({x, y});
    }
    return points;
  };
  const Points before_fit = on_sides(*tin);
  const auto fitted =
      *fit::fit(field.raster(), std::move(*tin), {.threshold = threshold, .free_sides = {false, false, false, false}});
  RC_ASSERT(on_sides(fitted.tin) == before_fit);
}

RC_GTEST_PROP(fit, relocation_keeps_the_bound_the_domain_and_vertices_on_samples, ()) {
  const Field field = any_field();
  const double threshold = any_threshold();
  auto tin = refined(field, threshold);
  RC_PRE(tin.has_value());
  const std::int64_t outside = testing::outside_area2(*tin);
  const Points outline = outline_of(*tin, field);
  const auto fitted = *fit::fit(field.raster(), std::move(*tin),
                                {.threshold = threshold,
                                 .threads = 2,
                                 .depth = {.relocates = true},
                                 .patch_side = *rc::gen::element(0, 1, 5, 16, 40)});
  const std::string unsound = testing::verify_triangulation(fitted.tin, field.cols, field.rows, testing::Edges::kAny);
  RC_ASSERT(unsound == "");
  const std::string broken = testing::find_broken_bound(field.raster(), fitted.tin, threshold);
  RC_ASSERT(broken == "");
  RC_ASSERT(testing::outside_area2(fitted.tin) == outside);
  RC_ASSERT(fitted.lattice.are_samples());
  RC_ASSERT(outline_of(fitted.tin, field) == outline);
  for (const auto& [x, y] : vertices_of(fitted.tin)) {
    const bool is_corner = (x == 0 || x == field.cols - 1) && (y == 0 || y == field.rows - 1);
    RC_ASSERT(is_corner || field.raster().is_valid({x, y}));
  }
}

TEST(fit, relocation_leaves_fewer_vertices) {
  const Field field = testing::random_field(31, 200, 180, testing::Relief::kRidges);
  fit::FitOptions options{.threshold = 20};
  const auto removed = *fit::fit(field.raster(), *refined(field, 20), options);
  options.depth.relocates = true;
  const auto relocated = *fit::fit(field.raster(), *refined(field, 20), options);
  EXPECT_LT(relocated.tin.vertex_count(), removed.tin.vertex_count());
}

RC_GTEST_PROP(fit, threads_change_nothing, ()) {
  const Field field = any_field();
  const double threshold = any_threshold();
  RC_PRE(refined(field, threshold).has_value());
  fit::FitOptions options{.threshold = threshold,
                          .threads = 1,
                          .depth = {.relocates = *rc::gen::arbitrary<bool>()},
                          .patch_side = *rc::gen::element(3, 8, 16)};
  const auto first = *fit::fit(field.raster(), *refined(field, threshold), options);
  for (const int threads : {2, 7}) {
    options.threads = threads;
    const auto again = *fit::fit(field.raster(), *refined(field, threshold), options);
    RC_ASSERT(is_same(again.tin, first.tin));
    RC_ASSERT(again.counts.searches == first.counts.searches);
  }
}

RC_GTEST_PROP(fit, a_second_run_finds_nothing_more, ()) {
  const Field field = any_field();
  const double threshold = any_threshold();
  auto tin = refined(field, threshold);
  RC_PRE(tin.has_value());
  auto first = *fit::fit(field.raster(), std::move(*tin), {.threshold = threshold});
  const auto second = *fit::fit(field.raster(), std::move(first.tin), {.threshold = threshold});
  RC_ASSERT(second.counts.removed == 0u);
}

TEST(fit, a_plane_is_left_with_two_triangles) {
  Field field{30, 20, {}};
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 30; ++x) field.samples.push_back(static_cast<float>(3 * x - 2 * y));
  tin::Triangulation tin(30, 20);
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 30; ++x) tin.insert({x, y}, tin.locate({x, y}, tin.last_touched()));
  for (const std::int32_t side : {0, 8}) {
    const auto fitted =
        *fit::fit(field.raster(), *refined(field, 0), {.threshold = 0, .threads = 1, .patch_side = side});
    EXPECT_EQ(fitted.tin.triangle_count(), 2u);
  }
  EXPECT_EQ(fit::fit(field.raster(), std::move(tin), {.threshold = 0, .threads = 1})->tin.triangle_count(), 2u);
}

TEST(fit, halves_a_greedy_mesh) {
  const Field field = testing::random_field(7, 200, 150, Relief::kRidges);
  const auto before_fit = refined(field, 4)->triangle_count();
  const auto whole = *fit::fit(field.raster(), *refined(field, 4), {.threshold = 4, .threads = 2});
  EXPECT_LT(static_cast<double>(whole.tin.triangle_count()), 0.75 * static_cast<double>(before_fit));
  // After the second round has released borders of patches, they cost almost nothing.
  const auto patches = *fit::fit(field.raster(), *refined(field, 4), {.threshold = 4, .threads = 2, .patch_side = 64});
  EXPECT_LT(static_cast<double>(patches.tin.triangle_count()), 1.02 * static_cast<double>(whole.tin.triangle_count()));
}

TEST(fit, heights_beyond_float32_products_are_left_alone) {
  Field field = testing::random_field(5, 20, 20, Relief::kFlat);
  field.samples[210] = 0x1p100f;
  const auto before_fit = refined(field, 1)->triangle_count();
  EXPECT_EQ(fit::fit(field.raster(), *refined(field, 1), {.threshold = 1})->tin.triangle_count(), before_fit);
}

TEST(fit, triangles_beyond_its_arithmetic_are_left_alone) {
  const std::int32_t cols = fit::kMaxFitSteps / grid::kLatticeSteps + 100;
  const std::vector<float> samples(2 * static_cast<std::size_t>(cols), 7.0f);
  tin::Triangulation tin(cols, 2);
  tin.insert({cols / 2, 0}, tin.locate({cols / 2, 0}, 0));
  EXPECT_EQ(fit::fit({samples.data(), cols, 2}, std::move(tin), {.threshold = 1})->counts.removed, 0u);
}

std::int64_t area_of(const fit::FitCorner& a, const fit::FitCorner& b, const fit::FitCorner& c) {
  return orient({a.x, a.y}, {b.x, b.y}, {c.x, c.y});
}

/// The verdict, energies and pull by scanning every sample of the raster.
struct Oracle {
  bool keeps = true;
  double energy = 0, eighth = 0, worst = 0;  // worst: in thresholds
  double stiffness = 0, push = 0;

  struct Residual {
    double error, weight;  // error and weight of the first corner
  };
  std::vector<Residual> residuals;

  Oracle(const grid::Raster& raster, const std::array<fit::FitCorner, 3>& corners, double threshold) {
    std::array<Point, 3> places;
    std::array<float, 3> heights;
    for (std::size_t k = 0; k < 3; ++k) {
      places[k] = {corners[k].x, corners[k].y};
      heights[k] = corners[k].z;
    }
    const auto area = static_cast<double>(orient(places[0], places[1], places[2]));
    for (Point p{0, 0}; p.y < raster.rows; ++p.y) {
      for (p.x = 0; p.x < raster.cols; ++p.x) {
        const Point at{p.x * grid::kLatticeSteps, p.y * grid::kLatticeSteps};
        double height = 0;
        std::array<double, 3> weights;
        bool inside = raster.is_valid(p);
        for (std::size_t k = 0; k < 3; ++k) {
          const std::int64_t weight = orient(places[(k + 1) % 3], places[(k + 2) % 3], at);
          inside = inside && weight >= 0;
          weights[k] = static_cast<double>(weight) / area;
          height += weights[k] * double{heights[k]};
        }
        if (!inside) continue;
        keeps = keeps && !geom::exceeds_exactly(places, heights, at, raster.at(p), threshold);
        const double error = (height - raster.at(p)) / threshold;
        energy += error * error;
        eighth += std::pow(error, 8);
        worst = std::max(worst, std::abs(error));
        residuals.push_back({error, weights[0]});
        stiffness += std::pow(error, 6) * weights[0] * weights[0];
        push += std::pow(error, 7) * weights[0];
      }
    }
  }
};

RC_GTEST_PROP(triangle_error, decides_as_exact_arithmetic_does_at_every_sample, ()) {
  const Field field = any_field();
  const double threshold = any_threshold();
  std::array<fit::FitCorner, 3> corners{any_corner(field), any_corner(field), any_corner(field)};
  RC_PRE(area_of(corners[0], corners[1], corners[2]) != 0);
  if (area_of(corners[0], corners[1], corners[2]) < 0) std::swap(corners[1], corners[2]);
  const fit::TriangleError error(field.raster(), {0, 0}, threshold);
  const auto verdict = error.assess(corners[0], corners[1], corners[2], std::numeric_limits<float>::infinity());
  const Oracle oracle(field.raster(), corners, threshold);
  RC_ASSERT((verdict.kind == fit::TriangleError::Verdict::Kind::kKeeps) == oracle.keeps);
  if (oracle.keeps && threshold > 1e-6)
    RC_ASSERT(std::abs(static_cast<double>(verdict.energy) - oracle.energy) <= 1e-3 * (1 + oracle.energy));
  if (!oracle.keeps) {
    const std::array<Point, 3> places{
        Point{corners[0].x, corners[0].y}, {corners[1].x, corners[1].y}, {corners[2].x, corners[2].y}};
    const Point at{verdict.witness.x * grid::kLatticeSteps, verdict.witness.y * grid::kLatticeSteps};
    RC_ASSERT(orient(places[0], places[1], at) >= 0);
    RC_ASSERT(orient(places[1], places[2], at) >= 0);
    RC_ASSERT(orient(places[2], places[0], at) >= 0);
    RC_ASSERT(geom::exceeds_exactly(places, {corners[0].z, corners[1].z, corners[2].z}, at,
                                    field.raster().at(verdict.witness), threshold));
  }
}

RC_GTEST_PROP(triangle_error, lets_through_what_the_slack_allows_and_tells_what_keeps_the_threshold, ()) {
  const Field field = any_field();
  const double threshold = *rc::gen::element(0.5, 1.0, 2.0, 7.3, 30.0, 1e6);
  std::array<fit::FitCorner, 3> corners{any_corner(field), any_corner(field), any_corner(field)};
  RC_PRE(area_of(corners[0], corners[1], corners[2]) > 0);
  const fit::TriangleError error(field.raster(), {0, 0}, threshold);
  const double slack = *rc::gen::element(1.5, 2.5, 4.0);
  const fit::TriangleError loose = error.with({slack, fit::ErrorRule::Power::kEight});
  const auto verdict = loose.assess(corners[0], corners[1], corners[2], std::numeric_limits<float>::infinity());
  const Oracle oracle(field.raster(), corners, threshold);
  const bool passes = verdict.kind == fit::TriangleError::Verdict::Kind::kKeeps;
  if (std::abs(oracle.worst - slack) > 1e-3) RC_ASSERT(passes == (oracle.worst < slack));
  if (!passes) return;
  RC_ASSERT((verdict.worst <= threshold) == oracle.keeps);
  RC_ASSERT(std::abs(verdict.worst / threshold - oracle.worst) <= 1e-3);
  RC_ASSERT(std::abs(static_cast<double>(verdict.energy) - oracle.eighth) <= 1e-3 * (1 + oracle.eighth));
}

RC_GTEST_PROP(triangle_error, pulls_as_the_samples_do, ()) {
  const Field field = any_field();
  const double threshold = *rc::gen::element(2.0, 7.3, 30.0);
  std::array<fit::FitCorner, 3> corners{any_corner(field), any_corner(field), any_corner(field)};
  RC_PRE(area_of(corners[0], corners[1], corners[2]) > 0);
  const fit::TriangleError error(field.raster(), {0, 0}, threshold, {1, fit::ErrorRule::Power::kEight});
  const Oracle oracle(field.raster(), corners, threshold);
  RC_PRE(oracle.worst < 10);
  const auto pull = error.pull(corners[0], corners[1], corners[2]);
  RC_ASSERT(std::abs(pull.stiffness - oracle.stiffness) <= 1e-2 * (1 + oracle.stiffness));
  RC_ASSERT(std::abs(pull.push - oracle.push) <= 1e-2 * (1 + oracle.eighth));
  fit::TriangleError::Moments moments{};
  error.add_moments(corners[0], corners[1], corners[2], moments);
  RC_ASSERT(std::abs(moments[0] - oracle.eighth) <= 1e-2 * (1 + oracle.eighth));
  RC_ASSERT(std::abs(moments[1] - oracle.push) <= 1e-2 * (1 + oracle.eighth));
  RC_ASSERT(std::abs(moments[2] - oracle.stiffness) <= 1e-2 * (1 + oracle.stiffness));
  double square = 0, share = 0, both = 0;
  for (const auto& [t, weight] : oracle.residuals) {
    square += t * t;
    share += weight * weight;
    both += t * weight;
  }
  const fit::TriangleError even = error.with({1, fit::ErrorRule::Power::kTwo});
  const auto even_pull = even.pull(corners[0], corners[1], corners[2]);
  RC_ASSERT(std::abs(even_pull.stiffness - share) <= 1e-2 * (1 + share));
  RC_ASSERT(std::abs(even_pull.push - both) <= 1e-2 * (1 + square));
  moments = {};
  even.add_moments(corners[0], corners[1], corners[2], moments);
  RC_ASSERT(std::abs(moments[0] - square) <= 1e-2 * (1 + square));
  RC_ASSERT(std::abs(moments[1] - both) <= 1e-2 * (1 + square));
  RC_ASSERT(std::abs(moments[2] - share) <= 1e-2 * (1 + share));
}

RC_GTEST_PROP(height_room, holds_the_rises_that_keep_the_threshold_and_no_others, ()) {
  const Field field = any_field();
  const double threshold = *rc::gen::element(2.0, 7.3, 30.0);
  std::array<fit::FitCorner, 3> corners{any_corner(field), any_corner(field), any_corner(field)};
  RC_PRE(area_of(corners[0], corners[1], corners[2]) > 0);
  const fit::TriangleError error(field.raster(), {0, 0}, threshold);
  const Oracle oracle(field.raster(), corners, threshold);
  RC_PRE(oracle.worst < 10);
  fit::TriangleError::Room room{-100, 100};
  error.narrow(corners[0], corners[1], corners[2], room);
  const double wish = *rc::gen::inRange(-300, 300) / 100.0;
  const auto rise = fit::rise_in(room, wish);
  const auto worst_after = [&](double by, double least_weight) {
    double worst = 0;
    for (const auto& [t, weight] : oracle.residuals) {
      if (weight > least_weight) worst = std::max(worst, std::abs(t + weight * by));
    }
    return worst;
  };
  if (rise) RC_ASSERT(worst_after(*rise, 1e-2) <= 1.01);
  if (!rise || std::abs(*rise - wish) > 2e-4) RC_ASSERT(worst_after(wish, 0) >= 0.99);
}

RC_GTEST_PROP(triangle_error, gives_up_only_where_the_energy_reaches_the_limit, ()) {
  const Field field = any_field();
  const double threshold = *rc::gen::element(2.0, 7.3, 30.0, 1e6);
  std::array<fit::FitCorner, 3> corners{any_corner(field), any_corner(field), any_corner(field)};
  RC_PRE(area_of(corners[0], corners[1], corners[2]) > 0);
  const fit::TriangleError error(field.raster(), {0, 0}, threshold);
  const auto whole = error.assess(corners[0], corners[1], corners[2], std::numeric_limits<float>::infinity());
  RC_PRE(whole.kind == fit::TriangleError::Verdict::Kind::kKeeps);
  const auto limit = static_cast<float>(*rc::gen::element(0.0, 0.1, 1.0, 5.0));
  const auto limited = error.assess(corners[0], corners[1], corners[2], limit);
  RC_ASSERT((limited.kind == fit::TriangleError::Verdict::Kind::kKeeps) == (whole.energy < limit));
}

testing::ShapeOracle shape_of(const fit::FitCorner& a, const fit::FitCorner& b, const fit::FitCorner& c) {
  return {{Point{a.x, a.y}, {b.x, b.y}, {c.x, c.y}}, 1};
}

/// The least energy of all triangulations of a ring's corners first … last with no shape below the floor, by trying
/// all; infinite if there is none.
double least_energy(const fit::TriangleError& error, const std::vector<fit::FitCorner>& ring, std::size_t first,
                    std::size_t last, const testing::ShapeOracle& floor) {
  if (last == first + 1) return 0;
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t q = first + 1; q < last; ++q) {
    if (area_of(ring[first], ring[q], ring[last]) <= 0) continue;
    if (shape_of(ring[first], ring[q], ring[last]) < floor) continue;
    const auto verdict = error.assess(ring[first], ring[q], ring[last], std::numeric_limits<float>::infinity());
    if (verdict.kind != fit::TriangleError::Verdict::Kind::kKeeps) continue;
    best = std::min(best, double{verdict.energy} + least_energy(error, ring, first, q, floor) +
                              least_energy(error, ring, q, last, floor));
  }
  return best;
}

/// Corners around a hub at the middle of the field, in positive order: a star-shaped polygon seen from the hub.
std::vector<fit::FitCorner> any_ring(const Field& field, fit::FitCorner hub) {
  std::vector<fit::FitCorner> ring;
  const auto count = *rc::gen::inRange(3, 9);
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * 3.14159265358979 * (i + *rc::gen::element(0.0, 0.3)) / count;
    const auto reach = *rc::gen::inRange(2, std::min(field.cols, field.rows) / 2);
    fit::FitCorner corner;
    corner.x = hub.x + static_cast<std::int32_t>(std::lround(reach * std::cos(angle))) * grid::kLatticeSteps;
    corner.y = hub.y + static_cast<std::int32_t>(std::lround(reach * std::sin(angle))) * grid::kLatticeSteps;
    corner.z = field.raster().at({corner.x / grid::kLatticeSteps, corner.y / grid::kLatticeSteps});
    ring.push_back(corner);
  }
  return ring;
}

RC_GTEST_PROP(ring_search, finds_the_least_energy_of_all_triangulations, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const Field field = testing::random_field(seed, 24, 24, *rc::gen::element(Relief::kTies, Relief::kRidges));
  const fit::FitCorner hub{12 * grid::kLatticeSteps, 12 * grid::kLatticeSteps, field.raster().at({12, 12})};
  const std::vector<fit::FitCorner> ring = any_ring(field, hub);
  for (std::size_t i = 0; i < ring.size(); ++i) RC_PRE(area_of(hub, ring[i], ring[(i + 1) % ring.size()]) > 0);
  const double threshold = *rc::gen::element(0.5, 1.0, 2.0, 3.0, 15.0, 40.0);
  const fit::TriangleError error(field.raster(), {0, 0}, threshold);
  const double least_shape = *rc::gen::element(0.0, 0.0, 0.125, 0.25, 0.5);
  testing::ShapeOracle floor(least_shape);
  for (std::size_t i = 0; i < ring.size(); ++i)
    floor = std::min(floor, shape_of(hub, ring[i], ring[(i + 1) % ring.size()]));
  const double best = least_energy(error, ring, 0, ring.size() - 1, floor);
  fit::RingSearch search(error, {least_shape});
  Point witness{12, 12};
  const bool found = search.find(ring, hub, witness);
  RC_ASSERT(found == std::isfinite(best));
  if (!found) return;
  RC_ASSERT(std::abs(double{search.energy()} - best) <= 1e-4 * (1 + best));
  std::vector<fit::Patch::RingTriangle> triangles, decoded;
  search.triangles(triangles);
  fit::RingSearch::decode(search.code(), ring.size(), decoded);
  RC_ASSERT(triangles.size() == ring.size() - 2);
  RC_ASSERT(decoded.size() == triangles.size());
  double sum = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    RC_ASSERT(triangles[i].middle == decoded[i].middle);
    sum += double{triangles[i].energy};
  }
  RC_ASSERT(std::abs(sum - best) <= 1e-4 * (1 + best));
}

}  // namespace
}  // namespace scarp::fit_laws_test
