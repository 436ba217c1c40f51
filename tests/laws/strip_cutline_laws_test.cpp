// Laws of cutlines with samples read by strips: the same remaining surface and bound as in memory.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "grid/sources/cut_source.h"
#include "laws/any_cutlines.h"
#include "laws/any_field.h"
#include "laws/any_lines.h"
#include "laws/array_source.h"
#include "laws/mesh_laws.h"
#include "lines/field_lines.h"
#include "lines/line_samples.h"
#include "pieces/freeze.h"
#include "pieces/strips.h"
#include "scarp/features.h"
#include "scarp/lines.h"
#include "scarp/measure.h"
#include "scarp/simplify.h"

namespace scarp::strip_cutline_laws_test {
namespace {

using testing::any_field;
using testing::ArraySource;
using testing::Draughtsman;
using testing::Field;
using testing::Relief;
using testing::with_source;

/// A field read by windows, and polygons that bound its surface.
struct CutScene {
  Field field;
  ArraySource source{field.view()};
  HeightField streamed = with_source(field.view(), source);
  std::int32_t side = *rc::gen::element(8, 16, 31);
  SimplifyOptions options;
  Draughtsman draughtsman{*rc::gen::arbitrary<std::uint32_t>()};

  explicit CutScene(std::int32_t largest) : CutScene(any_field(largest)) {}
  explicit CutScene(Field any) : field(std::move(any)) {
    options.goals.max_error = *rc::gen::element(0.0, 0.5, 1.0, 3.0, 20.0, 1e6);
    options.quality.effort = *rc::gen::element(Effort::kFast, Effort::kNormal, Effort::kHigh, Effort::kMax);
    options.quality.vertices = *rc::gen::element(Vertices::kAuto, Vertices::kSamples);
    options.run.threads = *rc::gen::element(1, 2);
  }
  CutScene(const CutScene&) = delete;

  void add_lines() {
    options.features.breaklines = testing::any_lines(field);
    options.features.breaklines.affine = options.features.cutline.affine;
  }
  /// Adds a town within a polygon, with walls away from its ring. Returns the number of walls.
  std::uint64_t add_town() {
    constexpr float kBlock = 50;
    const double width = field.cols - 1, height = field.rows - 1;
    Line ring;
    ring.role = LineRole::kOuter;
    ring.polygon = 0;
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}})
      ring.points.push_back({std::clamp(x * width + draughtsman.between(-3, 3), -2.0, width + 2),
                             std::clamp(y * height + draughtsman.between(-3, 3), -2.0, height + 2), NAN});
    ring.points.push_back(ring.points.front());
    options.features.cutline.rings = {ring};
    for (int blocks = draughtsman.below(4) + 1; blocks-- > 0;) {
      const std::int32_t left = 5 + draughtsman.below(field.cols - 10), top = 5 + draughtsman.below(field.rows - 10);
      const std::int32_t right = std::min(left + 2 + draughtsman.below(20), field.cols - 5);
      const std::int32_t bottom = std::min(top + 2 + draughtsman.below(20), field.rows - 5);
      for (std::int32_t y = top; y < bottom; ++y) {
        for (std::int32_t x = left; x < right; ++x)
          field.samples[static_cast<std::size_t>(y) * static_cast<std::size_t>(field.cols) +
                        static_cast<std::size_t>(x)] += kBlock;
      }
    }
    CliffOptions walls{kBlock / 2, *options.goals.max_error, options.features.cutline.affine};
    walls.avoid = options.features.cutline.rings;
    const auto cliffs = *detect_cliffs(streamed, walls);
    options.features.breaklines.affine = options.features.cutline.affine;
    options.features.breaklines.lines = cliffs.lines;
    return cliffs.wall_count;
  }
  Result<lines::FieldLines> lines() const {
    return lines::prepare_lines(streamed, options.features.breaklines, options.features.cutline,
                                *options.goals.max_error / 2, 1, pieces::shared_rows(streamed, side));
  }
  Result<std::optional<pieces::Tiled>> refine(const lines::FieldLines& lines) const {
    pieces::StripTotals fits;
    pieces::TiledOptions tiles{
        .threshold = *options.goals.max_error, .threads = options.run.threads, .tile_side = side};
    pieces::work_by_strips(pieces::Recipe(streamed, options), &lines.graph, nullptr, *options.goals.max_error, fits,
                           tiles);
    const HeightField edited = lines.apply(streamed);
    const grid::CutSource near(*edited.source, lines.graph.cut->rows);
    return pieces::refine_tiled(with_source(edited, near), tiles);
  }
  Mesh mesh(const pieces::Tiled& tiled) const {
    return pieces::freeze(
        tiled.domain.tin,
        {pieces::SampleHeights(streamed, {}), {tiled.steps, tiled.heights, {}}, field.view().frame, false});
  }
};

/// The surface is the part of the polygons with data, sound and within the bound.
void check_cut(CutScene& scene) {
  const auto lines = scene.lines();
  const auto made = lines ? scene.refine(*lines) : tl::unexpected(lines.error());
  if (!made) {
    RC_LOG() << made.error().message;
    RC_ASSERT(made.error().kind == ErrorKind::kInput);
    RC_ASSERT(testing::find_wrong_cover(scene.field, scene.options.features.cutline, {}, scene.draughtsman) == "");
    return;
  }
  const pieces::Tiled& tiled = **made;
  const std::string unsound =
      testing::verify_triangulation(tiled.domain.tin, (scene.field.cols - 1) * grid::kLatticeSteps + 1,
                                    (scene.field.rows - 1) * grid::kLatticeSteps + 1, testing::Edges::kAny);
  RC_ASSERT(unsound == "");
  const Mesh mesh = scene.mesh(tiled);
  const auto triangles = testing::triangles_of(mesh, scene.field.rows);
  RC_ASSERT(testing::find_wrong_cover(scene.field, scene.options.features.cutline, triangles, scene.draughtsman) == "");
  MeasureOptions judge;
  judge.cutline = &scene.options.features.cutline;
  const auto judged = measure(lines->apply(scene.streamed), mesh, judge);
  RC_ASSERT(judged.has_value());
  RC_ASSERT(judged->max_error <= *scene.options.goals.max_error + 1e-9);
  RC_ASSERT(judged->uncovered == 0u);
  RC_ASSERT(judged->nodata_cells_covered == 0u);
  RC_ASSERT(judged->is_sound());
}

RC_GTEST_PROP(strip_cutlines, cover_what_lies_in_the_polygons_and_has_data_within_the_bound_and_nothing_else, ()) {
  CutScene scene(40);
  scene.options.features.cutline =
      *rc::gen::arbitrary<bool>() ? scene.draughtsman.rings(scene.field) : scene.draughtsman.rectangles(scene.field);
  if (*rc::gen::arbitrary<bool>()) scene.add_lines();
  check_cut(scene);
}

RC_GTEST_PROP(strip_cutlines, around_walls_keep_the_bound_and_the_domain_too, ()) {
  CutScene scene(testing::random_field(*rc::gen::arbitrary<std::uint32_t>(), *rc::gen::inRange(20, 60),
                                       *rc::gen::inRange(20, 60), *rc::gen::element(Relief::kFlat, Relief::kRidges),
                                       *rc::gen::element(0.0, 0.0, 0.02)));
  RC_PRE(scene.add_town() > 0u);
  check_cut(scene);
}

RC_GTEST_PROP(strip_cutlines, leave_exactly_the_area_of_the_polygons_that_has_data, ()) {
  CutScene scene(30);
  scene.options.features.cutline = scene.draughtsman.rectangles(scene.field);
  const auto lines = scene.lines();
  const auto made = lines ? scene.refine(*lines) : tl::unexpected(lines.error());
  double area = 0;
  if (made) {
    for (const auto& t : testing::triangles_of(scene.mesh(**made), scene.field.rows)) area += testing::doubled_area(t);
  } else {
    RC_ASSERT(made.error().kind == ErrorKind::kInput);
  }
  RC_ASSERT(area * grid::kLatticeSteps * grid::kLatticeSteps ==
            static_cast<double>(testing::doubled_area(scene.field, scene.options.features.cutline)));
}

RC_GTEST_PROP(strip_cutlines, are_inserted_alike_by_any_number_of_threads, ()) {
  CutScene scene(40);
  scene.options.features.cutline = scene.draughtsman.rings(scene.field);
  scene.options.run.threads = 1;
  const auto lines = scene.lines();
  RC_PRE(lines.has_value());
  const auto first = scene.refine(*lines);
  RC_PRE(first.has_value());
  scene.options.run.threads = 3;
  const auto again = scene.refine(*lines);
  RC_ASSERT(again.has_value());
  const Mesh a = scene.mesh(**first), b = scene.mesh(**again);
  RC_ASSERT(a.positions == b.positions && a.triangles == b.triangles);
}

RC_GTEST_PROP(strip_cutlines, in_one_strip_are_those_of_a_raster_in_memory, ()) {
  CutScene scene(40);
  scene.options.features.cutline = scene.draughtsman.rings(scene.field);
  scene.add_lines();
  scene.side = 4096;
  const auto streamed = scene.lines();
  const auto held = lines::prepare_lines(scene.field.view(), scene.options.features.breaklines,
                                         scene.options.features.cutline, *scene.options.goals.max_error / 2, 1);
  RC_ASSERT(streamed.has_value() || !held.has_value());
  // Next to nodata, the outline has a vertex at every sample.
  const bool is_whole =
      std::none_of(scene.field.samples.begin(), scene.field.samples.end(), [](float z) { return std::isnan(z); });
  RC_PRE(held.has_value() && is_whole);
  RC_ASSERT(streamed->inserted == held->inserted);
  RC_ASSERT(streamed->graph.points == held->graph.points);
  RC_ASSERT(streamed->graph.heights == held->graph.heights);
  RC_ASSERT(streamed->graph.edges == held->graph.edges);
  RC_ASSERT(streamed->graph.cut->walls == held->graph.cut->walls);
  RC_ASSERT(streamed->graph.cut->outline == held->graph.cut->outline);
  RC_ASSERT(streamed->edits.size() == held->edits.size());
}

RC_GTEST_PROP(strip_cutlines, mask_windows_as_they_mask_the_whole, ()) {
  CutScene scene(40);
  scene.options.features.cutline = scene.draughtsman.rings(scene.field);
  const auto held = lines::prepare_lines(scene.field.view(), {}, scene.options.features.cutline, 1, 1);
  RC_PRE(held.has_value());
  const grid::CutSource source(scene.source, held->graph.cut->rows);
  const std::int32_t cols = scene.field.cols, rows = scene.field.rows;
  for (int window = 0; window < 20; ++window) {
    const std::int32_t col = scene.draughtsman.below(cols), row = scene.draughtsman.below(rows);
    const std::int32_t width = 1 + scene.draughtsman.below(cols - col),
                       height = 1 + scene.draughtsman.below(rows - row);
    const std::int32_t stride = width + 3;
    std::vector<float> samples(static_cast<std::size_t>(stride) * static_cast<std::size_t>(height), 0.0F);
    RC_ASSERT(source.read(col, row, width, height, samples.data(), stride).has_value());
    for (std::int32_t y = 0; y < height; ++y) {
      for (std::int32_t x = 0; x < width; ++x) {
        const float here = samples[static_cast<std::size_t>(y * stride + x)];
        const float there = held->samples[static_cast<std::size_t>((row + y) * cols + col + x)];
        RC_ASSERT(here == there || (std::isnan(here) && std::isnan(there)));
      }
      for (std::int32_t x = width; x < stride && y + 1 < height; ++x)
        RC_ASSERT(samples[static_cast<std::size_t>(y * stride + x)] == 0.0F);
    }
  }
}

RC_GTEST_PROP(strip_cutlines, along_cells_leave_the_samples_that_they_leave_in_memory, ()) {
  CutScene scene(40);
  const Cutline cutline = scene.draughtsman.rings(scene.field);
  const std::int32_t cols = scene.field.cols, rows = scene.field.rows;
  OwnedHeightField held, streamed;
  held.cols = streamed.cols = cols;
  held.rows = streamed.rows = rows;
  held.samples = scene.field.samples;
  streamed.source = std::make_shared<ArraySource>(scene.field.view());
  streamed.info.has_range = false;
  const HeightRange range = height_range(held);
  const auto kept = mask_outside(held, cutline), left = mask_outside(streamed, cutline);
  RC_ASSERT(kept.has_value() && left.has_value());
  RC_ASSERT(kept->lost == left->lost && kept->kept == left->kept && kept->has_surface == left->has_surface);
  RC_ASSERT(kept->kept == height_range(held).valid);
  RC_ASSERT(streamed.info.valid == range.valid && streamed.info.min == range.min && streamed.info.max == range.max);
  const std::int32_t col = scene.draughtsman.below(cols), row = scene.draughtsman.below(rows);
  const std::int32_t width = cols - col, height = rows - row;
  std::vector<float> samples(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  RC_ASSERT(streamed.source->read(col, row, width, height, samples.data(), width).has_value());
  for (std::int32_t y = 0; y < height; ++y) {
    for (std::int32_t x = 0; x < width; ++x) {
      const float here = samples[static_cast<std::size_t>(y * width + x)];
      const float there = held.samples[static_cast<std::size_t>((row + y) * cols + col + x)];
      RC_ASSERT(here == there || (std::isnan(here) && std::isnan(there)));
    }
  }
}

TEST(strip_cutlines, say_what_the_source_says) {
  const Field field = testing::random_field(3, 60, 50, testing::Relief::kRidges);
  const ArraySource broken(field.view(), 30);
  SimplifyOptions options;
  options.goals.max_error = 1;
  Line ring;
  ring.role = LineRole::kOuter;
  ring.polygon = 0;
  ring.points = {{5, 5, NAN}, {50, 45, NAN}, {20, 45, NAN}, {5, 5, NAN}};
  options.features.cutline.rings = {ring};
  EXPECT_EQ(simplify(with_source(field.view(), broken), options).error().message, "row 30 is broken");
  OwnedHeightField streamed;
  streamed.cols = field.cols;
  streamed.rows = field.rows;
  streamed.source = std::make_shared<ArraySource>(field.view(), 30);
  EXPECT_EQ(mask_outside(streamed, options.features.cutline).error().message, "row 30 is broken");
  const auto stop = mask_outside(streamed, options.features.cutline, [](const Progress&) { return false; });
  EXPECT_EQ(stop.error().kind, ErrorKind::kCancelled);
}

/// By definition: samples remain in and around cells that the outline crosses or that have a corner in the polygons.
TEST(strip_cutlines, leave_two_samples_beyond_the_polygons) {
  const Field field = testing::random_field(5, 40, 30, testing::Relief::kRidges);
  const ArraySource source(field.view());
  Line ring;
  ring.role = LineRole::kOuter;
  ring.polygon = 0;
  ring.points = {{10.5, 8.5, NAN}, {20.5, 8.5, NAN}, {20.5, 15.5, NAN}, {10.5, 15.5, NAN}, {10.5, 8.5, NAN}};
  const HeightField streamed = with_source(field.view(), source);
  const auto lines = lines::prepare_lines(streamed, {}, {{ring}}, 1, 1, pieces::shared_rows(streamed, 16));
  ASSERT_TRUE(lines) << lines.error().message;
  const grid::CutRows& rows = *lines->graph.cut->rows;
  EXPECT_EQ(rows.side({10, 9}), grid::CutSide::kBeyond);
  EXPECT_EQ(rows.side({11, 9}), grid::CutSide::kWithin);
  const grid::CutSource cut(source, lines->graph.cut->rows);
  std::vector<float> samples(40 * 30);
  ASSERT_TRUE(cut.read(0, 0, 40, 30, samples.data(), 40));
  for (std::int32_t row = 0; row < 30; ++row) {
    for (std::int32_t col = 0; col < 40; ++col) {
      const bool is_near = col >= 9 && col <= 22 && row >= 7 && row <= 17;
      EXPECT_EQ(std::isnan(samples[static_cast<std::size_t>(40 * row + col)]), !is_near) << col << ", " << row;
    }
  }
}

TEST(strip_cutlines, at_the_public_door_leave_the_samples_that_a_raster_in_memory_leaves) {
  Field field{300, 700, {}};
  for (std::int32_t y = 0; y < field.rows; ++y) {
    for (std::int32_t x = 0; x < field.cols; ++x)
      field.samples.push_back(static_cast<float>(50 * std::sin(0.05 * x) + 30 * std::cos(0.07 * y + 0.02 * x)));
  }
  const ArraySource source(field.view());
  const HeightField streamed = with_source(field.view(), source);
  const auto ring_of = [](LineRole role, std::uint32_t polygon, std::vector<std::array<double, 3>> points) {
    Line ring;
    ring.role = role;
    ring.polygon = polygon;
    ring.points = std::move(points);
    ring.points.push_back(ring.points.front());
    return ring;
  };
  SimplifyOptions options;
  options.goals.max_error = 5;
  options.run.memory.limit = 2'200'000;  // strips meet at the rows 233 and 466
  // Along a row shared by tiles, and across one, with a hole.
  options.features.cutline.rings = {
      ring_of(LineRole::kOuter, 0, {{20, 150, 0}, {200, 150, 0}, {200, 233, 0}, {20, 233, 0}}),
      ring_of(LineRole::kOuter, 1, {{30.5, 300, 0}, {290.25, 450.75, 0}, {40, 620, 0}}),
      ring_of(LineRole::kHole, 1, {{80.3, 420, 0}, {120.1, 440.7, 0}, {100.6, 480.2, 0}}),
  };
  for (const Effort effort : {Effort::kFast, Effort::kNormal, Effort::kHigh}) {
    options.quality.effort = effort;
    const auto made = simplify(streamed, options);
    ASSERT_TRUE(made) << made.error().message;
    SimplifyOptions in_memory = options;
    in_memory.run.memory.limit = 0;
    const auto held = simplify(field.view(), in_memory);
    ASSERT_TRUE(held);
    EXPECT_LE(made->measurement.max_error, 5 + 1e-9);
    EXPECT_EQ(made->measurement.samples, held->measurement.samples);
    EXPECT_EQ(made->cut_off, held->cut_off);
    EXPECT_TRUE(made->edits.empty() && held->edits.empty());  // whatever heights the rings have
    EXPECT_EQ(made->measurement.heights.valid, field.samples.size());
  }
  options.quality.shape.min_angle = 20;
  const auto shaped = simplify(streamed, options);
  ASSERT_TRUE(shaped) << shaped.error().message;
  EXPECT_EQ(shaped->measurement.samples + shaped->cut_off, field.samples.size());
  MeasureOptions judge;
  judge.cutline = &options.features.cutline;
  const Measurement m = *measure(streamed, shaped->mesh, judge);
  EXPECT_LE(m.max_error, 5 + 1e-9);
  EXPECT_EQ(m.uncovered, 0u);
  EXPECT_TRUE(m.is_sound());
  options.quality.shape = {};
  options.features.cutline.rings = {ring_of(LineRole::kOuter, 0, {{900, 900, 0}, {950, 900, 0}, {950, 950, 0}})};
  EXPECT_NE(simplify(streamed, options).error().message.find("beside the raster"), std::string::npos);
  for (std::int32_t y = 100; y < 200; ++y) {
    for (std::int32_t x = 0; x < 300; ++x) field.samples[static_cast<std::size_t>(300 * y + x)] = NAN;
  }
  options.features.cutline.rings = {ring_of(LineRole::kOuter, 0, {{20, 110, 0}, {200, 120, 0}, {100, 180, 0}})};
  EXPECT_NE(simplify(streamed, options).error().message.find("no part of the raster's surface"), std::string::npos);
}

}  // namespace
}  // namespace scarp::strip_cutline_laws_test
