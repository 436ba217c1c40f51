// The tiled engine: pieces form one triangulation, which satisfies the greedy engine's guarantee.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <set>

#include "laws/mesh_laws.h"
#include "laws/tile_meshes.h"
#include "metric/height_metric.h"
#include "pieces/freeze.h"
#include "pieces/release.h"
#include "pieces/tiled.h"
#include "pieces/tiling.h"
#include "scarp/measure.h"
#include "tin/assembly.h"

namespace scarp::tiled_laws_test {
namespace {

using testing::Field;
using testing::is_same;
using testing::Relief;

/// A tile's mesh with the border of its neighbours, and a few inner points.
tin::TilePiece random_piece(std::mt19937& random, const refine::TileWindow& window, const refine::SharedSides& shared,
                            tin::PieceMaker& maker) {
  tin::TileMesh mesh;
  mesh.reset(window.cols, window.rows);
  const auto insert = [&](std::int32_t x, std::int32_t y) { mesh.insert(geom::tile_point(x, y), 0); };
  for (const pieces::BorderLine& line : pieces::shared_lines(window, shared)) {
    for (std::int32_t step = 1; step < line.steps; ++step) {
      const std::int32_t x = line.col + (line.is_vertical ? 0 : step), y = line.row + (line.is_vertical ? step : 0);
      if ((x * 7 + y * 13) % 5 < 2) insert(x - window.col, y - window.row);
    }
  }
  for (int k = 0; k < 30 && window.cols > 2 && window.rows > 2; ++k)
    insert(1 + static_cast<std::int32_t>(random() % static_cast<unsigned>(window.cols - 2)),
           1 + static_cast<std::int32_t>(random() % static_cast<unsigned>(window.rows - 2)));
  return maker.make(mesh, {window.col, window.row}, window.cols, window.rows);
}

bool is_on_a_line(const pieces::Tiling& tiling, Point a, Point b) {
  for (std::size_t i = 0; i < tiling.count(); ++i) {
    const refine::TileWindow window = tiling.window(i);
    if ((a.x == b.x && a.x == window.col && a.x > 0) || (a.y == b.y && a.y == window.row && a.y > 0)) return true;
  }
  return false;
}

/// The seams are the free edges on the tiling's lines between inside triangles, each once.
std::string verify_seams(const tin::Triangulation& tin, const pieces::Tiling& tiling,
                         const std::vector<tin::HalfEdge>& seams) {
  std::set<tin::HalfEdge> named;
  for (const tin::HalfEdge h : seams) {
    if (!named.insert(std::min(h, tin.twin(h))).second) return fmt::format("seam {} is named twice", h);
  }
  for (tin::HalfEdge h = 0; h < 3 * tin.triangle_count(); ++h) {
    const tin::HalfEdge g = tin.twin(h);
    if (g == tin::kNone || g < h) continue;
    const bool is_free = !tin.is_constrained(h) && !tin.is_outside(h / 3) && !tin.is_outside(g / 3);
    const bool is_seam =
        is_free && is_on_a_line(tiling, tin.point(tin.origin(h)), tin.point(tin.origin(tin::Triangulation::next(h))));
    if (is_seam != (named.count(h) != 0)) return fmt::format("half-edge {} is {}a seam", h, is_seam ? "" : "no ");
  }
  return "";
}

RC_GTEST_PROP(assembly, joins_pieces_to_one_sound_triangulation, ()) {
  const auto cols = *rc::gen::inRange(2, 150), rows = *rc::gen::inRange(2, 100);
  const pieces::Tiling tiling(cols, rows, *rc::gen::element(1, 5, 8, 16, 31, 64));
  RC_PRE(tiling.count() < 600u);
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  tin::Assembly assembly(tiling.per_row());
  tin::PieceMaker maker;
  std::size_t triangles = 0;
  for (std::size_t i = 0; i < tiling.count(); ++i) {
    const tin::TilePiece piece = random_piece(random, tiling.window(i), tiling.shared(i), maker);
    triangles += piece.outside.size();
    assembly.append(piece);
    RC_ASSERT(assembly.triangle_count() == triangles);
  }
  std::vector<tin::HalfEdge> seams;
  const tin::Triangulation tin = assembly.finish(seams);
  RC_ASSERT(tin.triangle_count() == triangles);
  const std::string unsound = testing::verify_triangulation(tin, cols, rows, testing::Edges::kAny);
  RC_ASSERT(unsound == "");
  const std::string unsewn = verify_seams(tin, tiling, seams);
  RC_ASSERT(unsewn == "");
}

Field any_field() {
  const auto largest = *rc::gen::element(3, 12, 40, 40, 120);
  const auto cols = *rc::gen::inRange(2, largest * 5 / 3), rows = *rc::gen::inRange(2, largest);
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const int relief = *rc::gen::inRange(0, 6);
  return relief == 5 ? testing::sloping_field(seed, cols, rows)
                     : testing::random_field(seed, cols, rows, testing::kReliefs[relief],
                                             *rc::gen::element(0.0, 0.0, 0.02, 0.1, 0.4));
}

pieces::TiledOptions any_options() {
  pieces::TiledOptions options;
  options.threshold = *rc::gen::element(0.0, 1e-7, 0.5, 1.0, 2.0, 7.3, 30.0, 1e6);
  options.tile_side = *rc::gen::element(0, 8, 16, 31, 64);
  options.threads = 2;
  return options;
}

/// A free edge that is not Delaunay although both triangles of the other diagonal would satisfy the bound; "" if none.
std::string find_needless_edge(const tin::Triangulation& tin, const metric::ErrorMetric& metric) {
  for (tin::HalfEdge h = 0; h < 3 * tin.triangle_count(); ++h) {
    const tin::HalfEdge g = tin.twin(h);
    if (g == tin::kNone || tin.is_constrained(h) || tin.is_outside(h / 3)) continue;
    const auto corner = [&](tin::HalfEdge e) { return tin.point(tin.origin(e)); };
    const Point a = corner(h), b = corner(g), c = corner(tin::Triangulation::previous(h)),
                d = corner(tin::Triangulation::previous(g));
    const auto keeps_bound = [&](const std::array<Point, 3>& corners) {
      return !metric.find_candidate(corners, metric.fit(corners, {}));
    };
    if (geom::in_circle(a, b, c, d) > 0 && keeps_bound({c, d, b}) && keeps_bound({d, c, a}))
      return fmt::format("({}, {}) to ({}, {})", a.x, a.y, b.x, b.y);
  }
  return "";
}

RC_GTEST_PROP(tiled, keeps_the_bound_and_the_domain_with_any_tiles, ()) {
  const Field field = any_field();
  const grid::Raster raster = field.raster();
  const pieces::TiledOptions options = any_options();
  const auto domain = refine::build_domain(raster, 0, grid_frame(field.rows));
  auto made = pieces::refine_tiled(field.view(), options);
  RC_ASSERT(made.has_value() == domain.has_value());
  if (!made) {
    RC_ASSERT(made.error().kind == ErrorKind::kInput);
    return;
  }
  RC_ASSERT(made->has_value());
  pieces::Tiled& tiled = **made;
  tin::Triangulation& tin = tiled.domain.tin;
  const std::string unsound = testing::verify_triangulation(tin, field.cols, field.rows, testing::Edges::kAny);
  RC_ASSERT(unsound == "");
  if (options.tile_side > 0) {
    const std::string unsewn =
        verify_seams(tin, pieces::Tiling(field.cols, field.rows, options.tile_side), tiled.seams);
    RC_ASSERT(unsewn == "");
  }
  RC_ASSERT(testing::outside_area2(tin) == testing::outside_area2(domain->tin));
  RC_ASSERT(tiled.domain.whole == domain->whole);
  const std::string broken = testing::find_broken_bound(raster, tin, options.threshold);
  RC_ASSERT(broken == "");

  const metric::HeightMetric metric(raster, options.threshold);
  pieces::release_seams(tin, metric, std::move(tiled.seams));
  const std::string unsound_after = testing::verify_triangulation(tin, field.cols, field.rows, testing::Edges::kAny);
  RC_ASSERT(unsound_after == "");
  RC_ASSERT(testing::outside_area2(tin) == testing::outside_area2(domain->tin));
  const std::string broken_after = testing::find_broken_bound(raster, tin, options.threshold);
  RC_ASSERT(broken_after == "");
  const std::string needless = find_needless_edge(tin, metric);
  RC_ASSERT(needless == "");

  const auto judged =
      measure(field.view(), pieces::freeze(tin, {pieces::SampleHeights(raster), {}, grid_frame(field.rows), true}));
  RC_ASSERT(judged.has_value());
  RC_ASSERT(judged->uncovered == 0u);
  RC_ASSERT(judged->nodata_cells_covered == 0u);
  RC_ASSERT(judged->is_sound());
  RC_ASSERT(judged->max_error <= options.threshold + 1e-9);
  std::set<tin::Vertex> used;
  for (tin::HalfEdge h = 0; h < 3 * tin.triangle_count(); ++h) {
    if (!tin.is_outside(h / 3)) used.insert(tin.origin(h));
  }
  RC_ASSERT(tin.vertex_count() - used.size() == tiled.domain.unused);
}

RC_GTEST_PROP(tiled, threads_change_nothing, ()) {
  const Field field = any_field();
  pieces::TiledOptions options = any_options();
  options.threads = 1;
  const auto first = pieces::refine_tiled(field.view(), options);
  RC_PRE(first.has_value());
  for (const int threads : {2, 3, 8}) {
    options.threads = threads;
    const auto again = pieces::refine_tiled(field.view(), options);
    RC_ASSERT(again.has_value());
    RC_ASSERT(is_same((*again)->domain.tin, (*first)->domain.tin));
    RC_ASSERT((*again)->seams == (*first)->seams);
    RC_ASSERT((*again)->work.samples_scanned == (*first)->work.samples_scanned);
    RC_ASSERT((*again)->work.passes == (*first)->work.passes);
  }
}

TEST(tiled, the_largest_small_raster_keeps_the_bound_at_every_tile_side) {
  for (const double nodata : {0.0, 0.02}) {
    const Field field = testing::random_field(5, 200, 150, Relief::kRidges, nodata);
    for (const std::int32_t side : {8, 31, 64, 512}) {
      const auto tiled = pieces::refine_tiled(field.view(), {.threshold = 3, .threads = 2, .tile_side = side});
      ASSERT_TRUE(tiled && *tiled);
      EXPECT_EQ(testing::find_broken_bound(field.raster(), (*tiled)->domain.tin, 3), "") << side;
    }
  }
}

TEST(tiled, magnitudes_beyond_float32_products_are_left_to_the_greedy_engine) {
  Field field = testing::random_field(5, 40, 30, Relief::kReal);
  field.samples[444] = 0x1p100f;
  const auto tiled = pieces::refine_tiled(field.view(), {.threshold = 1, .threads = 2, .tile_side = 8});
  ASSERT_TRUE(tiled);
  EXPECT_FALSE(*tiled);
}

TEST(tiled, is_cancelled_by_its_callback_after_any_tile) {
  const Field field = testing::random_field(5, 60, 50, Relief::kReal);
  for (int most = 0; most < 4; ++most) {
    int calls = 0;
    double last = 0;
    pieces::TiledOptions options{.threshold = 1, .threads = 3, .tile_side = 8};
    options.progress = [&](double share, std::uint64_t) {
      EXPECT_GT(share, last);
      last = share;
      return calls++ < most;
    };
    const auto tiled = pieces::refine_tiled(field.view(), options);
    ASSERT_FALSE(tiled);
    EXPECT_EQ(tiled.error().kind, ErrorKind::kCancelled);
    EXPECT_EQ(calls, most + 1);
  }
}

TEST(tiled, a_source_that_fails_is_reported_in_its_own_words) {
  class Broken final : public SampleSource {
   public:
    Result<void> read(int, int row, int, int rows, float* out, std::ptrdiff_t) const override {
      if (row + rows > 40) return fail(ErrorKind::kInput, "the file ends early");
      *out = 0;
      return {};
    }
    bool is_in_memory() const override { return true; }
  };
  HeightField view{nullptr, 60, 50};
  const Broken source;
  view.source = &source;
  const auto tiled = pieces::refine_tiled(view, {.threshold = 1, .threads = 3, .tile_side = 8});
  ASSERT_FALSE(tiled);
  EXPECT_EQ(tiled.error().message, "the file ends early");
}

}  // namespace
}  // namespace scarp::tiled_laws_test
