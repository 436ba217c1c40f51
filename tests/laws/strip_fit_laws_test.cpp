// Laws of efforts with samples read by strips: the guarantee is that of refinement.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "laws/array_source.h"
#include "laws/fields.h"
#include "laws/mesh_laws.h"
#include "laws/tile_meshes.h"
#include "pieces/freeze.h"
#include "pieces/strips.h"
#include "refine/domain.h"
#include "scarp/measure.h"
#include "scarp/simplify.h"

namespace scarp::strip_fit_laws_test {
namespace {

using testing::ArraySource;
using testing::Field;
using testing::Relief;
using testing::with_source;

Field any_field() {
  const auto largest = *rc::gen::element(3, 12, 40, 80);
  const auto cols = *rc::gen::inRange(2, largest * 5 / 3), rows = *rc::gen::inRange(2, largest);
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const int relief = *rc::gen::inRange(0, 6);
  return relief == 5 ? testing::sloping_field(seed, cols, rows)
                     : testing::random_field(seed, cols, rows, testing::kReliefs[relief],
                                             *rc::gen::element(0.0, 0.0, 0.02, 0.1, 0.4));
}

SimplifyOptions any_options() {
  SimplifyOptions options;
  options.goals.max_error = *rc::gen::element(0.0, 1e-7, 0.5, 1.0, 2.0, 7.3, 30.0, 1e6);
  options.quality.effort = *rc::gen::element(Effort::kNormal, Effort::kHigh, Effort::kMax);
  options.quality.vertices = *rc::gen::element(Vertices::kAuto, Vertices::kSamples);
  options.run.threads = *rc::gen::element(1, 2);
  return options;
}

Result<std::optional<pieces::Tiled>> refine_and_fit(const HeightField& field, const SimplifyOptions& options,
                                                    std::int32_t tile_side, pieces::StripTotals& fits) {
  pieces::TiledOptions tiles{
      .threshold = *options.goals.max_error, .threads = options.run.threads, .tile_side = tile_side};
  pieces::work_by_strips(pieces::Recipe(field, options), nullptr, nullptr, *options.goals.max_error, fits, tiles);
  return pieces::refine_tiled(field, tiles);
}

grid::VertexLattice lattice_of(const pieces::Tiled& tiled) {
  return {tiled.steps, tiled.steps > 1 ? tiled.heights : std::vector<float>(), {}};
}

RC_GTEST_PROP(strips, that_are_fitted_keep_the_bound_and_the_domain, ()) {
  const Field field = any_field();
  const SimplifyOptions options = any_options();
  const ArraySource source(field.view());
  const HeightField streamed = with_source(field.view(), source);
  const auto domain = refine::build_domain(field.raster(), 0, grid_frame(field.rows));
  pieces::StripTotals fits;
  const auto made = refine_and_fit(streamed, options, *rc::gen::element(0, 8, 16, 31, 64), fits);
  RC_ASSERT(made.has_value() == domain.has_value());
  if (!made) return;
  RC_ASSERT(made->has_value());
  const pieces::Tiled& tiled = **made;
  const tin::Triangulation& tin = tiled.domain.tin;
  const std::string unsound = testing::verify_triangulation(tin, (field.cols - 1) * tiled.steps + 1,
                                                            (field.rows - 1) * tiled.steps + 1, testing::Edges::kAny);
  RC_ASSERT(unsound == "");
  RC_ASSERT(testing::outside_area2(tin) == tiled.steps * tiled.steps * testing::outside_area2(domain->tin));
  RC_ASSERT(tiled.domain.whole == domain->whole);
  const auto judged = measure(field.view(), pieces::freeze(tin, {pieces::SampleHeights(streamed, tiled.heights),
                                                                 lattice_of(tiled), field.view().frame, false}));
  RC_ASSERT(judged.has_value());
  RC_ASSERT(judged->uncovered == 0u);
  RC_ASSERT(judged->nodata_cells_covered == 0u);
  RC_ASSERT(judged->is_sound());
  RC_ASSERT(judged->max_error <= *options.goals.max_error + 1e-9);
}

RC_GTEST_PROP(strips, are_fitted_alike_by_any_number_of_threads, ()) {
  const Field field = any_field();
  SimplifyOptions options = any_options();
  const ArraySource source(field.view());
  const std::int32_t side = *rc::gen::element(8, 31);
  options.run.threads = 1;
  pieces::StripTotals fits;
  const auto first = refine_and_fit(with_source(field.view(), source), options, side, fits);
  RC_PRE(first.has_value());
  options.run.threads = 3;
  const auto again = refine_and_fit(with_source(field.view(), source), options, side, fits);
  RC_ASSERT(again.has_value());
  const tin::Triangulation &a = (*first)->domain.tin, &b = (*again)->domain.tin;
  RC_ASSERT(a.vertex_count() == b.vertex_count() && a.triangle_count() == b.triangle_count());
  for (tin::Vertex v = 0; v < a.vertex_count(); ++v) RC_ASSERT(a.point(v) == b.point(v));
  for (tin::HalfEdge h = 0; h < 3 * a.triangle_count(); ++h)
    RC_ASSERT(a.origin(h) == b.origin(h) && a.twin(h) == b.twin(h));
  RC_ASSERT((*first)->seams == (*again)->seams);
}

/// Memory for several strips.
SimplifyOptions in_little_memory(const HeightField& field, double max_error, Effort effort) {
  SimplifyOptions options;
  options.goals.max_error = max_error;
  options.quality.effort = effort;
  options.run.memory.limit = 4ull * 4 * 256 * static_cast<std::uint64_t>(field.cols);
  options.run.threads = 1;
  return options;
}

/// Waves of some hundred samples.
Field smooth_field(std::int32_t cols, std::int32_t rows) {
  Field field{cols, rows, {}};
  for (std::int32_t y = 0; y < rows; ++y) {
    for (std::int32_t x = 0; x < cols; ++x)
      field.samples.push_back(static_cast<float>(50 * std::sin(0.05 * x) + 30 * std::cos(0.07 * y + 0.02 * x)));
  }
  return field;
}

TEST(strips, efforts_take_fewer_triangles_than_refinement_at_the_public_door) {
  Field field = smooth_field(900, 1200);
  for (std::size_t i = 400'000; i < 400'100; ++i) field.samples[i] = NAN;
  const ArraySource source(field.view());
  const HeightField streamed = with_source(field.view(), source);
  std::size_t before = SIZE_MAX;
  for (const Effort effort : {Effort::kFast, Effort::kNormal, Effort::kHigh}) {
    const auto result = simplify(streamed, in_little_memory(streamed, 5, effort));
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_EQ(result->effort, effort);
    EXPECT_EQ(result->vertices, effort == Effort::kHigh ? Vertices::kFree : Vertices::kSamples);
    EXPECT_LT(static_cast<double>(result->mesh.triangle_count()), 0.8 * static_cast<double>(before));
    before = result->mesh.triangle_count();
    const Measurement m = *measure(field.view(), result->mesh);
    EXPECT_LE(m.max_error, 5 + 1e-9);
    EXPECT_EQ(m.uncovered, 0u);
    EXPECT_TRUE(m.is_sound());
    EXPECT_EQ(m.max_error, result->measurement.max_error);
  }
}

TEST(strips, that_break_while_they_are_read_end_the_run_with_their_own_error) {
  const Field field = smooth_field(900, 1200);
  const ArraySource source(field.view(), 800);
  const auto result = simplify(with_source(field.view(), source), in_little_memory(field.view(), 5, Effort::kNormal));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message, "row 800 is broken");
}

TEST(strips, are_cancelled_while_they_are_fitted) {
  const Field field = testing::random_field(31, 300, 200, Relief::kRidges);
  const ArraySource source(field.view());
  SimplifyOptions options;
  options.goals.max_error = 4;
  options.quality.effort = Effort::kHigh;
  pieces::StripTotals fits;
  pieces::TiledOptions tiles{.threshold = 4, .threads = 1, .tile_side = 64};
  int calls = 0;
  tiles.progress = [&](double share, std::uint64_t) { return share > 0 || ++calls < 2; };
  pieces::work_by_strips(pieces::Recipe(field.view(), options), nullptr, nullptr, 4, fits, tiles);
  const auto cancelled = pieces::refine_tiled(with_source(field.view(), source), tiles);
  ASSERT_FALSE(cancelled);
  EXPECT_EQ(cancelled.error().kind, ErrorKind::kCancelled);
}

}  // namespace
}  // namespace scarp::strip_fit_laws_test
