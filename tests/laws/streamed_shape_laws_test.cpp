// Laws of shapes with samples not entirely in memory: bands of a few rows, windows for patches.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <vector>

#include "grid/bands.h"
#include "laws/array_bounds.h"
#include "laws/array_source.h"
#include "laws/fit_meshes.h"
#include "laws/mesh_laws.h"
#include "pieces/freeze.h"
#include "pieces/source_windows.h"
#include "refine/domain.h"
#include "scarp/measure.h"
#include "scarp/simplify.h"
#include "shape/shape_refinement.h"

namespace scarp::streamed_shape_laws_test {
namespace {

using testing::ArrayBounds;
using testing::ArraySource;
using testing::Field;
using testing::kNoBound;
using testing::Relief;
using testing::with_source;

RC_GTEST_PROP(streamed_shapes, samples_are_those_of_the_raster_whether_rows_are_held_or_not, ()) {
  const Field field = testing::any_field();
  const ArraySource source(field.view());
  const HeightField streamed = with_source(field.view(), source);
  grid::Band rows(streamed, field.rows);
  for (int k = 0; k < 5; ++k) {
    const auto first = *rc::gen::inRange(0, field.rows);
    rows.hold(first, *rc::gen::inRange(0, field.rows - first) + 1);
    for (int look = 0; look < 20; ++look) {
      const auto y = *rc::gen::inRange(0, field.rows), x = *rc::gen::inRange(0, field.cols);
      const auto count = *rc::gen::inRange(0, field.cols - x) + 1;
      const float* const found = rows.samples(x, y, count);
      for (std::int32_t i = 0; i < count; ++i) {
        const float sample = field.raster().at({x + i, y});
        RC_ASSERT(found[i] == sample || (std::isnan(found[i]) && std::isnan(sample)));
      }
    }
  }
}

/// A mesh with only the outline's samples, all lattice points with heights.
struct Start {
  tin::Triangulation tin;
  grid::VertexLattice lattice{grid::kLatticeSteps, {}, {}};
};

std::optional<Start> outline_of(const Field& field) {
  auto domain = refine::build_domain(field.raster(), 0, grid_frame(field.rows));
  if (!domain) return std::nullopt;
  Start start{std::move(domain->tin)};
  for (tin::Vertex v = 0; v < start.tin.vertex_count(); ++v)
    start.lattice.heights.push_back(field.raster().at(start.tin.point(v)));
  start.tin.scale(grid::kLatticeSteps);
  return start;
}

RC_GTEST_PROP(streamed_shapes, bands_leave_no_goal_behind, ()) {
  const auto largest = *rc::gen::element(5, 12, 40);
  const Field field = testing::random_field(*rc::gen::arbitrary<std::uint32_t>(), *rc::gen::inRange(2, largest),
                                            *rc::gen::inRange(2, largest), testing::kReliefs[*rc::gen::inRange(0, 5)],
                                            *rc::gen::element(0.0, 0.0, 0.02, 0.1));
  auto start = outline_of(field);
  RC_PRE(start.has_value());
  const ArraySource source(field.view());
  const HeightField streamed = with_source(field.view(), source);
  const Frame frame = grid_frame(field.rows);
  shape::ShapeTask task{{}, frame.affine, *rc::gen::element(0.0, 0.5, 2.0, 20.0, 2000.0)};
  task.goals.min_angle = *rc::gen::element(0.0, 15.0, 20.0);
  if (*rc::gen::arbitrary<bool>()) task.goals.max_edge = *rc::gen::element(0.7, 2.5, 7.0);
  if (*rc::gen::arbitrary<bool>()) task.goals.grade = *rc::gen::element(0.01, 0.1, 0.5);
  task.field = &streamed;
  task.rows_at_once = *rc::gen::element(4, 7, 16);
  std::vector<float> bounds = testing::any_bounds(field.cols, field.rows);
  const ArrayBounds tolerances(bounds, field.cols);
  const metric::SourceBounds by_sample(tolerances, task.threshold, {});
  if (*rc::gen::arbitrary<bool>()) {
    task.source_bounds = &by_sample;
  } else {
    bounds.assign(bounds.size(), kNoBound);
  }
  double share = 0;
  task.progress = [&](double now, std::uint64_t, double) -> Result<void> {
    RC_ASSERT(now >= share && now <= 1);
    share = now;
    return {};
  };
  double least = -1;
  task.foresee = [&](double triangles) -> Result<void> {
    least = triangles;
    return {};
  };
  const auto outside = testing::outside_area2(start->tin);
  const auto work = shape::refine_shapes({nullptr, field.cols, field.rows}, start->tin, start->lattice, task);
  RC_ASSERT(work.has_value());
  RC_ASSERT(testing::verify_triangulation(start->tin, (field.cols - 1) * grid::kLatticeSteps + 1,
                                          (field.rows - 1) * grid::kLatticeSteps + 1, testing::Edges::kAny) == "");
  RC_ASSERT(testing::outside_area2(start->tin) == outside);
  const Mesh mesh = pieces::freeze(start->tin, {pieces::SampleHeights(streamed, {}), start->lattice, frame, false});
  for (float& bound : bounds) bound = bound * 1.000001f + 1e-6f;
  MeasureOptions judge;
  judge.tolerance = bounds;
  const auto judged = measure(field.view(), mesh, judge);
  RC_ASSERT(judged.has_value());
  RC_ASSERT(judged->over_tolerance == 0u);
  RC_ASSERT(judged->max_error <= task.threshold + 1e-9);
  RC_ASSERT(judged->uncovered == 0u);
  RC_ASSERT(judged->is_sound());
  RC_ASSERT(least >= 0 && least <= static_cast<double>(mesh.triangle_count()));
  const ShapeReport shape = shape::report_shapes(mesh, task.goals, {});
  RC_ASSERT(shape.below == 0u);
  if (task.goals.max_edge) RC_ASSERT(shape.longest_edge <= *task.goals.max_edge);
}

RC_GTEST_PROP(streamed_shapes, fitting_by_windows_is_fitting, ()) {
  const Field field = testing::any_field();
  const double threshold = testing::any_threshold();
  auto tin = testing::refined(field, threshold);
  RC_PRE(tin.has_value());
  grid::VertexLattice lattice{grid::kLatticeSteps, {}, {}};
  for (tin::Vertex v = 0; v < tin->vertex_count(); ++v) lattice.heights.push_back(field.raster().at(tin->point(v)));
  tin->scale(grid::kLatticeSteps);
  fit::FitOptions options;
  options.threshold = threshold;
  options.threads = *rc::gen::element(1, 2);
  options.vertices_are_free = true;
  if (*rc::gen::arbitrary<bool>()) options.depth = fit::kHighDepth;
  options.most_side = *rc::gen::element(0, 5, 20);
  options.most_window = *rc::gen::element<std::int64_t>(0, 100, 1000);
  const auto copy = [&] {
    tin::Triangulation::Arrays arrays;
    for (tin::Vertex v = 0; v < tin->vertex_count(); ++v) arrays.points.push_back(tin->point(v));
    for (tin::HalfEdge h = 0; h < 3 * tin->triangle_count(); ++h) {
      arrays.corners.push_back(tin->origin(h));
      arrays.twins.push_back(tin->twin(h));
    }
    for (tin::Triangle t = 0; t < tin->triangle_count(); ++t) {
      std::uint8_t flags = tin->is_outside(t) ? tin::Triangulation::Arrays::kOutside : 0;
      for (unsigned k = 0; k < 3; ++k) flags |= static_cast<std::uint8_t>(tin->is_constrained(3 * t + k) << k);
      arrays.flags.push_back(flags);
    }
    return tin::Triangulation(std::move(arrays));
  };
  std::vector<float> bounds;
  if (*rc::gen::arbitrary<bool>()) {
    bounds = testing::any_bounds(field.cols, field.rows);
    for (float& bound : bounds) bound = std::max(bound, std::nextafter(static_cast<float>(threshold), kNoBound));
  }
  options.bounds = bounds;
  const auto whole = fit::fit(field.raster(), copy(), lattice, options);
  const ArraySource source(field.view());
  const HeightField streamed = with_source(field.view(), source);
  fit::FitOptions by_windows = options;
  by_windows.bounds = {};
  const ArrayBounds tolerances(bounds, field.cols);
  const metric::SourceBounds by_sample(tolerances, HUGE_VAL, {});
  pieces::read_windows(streamed, {}, by_windows, bounds.empty() ? nullptr : &by_sample);
  const auto read = fit::fit({nullptr, field.cols, field.rows}, copy(), lattice, by_windows);
  RC_ASSERT(whole.has_value() && read.has_value());
  RC_ASSERT(testing::is_same(whole->tin, read->tin));
  RC_ASSERT(whole->counts.removed == read->counts.removed);
}

SimplifyOptions in_little_memory(Effort effort) {
  SimplifyOptions options;
  options.goals.max_error = 3;
  options.quality.effort = effort;
  options.run.memory.limit = 3'400'000;
  options.quality.shape.min_angle = 25;
  options.run.threads = 1;
  return options;
}

/// Waves of some hundred samples, with nodata.
Field wavy_field(std::int32_t cols, std::int32_t rows) {
  Field field{cols, rows, {}};
  for (std::int32_t y = 0; y < rows; ++y) {
    for (std::int32_t x = 0; x < cols; ++x)
      field.samples.push_back(static_cast<float>(50 * std::sin(0.05 * x) + 30 * std::cos(0.07 * y + 0.02 * x)));
  }
  for (std::size_t i = 0; i < 60; ++i) field.samples[field.samples.size() / 2 + i] = NAN;
  return field;
}

TEST(streamed_shapes, take_no_more_triangles_than_in_memory_at_the_public_door) {
  const Field field = wavy_field(500, 400);
  const ArraySource source(field.view());
  const HeightField streamed = with_source(field.view(), source);
  for (const Effort effort : {Effort::kFast, Effort::kNormal, Effort::kHigh}) {
    SimplifyOptions options = in_little_memory(effort);
    ASSERT_LT(pieces::rows_at_once(streamed, {options.run.memory.limit, 0, 0}), 300);
    const auto result = simplify(streamed, options);
    ASSERT_TRUE(result) << result.error().message;
    const Measurement judged = *measure(field.view(), result->mesh);
    EXPECT_LE(judged.max_error, 3 + 1e-9);
    EXPECT_EQ(judged.uncovered, 0u);
    EXPECT_TRUE(judged.is_sound());
    EXPECT_EQ(result->shape->below, result->shape->forced);
    options.run.threads = 3;
    const auto again = simplify(streamed, options);
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(result->mesh.positions, again->mesh.positions);
    EXPECT_EQ(result->mesh.triangles, again->mesh.triangles);
    options.run.memory.limit = 0;
    const auto whole = simplify(field.view(), options);
    ASSERT_TRUE(whole) << whole.error().message;
    EXPECT_LT(static_cast<double>(result->mesh.triangle_count()),
              1.1 * static_cast<double>(whole->mesh.triangle_count()));
  }
}

TEST(streamed_shapes, a_source_that_breaks_ends_the_run_with_its_sentence) {
  const Field field = wavy_field(60, 80);
  for (const Effort effort : {Effort::kFast, Effort::kHigh}) {
    const ArraySource source(field.view(), 70);
    SimplifyOptions options = in_little_memory(effort);
    const auto result = simplify(with_source(field.view(), source), options);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().kind, ErrorKind::kInput);
    EXPECT_NE(result.error().message.find("row 70 is broken"), std::string::npos) << result.error().message;
  }
}

TEST(streamed_shapes, what_outgrows_the_memory_is_refused_with_what_would_do) {
  const Field field = wavy_field(300, 300);
  const ArraySource source(field.view());
  SimplifyOptions options = in_little_memory(Effort::kFast);
  const auto refuses = [&](double max_edge, const char* words) {
    options.quality.shape.max_edge = max_edge;
    const auto result = simplify(with_source(field.view(), source), options);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().kind, ErrorKind::kMemory);
    EXPECT_NE(result.error().message.find(words), std::string::npos) << result.error().message;
  };
  refuses(2, "the memory limit is too little: edges so short need at least 51547 triangles");
  refuses(3, "the memory limit is too little: the mesh has");
}

}  // namespace
}  // namespace scarp::streamed_shape_laws_test
