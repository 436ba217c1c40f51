// Borders between tiles: the bound on the line, and equal vertices in both neighbours.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>

#include "base/int128.h"
#include "laws/tile_meshes.h"
#include "pieces/border_chain.h"
#include "pieces/tiling.h"
#include "refine/tile_domain.h"

namespace scarp::border_laws_test {
namespace {

using testing::Field;
using testing::Relief;

Field any_field(std::int32_t least, std::int32_t largest) {
  return testing::random_field(*rc::gen::arbitrary<std::uint32_t>(), *rc::gen::inRange(least, largest),
                               *rc::gen::inRange(least, largest), testing::kReliefs[*rc::gen::inRange(0, 5)],
                               *rc::gen::element(0.0, 0.0, 0.03, 0.2, 0.6));
}

double any_threshold() { return *rc::gen::element(0.0, 0.25, 1.0, 2.0, 7.3, 1e6); }

std::vector<std::int32_t> chain_of(const Field& field, const pieces::BorderLine& line, double threshold) {
  return *pieces::simplify_border(field.view(), line, threshold);
}

/// Valid corners of a cell; 0 beyond the raster.
int valid_corners_of(const grid::Raster& raster, std::int32_t x, std::int32_t y) {
  if (x < 0 || y < 0 || x + 1 >= raster.cols || y + 1 >= raster.rows) return 0;
  return raster.is_valid({x, y}) + raster.is_valid({x + 1, y}) + raster.is_valid({x, y + 1}) +
         raster.is_valid({x + 1, y + 1});
}

// Heights with 8 bits after the point and thresholds with 10, so that integer arithmetic gives exact sums.
RC_GTEST_PROP(border_chain, keeps_the_bound_on_the_line_exactly, ()) {
  Field field = any_field(3, 200);
  for (float& z : field.samples) z = std::round(z * 256) / 256;
  const double threshold = *rc::gen::element(0.0, 0.25, 1.0, 7.125, 30.0009765625, 1e6);
  const pieces::BorderLine line{0, field.rows / 2, field.cols - 1, false};
  const auto kept = chain_of(field, line, threshold);
  RC_ASSERT(std::is_sorted(kept.begin(), kept.end()));
  RC_ASSERT(std::adjacent_find(kept.begin(), kept.end()) == kept.end());
  if (!kept.empty()) RC_ASSERT(kept.front() > 0 && kept.back() < line.steps);
  std::vector<std::int32_t> places{0};
  places.insert(places.end(), kept.begin(), kept.end());
  places.push_back(line.steps);
  const grid::Raster raster = field.raster();
  const auto scaled = [](double value) { return static_cast<Int128>(std::llround(value * 1024)); };
  for (std::size_t k = 0; k + 1 < places.size(); ++k) {
    const std::int32_t a = places[k], b = places[k + 1];
    for (std::int32_t i = a + 1; i < b; ++i) {
      // Surface: a whole cell next to the line, on either side of the sample.
      bool is_surface = false;
      for (const std::int32_t x : {i - 1, i})
        for (const std::int32_t y : {line.row - 1, line.row})
          is_surface = is_surface || valid_corners_of(raster, x, y) > 2;
      if (!is_surface || !raster.is_valid({i, line.row})) continue;
      RC_ASSERT(raster.is_valid({a, line.row}) && raster.is_valid({b, line.row}));
      const Int128 from = scaled(raster.at({a, line.row})), to = scaled(raster.at({b, line.row}));
      const Int128 error = (b - i) * from + (i - a) * to - (b - a) * scaled(raster.at({i, line.row}));
      const bool is_kept = (error < 0 ? -error : error) <= (b - a) * scaled(threshold);
      RC_ASSERT(is_kept);
    }
  }
}

RC_GTEST_PROP(border_chain, keeps_the_bound_for_any_floats, ()) {
  const Field field = testing::random_field(*rc::gen::arbitrary<std::uint32_t>(), *rc::gen::inRange(2, 300), 3,
                                            *rc::gen::element(Relief::kReal, Relief::kRidges));
  const double threshold = *rc::gen::element(0.0, 1e-6, 0.1, 3.0, 40.0);
  auto places = chain_of(field, {0, 1, field.cols - 1, false}, threshold);
  places.insert(places.begin(), 0);
  places.push_back(field.cols - 1);
  const float* heights = field.raster().row(1);
  for (std::size_t k = 0; k + 1 < places.size(); ++k) {
    const std::int32_t a = places[k], b = places[k + 1];
    for (std::int32_t i = a + 1; i < b; ++i)
      RC_ASSERT(!geom::exceeds_exactly_between(heights[a], heights[b], i - a, b - a, heights[i], threshold));
  }
}

RC_GTEST_PROP(border_chain, columns_are_rows_of_the_transposed_raster, ()) {
  const Field field = any_field(3, 60), turned = transposed(field);
  const double threshold = any_threshold();
  const std::int32_t row = *rc::gen::inRange(0, field.rows), col = *rc::gen::inRange(0, field.cols - 1);
  const std::int32_t steps = *rc::gen::inRange(1, field.cols - col);
  RC_ASSERT(chain_of(field, {col, row, steps, false}, threshold) ==
            chain_of(turned, {row, col, steps, true}, threshold));
}

RC_GTEST_PROP(border_chain, knows_nothing_but_the_cells_beside_the_line, ()) {
  Field field = any_field(5, 60);
  const double threshold = any_threshold();
  const pieces::BorderLine line{1, field.rows / 2, field.cols - 3, false};
  const auto before = chain_of(field, line, threshold);
  for (std::int32_t y = 0; y < field.rows; ++y) {
    for (std::int32_t x = 0; x < field.cols; ++x) {
      const bool is_beside = std::abs(y - line.row) <= 1 && x >= line.col && x <= line.col + line.steps;
      if (!is_beside) field.samples[static_cast<std::size_t>(y * field.cols + x)] = x % 3 == 0 ? NAN : 1e9f;
    }
  }
  RC_ASSERT(chain_of(field, line, threshold) == before);
}

RC_GTEST_PROP(border_chain, reads_a_source_as_it_reads_memory, ()) {
  const Field field = any_field(3, 40);
  class Source final : public SampleSource {
   public:
    explicit Source(const Field& field) : field_(field) {}
    Result<void> read(int col, int row, int cols, int rows, float* out, std::ptrdiff_t stride) const override {
      for (int y = 0; y < rows; ++y) std::copy_n(field_.raster().row(row + y) + col, cols, out + y * stride);
      return {};
    }
    bool is_in_memory() const override { return true; }

   private:
    const Field& field_;
  };
  HeightField view = field.view();
  view.samples = nullptr;
  const Source source(field);
  view.source = &source;
  const pieces::BorderLine line{field.cols / 2, 0, field.rows - 1, true};
  RC_ASSERT(*pieces::simplify_border(view, line, 1) == chain_of(field, line, 1));
}

std::set<std::pair<std::int32_t, std::int32_t>> vertices_on(const tin::TileMesh& mesh, const refine::TileWindow& window,
                                                            const pieces::BorderLine& line) {
  std::set<std::pair<std::int32_t, std::int32_t>> found;
  for (tin::TileMesh::Id t = 0; t < mesh.triangle_count(); ++t) {
    for (const geom::TilePoint p : mesh[t].corners) {
      const std::int32_t x = window.col + geom::tile_x(p), y = window.row + geom::tile_y(p);
      if (line.is_vertical ? x == line.col : y == line.row) found.insert({x, y});
    }
  }
  return found;
}

std::vector<geom::TilePoint> border_of(const Field& field, const refine::TileWindow& window,
                                       const refine::SharedSides& shared, double threshold) {
  std::vector<geom::TilePoint> border;
  for (const pieces::BorderLine& line : pieces::shared_lines(window, shared)) {
    for (const std::int32_t step : chain_of(field, line, threshold))
      border.push_back(geom::tile_point(line.col - window.col + (line.is_vertical ? 0 : step),
                                        line.row - window.row + (line.is_vertical ? step : 0)));
  }
  return border;
}

// The rule about nodata: for any outlines of two tiles, their vertices on the shared side are the chain's.
RC_GTEST_PROP(border_chain, both_tiles_start_with_the_chain_and_the_corners_on_a_shared_side, ()) {
  const Field field = any_field(4, 50);
  const double threshold = any_threshold();
  const std::int32_t cut = *rc::gen::inRange(1, field.cols - 1);
  const refine::TileWindow left{0, 0, cut + 1, field.rows}, right{cut, 0, field.cols - cut, field.rows};
  const pieces::BorderLine line{cut, 0, field.rows - 1, true};
  std::set<std::pair<std::int32_t, std::int32_t>> expected{{cut, 0}, {cut, field.rows - 1}};
  for (const std::int32_t step : chain_of(field, line, threshold)) expected.insert({cut, step});
  for (const auto& [window, shared] : {std::pair{left, refine::SharedSides{false, false, true, false}},
                                       {right, refine::SharedSides{true, false, false, false}}}) {
    refine::Tile tile;
    RC_ASSERT(tile.load(field.view(), window).has_value());
    tin::TileMesh mesh;
    RC_ASSERT(refine::start_tile(tile, border_of(field, window, shared, threshold), mesh).has_value());
    const std::string broken = testing::verify_tile_mesh(mesh, window.cols, window.rows);
    RC_ASSERT(broken == "");
    RC_ASSERT(vertices_on(mesh, window, line) == expected);
  }
}

TEST(border_chain, a_straight_line_keeps_nothing_and_a_peak_itself) {
  Field field{9, 3, std::vector<float>(27, 5)};
  const pieces::BorderLine line{0, 1, 8, false};
  EXPECT_TRUE(chain_of(field, line, 0).empty());
  field.samples[9 + 3] = 6;
  EXPECT_EQ(chain_of(field, line, 0.5), (std::vector<std::int32_t>{2, 3, 4}));
  EXPECT_TRUE(chain_of(field, line, 1).empty());
}

TEST(border_chain, nodata_beside_the_line_keeps_where_its_cells_begin_and_end) {
  Field field{9, 3, std::vector<float>(27, 5)};
  field.samples[4] = NAN;
  EXPECT_EQ(chain_of(field, {0, 1, 8, false}, 1), (std::vector<std::int32_t>{3, 4, 5}));
}

TEST(tiling, tiles_cover_the_raster_and_share_their_sides) {
  for (const auto& [cols, rows] : {std::pair{2, 2}, {3, 900}, {65, 64}, {1000, 777}, {50000, 2}}) {
    for (const std::int32_t side : {1, 8, 16, 31, 64, 512, 2048}) {
      const pieces::Tiling tiling(cols, rows, side);
      for (std::size_t i = 0; i < tiling.count(); ++i) {
        const refine::TileWindow window = tiling.window(i);
        const refine::SharedSides shared = tiling.shared(i);
        const std::size_t column = i % tiling.per_row();
        EXPECT_EQ(shared.left, window.col > 0);
        EXPECT_EQ(shared.top, window.row > 0);
        EXPECT_EQ(shared.right, window.col + window.cols < cols);
        EXPECT_EQ(shared.bottom, window.row + window.rows < rows);
        if (shared.right) {
          EXPECT_EQ(tiling.window(i + 1).col, window.col + window.cols - 1);
        }
        if (shared.bottom) {
          EXPECT_EQ(tiling.window(i + tiling.per_row()).row, window.row + window.rows - 1);
        }
        EXPECT_GE(window.cols, std::min(cols, side / 2 + 1));
        EXPECT_GE(window.rows, std::min(rows, side / 2 + 1));
        EXPECT_LE(std::max(window.cols, window.rows), side + (side + 1) / 2 + 1);
        EXPECT_LT(column, tiling.per_row());
      }
    }
  }
}

}  // namespace
}  // namespace scarp::border_laws_test
