// Meshes of a budget with a small squared error, and the steps that produce them.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "fit/cut.h"
#include "fit/fit.h"
#include "fit/repair.h"
#include "fit/square_rounds.h"
#include "laws/budgets.h"
#include "laws/fields.h"
#include "laws/fit_meshes.h"
#include "laws/mesh_laws.h"
#include "laws/sanitized.h"
#include "scarp/measure.h"
#include "scarp/simplify.h"

namespace scarp::squares_laws_test {
namespace {

using testing::Field;
using testing::hills;
using testing::is_same;
using testing::refined;
using testing::Relief;

fit::FitOptions towards(double threshold, std::uint64_t most) {
  fit::FitOptions options{.threshold = threshold, .threads = 2, .vertices_are_free = *rc::gen::arbitrary<bool>()};
  options.min_shape = *rc::gen::element(0.0, 0.1);
  options.patch_side = *rc::gen::element(0, 1, 5, 16, 40);
  options.squares = fit::SquareGoal{most, fit::kNoBudget, *rc::gen::inRange(0, 4)};
  return options;
}

std::size_t triangles_of(const tin::Triangulation& tin) {
  std::size_t count = 0;
  for (tin::Triangle t = 0; t < tin.triangle_count(); ++t) count += tin.is_outside(t) ? 0 : 1;
  return count;
}

RC_GTEST_PROP(squares, keep_the_bound_and_the_domain, ()) {
  const Field field = testing::any_field();
  const double threshold = *rc::gen::element(0.5, 1.0, 2.0, 7.3, 30.0, 1e6);
  auto tin = refined(field, threshold / *rc::gen::element(1.0, 4.0));
  RC_PRE(tin.has_value());
  const std::int64_t outside = testing::outside_area2(*tin);
  const fit::FitOptions options = towards(threshold, *rc::gen::inRange<std::uint64_t>(1, 400));
  const auto fitted = *fit::fit(field.raster(), std::move(*tin), options);
  const std::int32_t steps = options.vertices_are_free ? grid::kLatticeSteps : 1;
  const auto side = [&](std::int32_t samples) { return (samples - 1) * steps + 1; };
  const std::string unsound =
      testing::verify_triangulation(fitted.tin, side(field.cols), side(field.rows), testing::Edges::kAny);
  RC_ASSERT(unsound == "");
  const std::string broken = options.vertices_are_free
                                 ? testing::find_broken_bound(field.raster(), fitted, threshold)
                                 : testing::find_broken_bound(field.raster(), fitted.tin, threshold);
  RC_ASSERT(broken == "");
  RC_ASSERT(testing::outside_area2(fitted.tin) == outside * steps * steps);
}

RC_GTEST_PROP(squares, are_the_same_on_any_number_of_threads, ()) {
  const Field field = testing::any_field();
  const auto tin = refined(field, 1);
  RC_PRE(tin.has_value());
  fit::FitOptions options = towards(4, *rc::gen::inRange<std::uint64_t>(1, 400));
  options.threads = 1;
  const auto once = *fit::fit(field.raster(), *refined(field, 1), options);
  options.threads = 3;
  const auto again = *fit::fit(field.raster(), *refined(field, 1), options);
  RC_ASSERT(is_same(once.tin, again.tin));
  RC_ASSERT(once.lattice.heights.size() == again.lattice.heights.size());
  for (std::size_t v = 0; v < once.lattice.heights.size(); ++v)
    RC_ASSERT(std::bit_cast<std::uint32_t>(once.lattice.heights[v]) ==
              std::bit_cast<std::uint32_t>(again.lattice.heights[v]));
}

TEST(squares, patches_keep_the_budget_and_nearly_reach_the_error_of_one) {
  const Field field = hills(300, 240);
  fit::FitOptions options{.threshold = 8, .threads = 2, .min_shape = 0.1, .vertices_are_free = true};
  options.squares = fit::SquareGoal{900, fit::kNoBudget, 6};
  const auto squares = [&](std::int32_t side) {
    options.patch_side = side;
    const auto fitted = *fit::fit(field.raster(), *refined(field, 0.3), options);
    EXPECT_LE(triangles_of(fitted.tin), 900u) << side;
    EXPECT_GE(triangles_of(fitted.tin), 891u) << side;
    return testing::sum_of_squares(field.raster(), fitted);
  };
  EXPECT_LT(squares(100), 1.2 * squares(0));
}

TEST(squares, budgets_of_vertices_are_kept) {
  const Field field = hills(120, 90);
  fit::FitOptions options{.threshold = 8, .threads = 1, .vertices_are_free = true};
  options.squares = fit::SquareGoal{fit::kNoBudget, 150, 3};
  const auto fitted = *fit::fit(field.raster(), *refined(field, 0.3), options);
  EXPECT_LE(fitted.tin.vertex_count(), 150u);
  EXPECT_GE(fitted.tin.vertex_count(), 147u);
}

RC_GTEST_PROP(squares, insertion_leaves_a_sound_patch, ()) {
  const Field field = testing::any_field();
  const auto tin = refined(field, 7.3);
  RC_PRE(tin.has_value());
  const grid::VertexLattice lattice;
  fit::PatchCutter::Scratch scratch;
  std::vector<tin::Vertex> vertices;
  fit::Patch patch = fit::PatchCutter(field.raster(), *tin, lattice, {std::max(field.cols, field.rows), 0}, {}, 1)
                         .cut(0, scratch, vertices);
  RC_PRE(patch.face_count() > 0);
  std::int64_t area = 0;
  const auto area_of = [&](fit::Patch::Id f) {
    const auto& [a, b, c] = patch.face(f).corners;
    return fit::area2(patch.at(a), patch.at(b), patch.at(c));
  };
  for (fit::Patch::Id f = 0; f < patch.face_count(); ++f) area += area_of(f);
  const auto face = *rc::gen::inRange<fit::Patch::Id>(0, static_cast<fit::Patch::Id>(patch.face_count()));
  const auto [a, b, c] = patch.face(face).corners;
  const fit::FitCorner p = patch.at(a), q = patch.at(b), r = patch.at(c);
  const bool is_on_edge = *rc::gen::arbitrary<bool>();
  if (is_on_edge && fit::Patch::is_border(patch.face(face).links[0])) return;
  // Corners are samples: halves and thirds of their distances are (almost) lattice points.
  const fit::FitCorner place = is_on_edge ? fit::FitCorner{(p.x + q.x) / 2, (p.y + q.y) / 2, 1}
                                          : fit::FitCorner{(p.x + q.x + r.x) / 3, (p.y + q.y + r.y) / 3, 1};
  const std::size_t before = patch.face_count();
  const fit::Patch::Id v = is_on_edge ? patch.insert(place, face, 0) : patch.insert(place, face);
  RC_ASSERT(patch.face_count() == before + 2);
  fit::Patch::Star star;
  patch.find_star(v, star);
  RC_ASSERT(star.closed && star.faces.size() == (is_on_edge ? 4u : 3u));
  std::int64_t after = 0;
  for (fit::Patch::Id f = 0; f < patch.face_count(); ++f) {
    RC_ASSERT(area_of(f) > 0);
    after += area_of(f);
    for (unsigned k = 0; k < 3; ++k) {
      const fit::Patch::Link link = patch.face(f).links[k];
      if (!fit::Patch::is_border(link))
        RC_ASSERT(patch.face(fit::Patch::triangle_of(link)).links[fit::Patch::edge_of(link)] == (f << 2 | k));
    }
  }
  RC_ASSERT(after == area);
}

SimplifyOptions within(std::uint64_t triangles, Effort effort, Objective objective) {
  SimplifyOptions options;
  options.goals = {.max_triangles = triangles, .objective = objective};
  options.quality.effort = effort;
  return options;
}

/// Land of very different curvature: a volcano on a plain with low waves.
Field volcano() {
  Field field{200, 150, {}};
  for (int y = 0; y < field.rows; ++y) {
    for (int x = 0; x < field.cols; ++x) {
      const double r = std::hypot(x - 120, y - 70);
      field.samples.push_back(static_cast<float>(300 * std::exp(-r / 15) + 8 * std::sin(0.08 * x) * std::cos(0.06 * y) +
                                                 std::sin(0.3 * r)));
    }
  }
  return field;
}

TEST(squares, fall_by_a_tenth_against_the_mesh_of_the_least_max_error) {
  const Field field = volcano();
  for (const Effort effort : {Effort::kNormal, Effort::kHigh}) {
    const auto max = *simplify(field.view(), within(1000, effort, Objective::kMax));
    const auto rms = *simplify(field.view(), within(max.mesh.triangle_count(), effort, Objective::kRms));
    EXPECT_LE(rms.mesh.triangle_count(), max.mesh.triangle_count());
    EXPECT_LT(rms.measurement.rmse, 0.9 * max.measurement.rmse);
    EXPECT_EQ(rms.stop, StopReason::kMaxTriangles);
    EXPECT_TRUE(rms.measurement.is_sound());
  }
}

TEST(squares, have_a_cap_which_is_that_of_fast_effort_or_the_one_that_was_asked_for) {
  const Field field = hills(200, 150);
  const auto fast = *simplify(field.view(), within(1000, Effort::kFast, Objective::kMax));
  SimplifyOptions options = within(1000, Effort::kHigh, Objective::kRms);
  EXPECT_LE(simplify(field.view(), options)->measurement.max_error, fast.measurement.max_error);
  for (const double share : {0.7, 1.5}) {
    if (testing::kIsSanitized && share > 1) continue;
    options.goals.max_error = share * fast.measurement.max_error;
    const auto made = *simplify(field.view(), options);
    EXPECT_LE(made.measurement.max_error, *options.goals.max_error);
    EXPECT_EQ(made.stop, StopReason::kMaxError);
    EXPECT_GE(made.mesh.triangle_count(), 990u);
  }
  // No mesh within the budget has so small an error: the budget has priority.
  options.goals.max_error = 0.05 * fast.measurement.max_error;
  const auto made = *simplify(field.view(), options);
  EXPECT_LE(made.mesh.triangle_count(), 1000u);
  EXPECT_LE(made.measurement.max_error, fast.measurement.max_error);
  EXPECT_EQ(made.stop, StopReason::kMaxTriangles);
}

}  // namespace
}  // namespace scarp::squares_laws_test
