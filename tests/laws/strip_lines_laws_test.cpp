// Laws of lines with samples read by strips: chains of edges across all strips, with the guarantee of lines in memory.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "laws/any_field.h"
#include "laws/any_lines.h"
#include "laws/array_source.h"
#include "laws/mesh_laws.h"
#include "lines/field_lines.h"
#include "lines/line_samples.h"
#include "pieces/freeze.h"
#include "pieces/strips.h"
#include "refine/domain.h"
#include "scarp/features.h"
#include "scarp/height_field.h"
#include "scarp/measure.h"
#include "scarp/simplify.h"

namespace scarp {
namespace {

using testing::any_field;
using testing::any_lines;
using testing::ArraySource;
using testing::Field;
using testing::with_source;

/// A field read by windows, and its lines split where strips meet.
struct StripScene {
  Field field = any_field(50);
  ArraySource source{field.view()};
  HeightField streamed = with_source(field.view(), source);
  std::int32_t side = *rc::gen::element(8, 16, 31);
  SimplifyOptions options;

  StripScene() {
    options.goals.max_error = *rc::gen::element(0.0, 0.5, 1.0, 3.0, 20.0, 1e6);
    options.quality.effort = *rc::gen::element(Effort::kFast, Effort::kNormal, Effort::kHigh);
    options.quality.vertices = *rc::gen::element(Vertices::kAuto, Vertices::kSamples);
    options.features.breaklines = any_lines(field);
    options.run.threads = *rc::gen::element(1, 2);
    if (*rc::gen::arbitrary<bool>()) add_first_lines();
  }
  StripScene(const StripScene&) = delete;
  /// Lines that are inserted before the surface is refined.
  void add_first_lines() {
    auto& lines = options.features.breaklines.lines;
    for (Line& line : lines) {
      if (std::isnan(line.points[0][2]))
        line.kind = *rc::gen::element(LineKind::kBreakline, LineKind::kRidge, LineKind::kKeptRidge);
    }
    const auto cliffs =
        detect_cliffs(streamed, {*rc::gen::element(0.7, 3.0), *options.goals.max_error,
                                 options.features.breaklines.affine, options.features.breaklines.lines});
    RC_ASSERT(cliffs.has_value());
    lines.insert(lines.end(), cliffs->lines.begin(), cliffs->lines.end());
  }
  Result<lines::FieldLines> lines() const {
    return lines::prepare_lines(streamed, options.features.breaklines, {}, *options.goals.max_error / 2, 1,
                                pieces::shared_rows(streamed, side));
  }
  Result<std::optional<pieces::Tiled>> refine(const lines::FieldLines& lines) const {
    pieces::StripTotals fits;
    pieces::TiledOptions tiles{
        .threshold = *options.goals.max_error, .threads = options.run.threads, .tile_side = side};
    pieces::work_by_strips(pieces::Recipe(streamed, options), &lines.graph, nullptr, *options.goals.max_error, fits,
                           tiles);
    return pieces::refine_tiled(lines.apply(streamed), tiles);
  }
};

/// True if the middle of two points lies in the surface or on its outline.
bool is_on_surface(const tin::Triangulation& tin, Point a, Point b) {
  const auto twice = [&](tin::Vertex v) { return Point{2 * tin.point(v).x, 2 * tin.point(v).y}; };
  const Point middle{a.x + b.x, a.y + b.y};
  for (tin::Triangle t = 0; t < tin.triangle_count(); ++t) {
    if (tin.is_outside(t)) continue;
    const Point p = twice(tin.origin(3 * t)), q = twice(tin.origin(3 * t + 1)), r = twice(tin.origin(3 * t + 2));
    if (orient(p, q, middle) >= 0 && orient(q, r, middle) >= 0 && orient(r, p, middle) >= 0) return true;
  }
  return false;
}

/// True if each edge of the graph between vertices of the domain is a chain of edges on the surface, except removable
/// edges.
bool holds_lines(const pieces::Tiled& tiled, const lines::ConstraintGraph& graph, bool with_starts) {
  const tin::Triangulation& tin = tiled.domain.tin;
  std::map<std::pair<std::int32_t, std::int32_t>, tin::Vertex> vertices;
  for (tin::HalfEdge h = 0; h < 3 * tin.triangle_count(); ++h) {
    const tin::Vertex v = tin.origin(h);
    if (!tin.is_outside(h / 3)) vertices[{tin.point(v).x, tin.point(v).y}] = v;
  }
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    if (!with_starts && !graph.is_start.empty() && graph.is_start[i] != 0) continue;
    const auto& [a, b] = graph.edges[i];
    const Point p = graph.points[a], q = graph.points[b];
    if (!vertices.contains({p.x, p.y}) || !vertices.contains({q.x, q.y})) continue;
    const auto along = [&](Point at) {
      return std::int64_t{at.x - p.x} * (q.x - p.x) + std::int64_t{at.y - p.y} * (q.y - p.y);
    };
    std::vector<std::pair<std::int64_t, tin::Vertex>> on;
    for (tin::Vertex v = 0; v < tin.vertex_count(); ++v) {
      const Point at = tin.point(v);
      const std::int64_t beside = std::int64_t{at.x - p.x} * (q.y - p.y) - std::int64_t{at.y - p.y} * (q.x - p.x);
      if (beside == 0 && along(at) >= 0 && along(at) <= along(q)) on.emplace_back(along(at), v);
    }
    std::sort(on.begin(), on.end());
    for (std::size_t k = 0; k + 1 < on.size(); ++k) {
      const auto [from, to] = std::pair(on[k].second, on[k + 1].second);
      const bool is_edge = tin.find_edge(from, to) != tin::kNone || tin.find_edge(to, from) != tin::kNone;
      if (!is_edge && is_on_surface(tin, tin.point(from), tin.point(to))) return false;
    }
  }
  return true;
}

RC_GTEST_PROP(strip_lines, are_chains_of_edges_and_the_bound_holds_against_the_edited_source, ()) {
  const StripScene scene;
  const auto lines = scene.lines();
  RC_PRE(lines.has_value());
  const auto domain = refine::build_domain(scene.field.raster(), 0, grid_frame(scene.field.rows));
  const auto made = scene.refine(*lines);
  RC_ASSERT(made.has_value() == domain.has_value());
  if (!made) return;
  const pieces::Tiled& tiled = **made;
  const tin::Triangulation& tin = tiled.domain.tin;
  RC_ASSERT(tiled.steps == grid::kLatticeSteps);
  const std::string unsound =
      testing::verify_triangulation(tin, (scene.field.cols - 1) * grid::kLatticeSteps + 1,
                                    (scene.field.rows - 1) * grid::kLatticeSteps + 1, testing::Edges::kAny);
  RC_ASSERT(unsound == "");
  RC_ASSERT(holds_lines(tiled, lines->graph, scene.options.quality.effort == Effort::kFast));
  const HeightField edited = lines->apply(scene.streamed);
  const auto judged = measure(
      edited,
      pieces::freeze(
          tin, {pieces::SampleHeights(edited, {}), {tiled.steps, tiled.heights, {}}, scene.field.view().frame, false}));
  RC_ASSERT(judged.has_value());
  RC_ASSERT(judged->uncovered == 0u);
  RC_ASSERT(judged->nodata_cells_covered == 0u);
  RC_ASSERT(judged->is_sound());
  RC_ASSERT(judged->max_error <= *scene.options.goals.max_error + 1e-9);
}

RC_GTEST_PROP(strip_lines, are_inserted_alike_by_any_number_of_threads, ()) {
  StripScene scene;
  const auto lines = scene.lines();
  RC_PRE(lines.has_value());
  scene.options.run.threads = 1;
  const auto first = scene.refine(*lines);
  RC_PRE(first.has_value());
  scene.options.run.threads = 3;
  const auto again = scene.refine(*lines);
  RC_ASSERT(again.has_value());
  const tin::Triangulation &a = (*first)->domain.tin, &b = (*again)->domain.tin;
  RC_ASSERT(a.vertex_count() == b.vertex_count() && a.triangle_count() == b.triangle_count());
  for (tin::Vertex v = 0; v < a.vertex_count(); ++v) RC_ASSERT(a.point(v) == b.point(v));
  for (tin::HalfEdge h = 0; h < 3 * a.triangle_count(); ++h)
    RC_ASSERT(a.origin(h) == b.origin(h) && a.twin(h) == b.twin(h));
  const auto is_same = [](float x, float y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  RC_ASSERT(std::equal((*first)->heights.begin(), (*first)->heights.end(), (*again)->heights.begin(),
                       (*again)->heights.end(), is_same));
}

RC_GTEST_PROP(strip_lines, in_one_strip_are_those_of_a_raster_in_memory, ()) {
  const StripScene scene;
  const auto streamed =
      lines::prepare_lines(scene.streamed, scene.options.features.breaklines, {}, *scene.options.goals.max_error / 2, 1,
                           pieces::shared_rows(scene.streamed, 4096));
  const auto held = lines::prepare_lines(scene.field.view(), scene.options.features.breaklines, {},
                                         *scene.options.goals.max_error / 2, 1);
  RC_ASSERT(streamed.has_value() == held.has_value());
  if (!held) return;
  RC_ASSERT(streamed->inserted == held->inserted);
  // Next to nodata the outline has a vertex at every sample.
  const bool is_whole =
      std::none_of(scene.field.samples.begin(), scene.field.samples.end(), [](float z) { return std::isnan(z); });
  if (!is_whole) return;
  RC_ASSERT(streamed->graph.points == held->graph.points);
  RC_ASSERT(streamed->graph.heights == held->graph.heights);
  RC_ASSERT(streamed->graph.edges == held->graph.edges);
  RC_ASSERT(streamed->graph.is_start == held->graph.is_start);
  RC_ASSERT(streamed->graph.is_inserted_first == held->graph.is_inserted_first);
  RC_ASSERT(streamed->edits.size() == held->edits.size());
  for (std::size_t k = 0; k < held->edits.size(); ++k) {
    const SampleEdit &a = held->edits[k], &b = streamed->edits[k];
    RC_ASSERT(a.col == b.col && a.row == b.row && a.before == b.before && a.after == b.after);
  }
}

TEST(strip_lines, at_the_public_door_change_the_samples_that_hard_lines_pass) {
  Field field{700, 900, {}};
  for (std::int32_t y = 0; y < field.rows; ++y) {
    for (std::int32_t x = 0; x < field.cols; ++x)
      field.samples.push_back(static_cast<float>(50 * std::sin(0.05 * x) + 30 * std::cos(0.07 * y + 0.02 * x)));
  }
  const ArraySource source(field.view());
  const HeightField streamed = with_source(field.view(), source);
  SimplifyOptions options;
  options.goals.max_error = 5;
  options.run.memory.limit = 4ull * 4 * 256 * static_cast<std::uint64_t>(field.cols);
  options.run.threads = 1;
  Line hard, soft;
  hard.points = {{100, 20, 200}, {100, 850, 200}};
  soft.points = {{10.3, 5.5, NAN}, {650.2, 880.7, NAN}};
  options.features.breaklines.lines = {hard, soft};
  for (const Effort effort : {Effort::kFast, Effort::kNormal, Effort::kHigh}) {
    options.quality.effort = effort;
    const auto made = simplify(streamed, options);
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_EQ(made->lines_inserted, 2u);
    EXPECT_EQ(made->edits.size(), 831u);
    EXPECT_LE(made->measurement.max_error, 5 + 1e-9);
    const auto edited = edit_source({std::shared_ptr<const void>(), &source}, made->edits);
    const Measurement seen = *measure(with_source(field.view(), *edited), made->mesh);
    EXPECT_TRUE(seen.is_sound());
    EXPECT_EQ(seen.max_error, made->measurement.max_error);
    EXPECT_GT(measure(field.view(), made->mesh)->max_error, 100);
  }
  options.quality.effort = Effort::kFast;
  options.quality.shape.max_edge = 40;
  const auto shaped = simplify(streamed, options);
  ASSERT_TRUE(shaped) << shaped.error().message;
  EXPECT_LE(shaped->shape->longest_edge, 40);
  EXPECT_LE(shaped->measurement.max_error, 5 + 1e-9);
}

TEST(strip_lines, tell_what_the_source_says) {
  const Field field = testing::random_field(3, 60, 50, testing::Relief::kRidges);
  const ArraySource broken(field.view(), 30);
  SimplifyOptions options;
  options.goals.max_error = 1;
  Line line;
  line.points = {{5, 5, NAN}, {50, 45, NAN}};
  options.features.breaklines.lines = {line};
  EXPECT_EQ(simplify(with_source(field.view(), broken), options).error().message, "row 30 is broken");
}

}  // namespace
}  // namespace scarp
