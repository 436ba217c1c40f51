// Removal with repair, and its parts: moves, flips, and undoing all of them.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <atomic>
#include <bit>
#include <functional>
#include <limits>
#include <memory>
#include <utility>

#include "fit/collapse.h"
#include "fit/cut.h"
#include "fit/fit.h"
#include "fit/flips.h"
#include "fit/height_step.h"
#include "fit/repair.h"
#include "fit/ring_search.h"
#include "fit/vertex_step.h"
#include "geom/exact_error.h"
#include "laws/fit_meshes.h"
#include "laws/mesh_laws.h"
#include "laws/sanitized.h"
#include "laws/tile_meshes.h"

namespace scarp::repair_laws_test {
namespace {

using testing::any_depth;
using testing::any_field;
using testing::any_threshold;
using testing::Field;
using testing::is_on_side;
using testing::is_same;
using testing::Points;
using testing::refined;
using testing::Relief;

/// Constrained edges within the rectangle, from their first end.
std::set<std::pair<std::pair<std::int32_t, std::int32_t>, std::pair<std::int32_t, std::int32_t>>> constraints_of(
    const tin::Triangulation& tin) {
  std::set<std::pair<std::pair<std::int32_t, std::int32_t>, std::pair<std::int32_t, std::int32_t>>> edges;
  for (tin::HalfEdge h = 0; h < 3 * tin.triangle_count(); ++h) {
    if (!tin.is_constrained(h) || tin.twin(h) == tin::kNone) continue;
    const Point p = tin.point(tin.origin(h)), q = tin.point(tin.origin(tin::Triangulation::next(h)));
    edges.insert(std::minmax(std::pair{p.x, p.y}, std::pair{q.x, q.y}));
  }
  return edges;
}

Points side_vertices_of(const tin::Triangulation& tin, const Field& field) {
  Points points;
  for (tin::Vertex v = 0; v < tin.vertex_count(); ++v) {
    if (is_on_side(tin.point(v), field)) points.insert({tin.point(v).x, tin.point(v).y});
  }
  return points;
}

RC_GTEST_PROP(repair, keeps_the_bound_the_domain_and_the_constraints, ()) {
  const Field field = any_field();
  const double threshold = any_threshold();
  auto tin = refined(field, threshold);
  RC_PRE(tin.has_value());
  const auto constraints = constraints_of(*tin);
  const std::size_t vertices = tin->vertex_count();
  const std::int64_t outside = testing::outside_area2(*tin);
  const auto fitted = *fit::fit(
      field.raster(), std::move(*tin),
      {.threshold = threshold, .threads = 2, .depth = any_depth(1), .patch_side = *rc::gen::element(0, 1, 5, 16, 40)});
  const std::string unsound = testing::verify_triangulation(fitted.tin, field.cols, field.rows, testing::Edges::kAny);
  RC_ASSERT(unsound == "");
  const std::string broken = testing::find_broken_bound(field.raster(), fitted.tin, threshold);
  RC_ASSERT(broken == "");
  RC_ASSERT(testing::outside_area2(fitted.tin) == outside);
  RC_ASSERT(constraints_of(fitted.tin) == constraints);
  RC_ASSERT(fitted.tin.vertex_count() + fitted.counts.removed == vertices);
  RC_ASSERT(fitted.counts.repaired <= fitted.counts.tried);
}

/// Range of the valid samples.
std::pair<float, float> range_of(const Field& field) {
  std::pair<float, float> range{std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest()};
  for (const float sample : field.samples) {
    if (!std::isnan(sample)) range = {std::min(range.first, sample), std::max(range.second, sample)};
  }
  return range;
}

RC_GTEST_PROP(repair, of_free_vertices_keeps_the_bound_the_domain_the_constraints_and_the_range, ()) {
  const Field field = any_field();
  const double threshold = *rc::gen::element(0.5, 1.0, 2.0, 7.3, 30.0, 1e6);
  auto tin = refined(field, threshold);
  RC_PRE(tin.has_value());
  const std::size_t constraints = constraints_of(*tin).size(), vertices = tin->vertex_count();
  const std::int64_t outside = testing::outside_area2(*tin);
  const auto fitted = *fit::fit(field.raster(), std::move(*tin),
                                {.threshold = threshold,
                                 .threads = 2,
                                 .depth = any_depth(1),
                                 .min_shape = *rc::gen::element(0.0, 0.1),
                                 .vertices_are_free = true,
                                 .patch_side = *rc::gen::element(0, 1, 5, 16, 40)});
  RC_ASSERT(fitted.lattice.steps == grid::kLatticeSteps);
  RC_ASSERT(fitted.lattice.heights.size() == fitted.tin.vertex_count());
  const std::string unsound = testing::verify_triangulation(fitted.tin, testing::in_steps(field.cols),
                                                            testing::in_steps(field.rows), testing::Edges::kAny);
  RC_ASSERT(unsound == "");
  const std::string broken = testing::find_broken_bound(field.raster(), fitted, threshold);
  RC_ASSERT(broken == "");
  RC_ASSERT(testing::outside_area2(fitted.tin) == outside * grid::kLatticeSteps * grid::kLatticeSteps);
  const auto left = constraints_of(fitted.tin);
  RC_ASSERT(left.size() == constraints);
  for (const auto& [p, q] : left) {
    RC_ASSERT(p.first % grid::kLatticeSteps == 0 && p.second % grid::kLatticeSteps == 0);
    RC_ASSERT(q.first % grid::kLatticeSteps == 0 && q.second % grid::kLatticeSteps == 0);
  }
  RC_ASSERT(fitted.tin.vertex_count() + fitted.counts.removed == vertices);
  const auto [lowest, highest] = range_of(field);
  for (const float height : fitted.lattice.heights)
    RC_ASSERT(std::isnan(height) || (lowest <= height && height <= highest));
}

RC_GTEST_PROP(repair, leaves_the_sides_alone_where_they_are_not_free, ()) {
  const Field field = any_field();
  const double threshold = any_threshold();
  auto tin = refined(field, threshold);
  RC_PRE(tin.has_value());
  const Points sides = side_vertices_of(*tin, field);
  const auto fitted =
      *fit::fit(field.raster(), std::move(*tin),
                {.threshold = threshold, .free_sides = {false, false, false, false}, .depth = {.rounds = 2}});
  RC_ASSERT(side_vertices_of(fitted.tin, field) == sides);
}

bool have_same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](float x, float y) {
           return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y);
         });
}

RC_GTEST_PROP(repair, threads_change_nothing, ()) {
  const Field field = any_field();
  const double threshold = any_threshold();
  RC_PRE(refined(field, threshold).has_value());
  fit::FitOptions options{.threshold = threshold,
                          .threads = 1,
                          .depth = any_depth(1),
                          .min_shape = *rc::gen::element(0.0, 0.1),
                          .vertices_are_free = *rc::gen::arbitrary<bool>(),
                          .patch_side = *rc::gen::element(3, 8, 16)};
  const auto first = *fit::fit(field.raster(), *refined(field, threshold), options);
  for (const int threads : {2, 7}) {
    options.threads = threads;
    const auto again = *fit::fit(field.raster(), *refined(field, threshold), options);
    RC_ASSERT(is_same(again.tin, first.tin));
    RC_ASSERT(have_same_bits(again.lattice.heights, first.lattice.heights));
    RC_ASSERT(again.counts.tried == first.counts.tried);
  }
}

/// Returns true from the nth call on, by any caller.
std::function<bool()> up_after(int questions) {
  auto left = std::make_shared<std::atomic<int>>(questions);
  return [left] { return left->fetch_sub(1) <= 0; };
}

RC_GTEST_PROP(repair, leaves_a_sound_mesh_within_the_bound_whenever_the_time_is_up, ()) {
  const Field field = any_field();
  const double threshold = *rc::gen::element(0.5, 1.0, 2.0, 7.3, 30.0, 1e6);
  auto tin = refined(field, threshold);
  RC_PRE(tin.has_value());
  const std::size_t constraints = constraints_of(*tin).size(), vertices = tin->vertex_count();
  const bool are_free = *rc::gen::arbitrary<bool>();
  const auto fitted = *fit::fit(field.raster(), std::move(*tin),
                                {.threshold = threshold,
                                 .threads = 2,
                                 .depth = any_depth(1),
                                 .min_shape = *rc::gen::element(0.0, 0.1),
                                 .vertices_are_free = are_free,
                                 .patch_side = *rc::gen::element(0, 5, 16, 40),
                                 .is_time_up = up_after(*rc::gen::element(0, 1, 10, 100, 1000, 1'000'000)),
                                 .goes_on = true});
  const std::int32_t steps = fitted.lattice.steps;
  const std::string unsound = testing::verify_triangulation(fitted.tin, (field.cols - 1) * steps + 1,
                                                            (field.rows - 1) * steps + 1, testing::Edges::kAny);
  RC_ASSERT(unsound == "");
  const std::string broken = steps == 1 ? testing::find_broken_bound(field.raster(), fitted.tin, threshold)
                                        : testing::find_broken_bound(field.raster(), fitted, threshold);
  RC_ASSERT(broken == "");
  RC_ASSERT(constraints_of(fitted.tin).size() == constraints);
  RC_ASSERT(fitted.tin.vertex_count() + fitted.counts.removed == vertices);
}

TEST(repair, goes_on_beyond_its_rounds_while_there_is_time_and_gain) {
  const Field field = testing::random_field(7, 60, 50, Relief::kRidges);
  fit::FitOptions options{.threshold = 4, .threads = 2, .depth = {.rounds = 1}, .vertices_are_free = true};
  const auto once = *fit::fit(field.raster(), *refined(field, 4), options);
  EXPECT_FALSE(once.is_cut_short);
  options.is_time_up = [] { return false; };
  options.goes_on = true;
  const auto longer = *fit::fit(field.raster(), *refined(field, 4), options),
             again = *fit::fit(field.raster(), *refined(field, 4), options);
  EXPECT_FALSE(longer.is_cut_short);
  EXPECT_LT(longer.tin.vertex_count(), once.tin.vertex_count());
  EXPECT_TRUE(is_same(longer.tin, again.tin));
  options.is_time_up = [] { return true; };
  const auto never = *fit::fit(field.raster(), *refined(field, 4), options);
  EXPECT_TRUE(never.is_cut_short);
  EXPECT_EQ(never.counts.removed, 0u);
}

RC_GTEST_PROP(repair, polishing_lowers_the_squared_error_and_leaves_as_many_triangles, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const Field field = testing::random_field(seed, 30, 25, Relief::kRidges);
  fit::FitOptions options{.threshold = 4, .threads = 1, .depth = {.rounds = 1}, .vertices_are_free = true};
  const auto rough = *fit::fit(field.raster(), *refined(field, 4), options);
  options.depth.polishes = 3;
  const auto polished = *fit::fit(field.raster(), *refined(field, 4), options);
  RC_ASSERT(rough.tin.triangle_count() == polished.tin.triangle_count());
  RC_ASSERT(testing::sum_of_squares(field.raster(), polished) < testing::sum_of_squares(field.raster(), rough));
}

TEST(repair, takes_a_quarter_of_what_removal_leaves) {
  Field field{160, 120, {}};
  for (int y = 0; y < field.rows; ++y) {
    for (int x = 0; x < field.cols; ++x)
      field.samples.push_back(static_cast<float>(std::sin(x * 0.11) * 40 + std::sin(y * 0.07 + x * 0.05) * 60));
  }
  const auto triangles = [&](int rounds, std::int32_t side, bool are_free = false) {
    const fit::FitOptions options{
        .threshold = 3, .threads = 2, .depth = {.rounds = rounds}, .vertices_are_free = are_free, .patch_side = side};
    return static_cast<double>(fit::fit(field.raster(), *refined(field, 3), options)->tin.triangle_count());
  };
  EXPECT_LT(triangles(2, 0), 0.75 * triangles(0, 0));
  EXPECT_LT(triangles(2, 0, true), 0.9 * triangles(2, 0));
  EXPECT_LT(triangles(2, 80), 1.1 * triangles(2, 0));
}

TEST(repair, heights_and_triangles_beyond_its_arithmetic_are_left_alone) {
  Field field = testing::random_field(5, 20, 20, Relief::kFlat);
  field.samples[210] = 0x1p100f;
  const fit::FitOptions options{.threshold = 1, .depth = {.rounds = 2}};
  const auto before_fit = refined(field, 1)->triangle_count();
  EXPECT_EQ(fit::fit(field.raster(), *refined(field, 1), options)->tin.triangle_count(), before_fit);

  const std::int32_t cols = fit::kMaxFitSteps / grid::kLatticeSteps + 100;
  const std::vector<float> samples(2 * static_cast<std::size_t>(cols), 7.0f);
  tin::Triangulation tin(cols, 2);
  tin.insert({cols / 2, 0}, tin.locate({cols / 2, 0}, 0));
  EXPECT_EQ(fit::fit({samples.data(), cols, 2}, std::move(tin), options)->counts.removed, 0u);
}

/// A patch that contains a whole mesh.
struct Bench {
  Field field = any_field();
  double threshold = *rc::gen::element(0.5, 1.0, 2.0, 7.3, 30.0);
  std::optional<tin::Triangulation> tin = refined(field, threshold);
  grid::VertexLattice lattice;
  fit::Patch patch;
  std::vector<tin::Vertex> vertices;

  bool cut() {
    if (!tin) return false;
    fit::PatchCutter::Scratch scratch;
    patch = fit::PatchCutter(field.raster(), *tin, lattice, {std::max(field.cols, field.rows), 0}, {}, 1)
                .cut(0, scratch, vertices);
    return patch.face_count() > 0;
  }
  fit::TriangleError errors(const fit::ErrorRule& rule) const {
    return fit::TriangleError(field.raster(), patch.window().first, threshold, rule);
  }
};

bool is_alive(const fit::Patch& patch, fit::Patch::Id f) { return patch.face(f).corners[0] != tin::kNone; }

/// The first broken law of a patch: triangles are positive, links mutual and along the same edge.
std::string verify(const fit::Patch& patch) {
  for (fit::Patch::Id f = 0; f < patch.face_count(); ++f) {
    if (!is_alive(patch, f)) continue;
    const auto& [corners, links, worst, energy] = patch.face(f);
    if (fit::area2(patch.at(corners[0]), patch.at(corners[1]), patch.at(corners[2])) <= 0)
      return fmt::format("face {} is not positive", f);
    for (unsigned k = 0; k < 3; ++k) {
      if (patch.is_removed(corners[k])) return fmt::format("a corner of {} is gone", f);
      if (fit::Patch::is_border(links[k])) continue;
      const fit::Patch::Face& other = patch.face(fit::Patch::triangle_of(links[k]));
      const unsigned e = fit::Patch::edge_of(links[k]);
      if (other.links[e] != (f << 2 | k)) return fmt::format("edge {} of {} is not linked back", k, f);
      if (other.corners[e] != corners[(k + 1) % 3] || other.corners[(e + 1) % 3] != corners[k])
        return fmt::format("edge {} of {} runs elsewhere beyond", k, f);
    }
  }
  for (fit::Patch::Id v = 0; v < patch.node_count(); ++v) {
    if (patch.is_removed(v)) continue;
    fit::Patch::Star star;
    patch.find_star(v, star);
    for (const fit::Patch::Id f : star.faces) {
      const auto& corners = patch.face(f).corners;
      if (corners[0] != v && corners[1] != v && corners[2] != v) return fmt::format("the star of {} is not its own", v);
    }
  }
  return "";
}

/// The complete visible state of a patch.
struct Picture {
  std::vector<fit::Patch::Face> faces;
  std::vector<fit::FitCorner> places;
  std::vector<bool> removed;

  explicit Picture(const fit::Patch& patch) {
    for (fit::Patch::Id f = 0; f < patch.face_count(); ++f) faces.push_back(patch.face(f));
    for (fit::Patch::Id v = 0; v < patch.node_count(); ++v) {
      places.push_back(patch.at(v));
      removed.push_back(patch.is_removed(v));
    }
  }
  bool operator==(const Picture& other) const {
    const auto same_faces = [](const fit::Patch::Face& a, const fit::Patch::Face& b) {
      return a.corners == b.corners && a.links == b.links && a.worst == b.worst && a.energy == b.energy;
    };
    const auto same_places = [](const fit::FitCorner& a, const fit::FitCorner& b) {
      return a.x == b.x && a.y == b.y && a.z == b.z;
    };
    return removed == other.removed &&
           std::equal(faces.begin(), faces.end(), other.faces.begin(), other.faces.end(), same_faces) &&
           std::equal(places.begin(), places.end(), other.places.begin(), other.places.end(), same_places);
  }
};

void flip_somewhere(fit::Patch& patch, fit::Patch::Id f, unsigned edge) {
  if (!is_alive(patch, f) || fit::Patch::is_border(patch.face(f).links[edge])) return;
  const fit::Patch::Quad q = patch.quad(f, edge);
  if (fit::area2(patch.at(q.c), patch.at(q.a), patch.at(q.d)) <= 0) return;
  if (fit::area2(patch.at(q.d), patch.at(q.b), patch.at(q.c)) <= 0) return;
  patch.flip(q);
  patch.set_measure(q.face, 1, 2);
}

void remove_somewhere(fit::Patch& patch, fit::RingSearch& search, fit::Patch::Id v) {
  if (patch.is_locked(v) || patch.is_removed(v)) return;
  fit::Patch::Star star;
  patch.find_star(v, star);
  if (star.ring.size() < 3 || star.ring.size() > fit::RingSearch::kMostCorners) return;
  std::vector<fit::FitCorner> ring;
  for (const fit::Patch::Id u : star.ring) ring.push_back(patch.at(u));
  Point witness{patch.at(v).x / grid::kLatticeSteps, patch.at(v).y / grid::kLatticeSteps};
  if (!search.find(ring, patch.at(v), witness)) return;
  std::vector<fit::Patch::RingTriangle> triangles;
  search.triangles(triangles);
  patch.remove(v, star, triangles);
}

RC_GTEST_PROP(patch, changes_stay_sound_and_can_be_taken_back, ()) {
  Bench bench;
  RC_PRE(bench.cut());
  fit::Patch& patch = bench.patch;
  const fit::TriangleError anything(bench.field.raster(), patch.window().first, 1e9);
  fit::RingSearch search(anything);
  for (int transaction = 0; transaction < 3; ++transaction) {
    const Picture before(patch);
    patch.begin();
    const auto steps = *rc::gen::inRange(0, 30);
    for (int i = 0; i < steps; ++i) {
      const auto f = *rc::gen::inRange<fit::Patch::Id>(0, static_cast<fit::Patch::Id>(patch.face_count()));
      if (*rc::gen::inRange(0, 3) > 0) {
        flip_somewhere(patch, f, *rc::gen::inRange(0u, 3u));
      } else if (is_alive(patch, f)) {
        remove_somewhere(patch, search, patch.face(f).corners[0]);
      }
    }
    RC_ASSERT(verify(patch) == "");
    if (transaction == 1) {
      patch.commit();
    } else {
      patch.roll_back();
      RC_ASSERT(Picture(patch) == before);
    }
    RC_ASSERT(verify(patch) == "");
  }
}

/// The increase of energy; unchanged faces contribute exactly nothing.
double rise_of_energy(const fit::Patch& patch, const Picture& before) {
  double sum = 0;
  for (fit::Patch::Id f = 0; f < patch.face_count(); ++f)
    sum += double{patch.face(f).energy} - double{before.faces[f].energy};
  return sum;
}

/// True if a triangle around v broke the threshold.
bool was_over(const fit::Patch& patch, const Picture& before, fit::Patch::Id v, double threshold) {
  fit::Patch::Star star;
  patch.find_star(v, star);
  return std::any_of(star.faces.begin(), star.faces.end(),
                     [&](fit::Patch::Id f) { return before.faces[f].worst > threshold; });
}

/// True if no changed face is below the floor and worse than all faces before.
bool keeps_shape(const fit::Patch& patch, const Picture& before, const fit::ShapeRule& rule) {
  testing::ShapeOracle floor(rule.floor), worst(1.0);
  for (fit::Patch::Id f = 0; f < patch.face_count(); ++f) {
    const auto& corners = patch.face(f).corners;
    const bool is_where_it_was = std::all_of(corners.begin(), corners.end(), [&](fit::Patch::Id v) {
      return patch.at(v).x == before.places[v].x && patch.at(v).y == before.places[v].y;
    });
    if (corners == before.faces[f].corners && is_where_it_was) continue;
    const auto shape_of = [&](const fit::Patch::Face& face, const auto& place) {
      std::array<Point, 3> points;
      for (std::size_t k = 0; k < 3; ++k) points[k] = {place(face.corners[k]).x, place(face.corners[k]).y};
      return testing::ShapeOracle(points, rule.aspect);
    };
    const auto was = shape_of(before.faces[f], [&](fit::Patch::Id v) { return before.places[v]; });
    const auto is = shape_of(patch.face(f), [&](fit::Patch::Id v) { return patch.at(v); });
    floor = std::min(floor, was);
    worst = std::min(worst, is);
  }
  return !(worst < floor);
}

/// True if every face is measured correctly and within the bound.
bool is_measured(const fit::Patch& patch, const fit::TriangleError& error) {
  for (fit::Patch::Id f = 0; f < patch.face_count(); ++f) {
    const auto& [a, b, c] = patch.face(f).corners;
    const auto verdict = error.assess(patch.at(a), patch.at(b), patch.at(c), std::numeric_limits<float>::infinity());
    if (verdict.kind != fit::TriangleError::Verdict::Kind::kKeeps) return false;
    // The order of the corners determines the last bits.
    const float energy = patch.face(f).energy;
    if (std::abs(verdict.energy - energy) > 1e-3f * (1 + energy)) return false;
  }
  return true;
}

RC_GTEST_PROP(flips, lower_the_energy_and_keep_the_bound, ()) {
  Bench bench;
  RC_PRE(bench.cut());
  const fit::TriangleError error = bench.errors({1, fit::ErrorRule::Power::kEight});
  for (fit::Patch::Id f = 0; f < bench.patch.face_count(); ++f) fit::measure(bench.patch, error, f);
  const fit::ShapeRule shape{*rc::gen::element(0.0, 0.125, 0.5), *rc::gen::element(1.0, 2.0)};
  fit::Flips flips(bench.patch, shape);
  Picture before(bench.patch);
  for (fit::Patch::Id f = 0; f < bench.patch.face_count(); ++f) {
    for (unsigned edge = 0; edge < 3; ++edge) {
      if (!flips.improve(error, f, edge)) continue;
      RC_ASSERT(rise_of_energy(bench.patch, before) < 0);
      RC_ASSERT(keeps_shape(bench.patch, before, shape));
      before = Picture(bench.patch);
    }
  }
  RC_ASSERT(Picture(bench.patch) == before);
  RC_ASSERT(verify(bench.patch) == "");
  RC_ASSERT(is_measured(bench.patch, error));
}

RC_GTEST_PROP(vertex_step, lowers_the_energy_keeps_the_bound_and_ends_where_vertices_may_be, ()) {
  Bench bench;
  RC_PRE(bench.cut());
  fit::Patch& patch = bench.patch;
  const fit::TriangleError error = bench.errors({1, fit::ErrorRule::Power::kEight});
  for (fit::Patch::Id f = 0; f < patch.face_count(); ++f) fit::measure(patch, error, f);
  const auto freedom = *rc::gen::element(fit::Freedom::kSamples, fit::Freedom::kLattice);
  const auto [lowest, highest] = range_of(bench.field);
  const fit::ShapeRule shape{*rc::gen::element(0.0, 0.125), *rc::gen::element(1.0, 2.0)};
  fit::VertexStep step(patch, {freedom, shape, lowest, highest});
  const auto improve = [&](fit::Patch::Id v) {
    const double reach = *rc::gen::element(0.0, 0.07, 0.15, 0.5);
    return reach > 0 ? step.probe(error, v, reach) : step.improve(error, v);
  };
  Picture before(patch);
  for (fit::Patch::Id v = 0; v < patch.node_count(); ++v) {
    const fit::FitCorner from = patch.at(v);
    const bool moved = improve(v);
    if (moved) {
      RC_ASSERT(rise_of_energy(patch, before) < 0);
      RC_ASSERT(keeps_shape(patch, before, shape));
      before = Picture(patch);
    }
    const fit::FitCorner& to = patch.at(v);
    RC_ASSERT(!moved || !patch.is_locked(v));
    RC_ASSERT(moved == (to.x != from.x || to.y != from.y || to.z != from.z));
    if (freedom == fit::Freedom::kLattice) continue;
    RC_ASSERT(to.x % grid::kLatticeSteps == 0 && to.y % grid::kLatticeSteps == 0);
    RC_ASSERT(to.z == error.height_at({to.x / grid::kLatticeSteps, to.y / grid::kLatticeSteps}));
  }
  RC_ASSERT(Picture(patch) == before);
  RC_ASSERT(verify(patch) == "");
  RC_ASSERT(is_measured(patch, error));
}

/// Tries each vertex between two pictures of the whole patch; a fifth of them under sanitizers.
constexpr fit::Patch::Id kStride = testing::kIsSanitized ? 15 : 1;

RC_GTEST_PROP(vertex_step, that_seeks_room_lets_the_energy_rise_only_where_the_star_breaks_the_bound, ()) {
  Bench bench;
  RC_PRE(bench.cut());
  fit::Patch& patch = bench.patch;
  // The mesh satisfies this bound, which is within the slack of a smaller one.
  const fit::TriangleError error = fit::TriangleError(bench.field.raster(), patch.window().first, bench.threshold / 1.5,
                                                      {2, fit::ErrorRule::Power::kEight});
  for (fit::Patch::Id f = 0; f < patch.face_count(); ++f) fit::measure(patch, error, f);
  const auto [lowest, highest] = range_of(bench.field);
  const fit::ShapeRule shape{0.125, 1};
  fit::VertexStep step(patch, {fit::Freedom::kLattice, shape, lowest, highest}, true);
  for (fit::Patch::Id v = 0; v < patch.node_count(); v += kStride) {
    const Picture before(patch);
    const bool moved = *rc::gen::element(false, true) ? step.improve(error, v) : step.probe(error, v, 0.15);
    if (!moved) continue;
    RC_ASSERT(keeps_shape(patch, before, shape));
    RC_ASSERT(lowest <= patch.at(v).z && patch.at(v).z <= highest);
    RC_ASSERT(rise_of_energy(patch, before) < 0 || was_over(patch, before, v, error.threshold()));
  }
  RC_ASSERT(verify(patch) == "");
}

RC_GTEST_PROP(vertex_step, shakes_within_the_bound_and_the_range, ()) {
  Bench bench;
  RC_PRE(bench.cut());
  fit::Patch& patch = bench.patch;
  const fit::TriangleError error = bench.errors({1, fit::ErrorRule::Power::kEight});
  for (fit::Patch::Id f = 0; f < patch.face_count(); ++f) fit::measure(patch, error, f);
  const auto [lowest, highest] = range_of(bench.field);
  fit::VertexStep step(patch, {fit::Freedom::kLattice, {0.125, 1}, lowest, highest});
  for (fit::Patch::Id v = 0; v < patch.node_count(); v += kStride) {
    const Picture before(patch);
    const bool moved = step.shake(error, v, *rc::gen::arbitrary<std::uint32_t>());
    RC_ASSERT(moved || Picture(patch) == before);
    RC_ASSERT(keeps_shape(patch, before, {0.125, 1}));
    const bool is_right =
        patch.is_locked(v) ? Picture(patch) == before : lowest <= patch.at(v).z && patch.at(v).z <= highest;
    RC_ASSERT(is_right);
  }
  RC_ASSERT(verify(patch) == "");
  RC_ASSERT(is_measured(patch, error));
}

RC_GTEST_PROP(collapse, makes_one_vertex_of_two_within_the_bound_the_range_and_the_shapes, ()) {
  Bench bench;
  RC_PRE(bench.cut());
  fit::Patch& patch = bench.patch;
  const fit::TriangleError error = bench.errors({1, fit::ErrorRule::Power::kEight});
  const fit::TriangleError loose = error.with({2.5, fit::ErrorRule::Power::kEight});
  for (fit::Patch::Id f = 0; f < patch.face_count(); ++f) fit::measure(patch, error, f);
  const auto [lowest, highest] = range_of(bench.field);
  const fit::ShapeRule shape{*rc::gen::element(0.0, 0.125), 1};
  const fit::MoveRules rules{fit::Freedom::kLattice, shape, lowest, highest};
  fit::Repair repair(patch, loose, {6, 2.5, true, true, true}, rules);
  const auto thinnest = [&] {
    fit::TriangleShape least{1, 0};
    for (fit::Patch::Id f = 0; f < patch.face_count(); ++f) {
      const auto& [a, b, c] = patch.face(f).corners;
      if (a != tin::kNone) least = shape.lowered(least, patch.at(a), patch.at(b), patch.at(c));
    }
    return least;
  };
  const fit::TriangleShape thinnest_before = thinnest();
  const Picture before(patch);
  const auto counts = fit::Collapse(patch, loose, rules, repair).run([](fit::Patch::Id) { return true; }, {});
  std::uint64_t removed = 0;
  for (fit::Patch::Id v = 0; v < patch.node_count(); ++v) {
    removed += patch.is_removed(v) ? 1 : 0;
    if (!patch.is_removed(v) && patch.at(v).z != before.places[v].z)
      RC_ASSERT(!patch.is_locked(v) && lowest <= patch.at(v).z && patch.at(v).z <= highest);
  }
  RC_ASSERT(removed == counts.done);
  RC_ASSERT(thinnest().keeps(shape.least().worse_of(thinnest_before)));
  RC_ASSERT(verify(patch) == "");
  for (fit::Patch::Id f = 0; f < patch.face_count(); ++f) {
    const auto& [a, b, c] = patch.face(f).corners;
    if (a == tin::kNone) continue;
    const auto verdict = error.assess(patch.at(a), patch.at(b), patch.at(c), std::numeric_limits<float>::infinity());
    RC_ASSERT(verdict.kind == fit::TriangleError::Verdict::Kind::kKeeps);
  }
}

RC_GTEST_PROP(height_step, finds_the_lowest_energy, ()) {
  std::vector<std::pair<double, double>> samples;
  const auto count = *rc::gen::inRange(1, 20);
  for (int i = 0; i < count; ++i)
    samples.push_back({*rc::gen::inRange(-150, 150) / 100.0, *rc::gen::inRange(0, 100) / 100.0});
  const auto energy_at = [&](double rise) {
    double sum = 0;
    for (const auto& [t, share] : samples) sum += std::pow(t + share * rise, 8);
    return sum;
  };
  fit::TriangleError::Moments moments{};
  for (const auto& [t, share] : samples) {
    for (std::size_t k = 0; k < moments.size(); ++k)
      moments[k] += std::pow(t, 8 - static_cast<int>(k)) * std::pow(share, static_cast<int>(k));
  }
  constexpr double kAny = std::numeric_limits<double>::infinity();
  const fit::HeightStep best = fit::best_height(moments, -kAny, kAny);
  RC_ASSERT(best.energy <= energy_at(0) * (1 + 1e-12));
  RC_ASSERT(std::abs(best.energy - energy_at(best.rise)) <= 1e-6 * (1e-9 + energy_at(0)));
  for (double rise = -4; rise <= 4; rise += 0.01) RC_ASSERT(best.energy <= energy_at(rise) + 1e-6 * energy_at(0));
  const double lowest = -*rc::gen::inRange(0, 100) / 100.0, highest = *rc::gen::inRange(0, 100) / 100.0;
  const fit::HeightStep bounded = fit::best_height(moments, lowest, highest);
  RC_ASSERT(lowest <= bounded.rise && bounded.rise <= highest);
  for (double rise = lowest; rise <= highest; rise += 0.01)
    RC_ASSERT(bounded.energy <= energy_at(rise) + 1e-6 * energy_at(0));
}

}  // namespace
}  // namespace scarp::repair_laws_test
