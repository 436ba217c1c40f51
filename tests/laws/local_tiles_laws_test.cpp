// Laws of tiles on a plane: samples are nodes, tiles end with the raster, neighbours meet, and bounds hold for the
// bytes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <tuple>
#include <vector>

#include "io/tiles3d.h"
#include "laws/sanitized.h"
#include "scarp/tile.h"

namespace scarp::local_tiles_laws_test {
namespace {

using Key = std::tuple<int, std::uint32_t, std::uint32_t>;
using Bytes = std::vector<std::uint8_t>;

/// Hills with walls and, if requested, holes.
std::vector<float> make_land(int cols, int rows, bool has_holes, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<float> heights;
  const double turn = std::uniform_real_distribution<double>(0.02, 0.2)(random);
  for (int row = 0; row < rows; ++row) {
    for (int col = 0; col < cols; ++col) {
      const double wave = 40 * std::sin(col * turn) * std::cos(row * 0.11) + 0.2 * col;
      const double wall = (col / 37 + row / 23) % 5 == 0 ? 25 : 0;
      const double noise = std::uniform_real_distribution<double>(-0.5, 0.5)(random);
      heights.push_back(static_cast<float>(100 + wave + wall + noise));
      if (has_holes && (col / 20 + row / 31) % 9 == 4) heights.back() = NAN;
    }
  }
  return heights;
}

class Sink final : public TileSink {
 public:
  explicit Sink(const PyramidPlan& plan) : plan_(plan) {}
  Result<Bytes> encode(const TerrainTile& tile) const override {
    return io::encode_tile_glb(io::place_on_earth(tile, plan_));
  }
  Result<void> put(TileId id, std::span<const std::uint8_t> bytes) override {
    tiles[{id.z, id.y, id.x}] = {bytes.begin(), bytes.end()};
    return {};
  }
  std::map<Key, Bytes> tiles;

 private:
  const PyramidPlan& plan_;
};

struct Shape {
  int cols, rows;
  double cell_x, cell_y;
  bool has_holes = false;
  float steepness = 1;
};

class LocalTiles : public ::testing::TestWithParam<Shape> {
 protected:
  void SetUp() override {
    const Shape& shape = GetParam();
    heights_ = make_land(shape.cols, shape.rows, shape.has_holes, 7);
    for (float& height : heights_) height *= shape.steepness;
    field_.samples = heights_.data();
    field_.cols = shape.cols;
    field_.rows = shape.rows;
    nodes_ = make_local_nodes(field_);
    PyramidSettings settings;
    settings.cells = 16;
    settings.has_siblings = true;
    settings.effort = Effort::kFast;
    settings.background = 90;
    settings.max_error = 1;
    settings.grid = TileGrid::of_raster(shape.cols, shape.rows, shape.cell_x, shape.cell_y, settings.cells);
    const SourceFacts facts{{0, 0, shape.cols - 1.0, shape.rows - 1.0},
                            std::sqrt(shape.cell_x * shape.cell_y),
                            0,
                            400 * double{shape.steepness},
                            0};
    auto plan = plan_pyramid(facts, settings);
    ASSERT_TRUE(plan) << plan.error().message;
    plan_ = std::move(*plan);
    Sink sink(plan_);
    auto report = make_pyramid(plan_, *nodes_, sink);
    ASSERT_TRUE(report) << report.error().message;
    report_ = std::move(*report);
    tiles_ = std::move(sink.tiles);
  }

  double sample(int col, int from_south) const {
    const float height =
        heights_[static_cast<std::size_t>(field_.rows - 1 - from_south) * static_cast<std::size_t>(field_.cols) +
                 static_cast<std::size_t>(col)];
    return std::isnan(height) ? plan_.background : double{height};
  }

  std::vector<float> heights_;
  HeightField field_;
  std::unique_ptr<NodeSource> nodes_;
  PyramidPlan plan_;
  PyramidReport report_;
  std::map<Key, Bytes> tiles_;
};

TEST_P(LocalTiles, have_all_samples_within_the_bound_and_end_with_the_raster) {
  const LocalRaster& raster = plan_.grid.local;
  const double west = static_cast<double>(raster.centre_col()), south = static_cast<double>(raster.centre_row());
  std::vector<std::vector<bool>> is_met(plan_.levels.size());
  for (auto& met : is_met) met.resize(heights_.size());
  // Normals are in bytes, so a wall's may lean over.
  const double lean = GetParam().steepness > 1 ? 1.0 / 127 : 0;
  for (const auto& [key, bytes] : tiles_) {
    const auto& [z, y, x] = key;
    const auto level = static_cast<std::size_t>(z);
    const double bound = report_.levels[level].bound + io::lattice_error(plan_, z);
    const auto tile = io::decode_tile_glb(bytes, "tile");
    ASSERT_TRUE(tile) << tile.error().message;
    // At levels above the blocks, the last node may lie up to a coarse cell beyond the raster.
    const DegreeBox box = plan_.grid.bounds_of({z, x, y});
    const double beyond = z < plan_.block_level ? (box.east - box.west) / 256 : 0;
    const auto at = [&](std::uint32_t v) {
      const auto& place = tile->positions[v];
      return std::array<double, 3>{place[0] / raster.cell_x + west, place[1] / raster.cell_y + south, place[2]};
    };
    constexpr double slack = 1e-9;
    for (std::uint32_t v = 0; v < tile->positions.size(); ++v) {
      const auto place = at(v);
      EXPECT_GE(place[0], box.west - slack);
      EXPECT_GE(place[1], box.south - slack);
      EXPECT_LE(place[0], std::min(box.east, field_.cols - 1 + beyond) + slack);
      EXPECT_LE(place[1], std::min(box.north, field_.rows - 1 + beyond) + slack);
      EXPECT_GE(tile->normals[v][2], -lean);
    }
    for (std::size_t k = 0; k < tile->triangles.size(); k += 3) {
      const auto a = at(tile->triangles[k]), b = at(tile->triangles[k + 1]), c = at(tile->triangles[k + 2]);
      const double area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
      ASSERT_GT(area, 0);
      const auto [low_x, high_x] = std::minmax({a[0], b[0], c[0]});
      const auto [low_y, high_y] = std::minmax({a[1], b[1], c[1]});
      for (int row = static_cast<int>(std::ceil(low_y - slack)); row <= std::min(high_y + slack, field_.rows - 1.0);
           ++row) {
        for (int col = static_cast<int>(std::ceil(low_x - slack)); col <= std::min(high_x + slack, field_.cols - 1.0);
             ++col) {
          const double to_b = ((col - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (row - a[1])) / area;
          const double to_c = ((b[0] - a[0]) * (row - a[1]) - (col - a[0]) * (b[1] - a[1])) / area;
          if (std::min({to_b, to_c, 1 - to_b - to_c}) < -1e-9 - slack) continue;
          is_met[level][static_cast<std::size_t>(row) * static_cast<std::size_t>(field_.cols) +
                        static_cast<std::size_t>(col)] = true;
          const double mesh = a[2] + to_b * (b[2] - a[2]) + to_c * (c[2] - a[2]);
          // Non-square cells move with their lattice, so the distance in space counts, not this distance.
          if (raster.cell_x != raster.cell_y) continue;
          EXPECT_LE(std::abs(mesh - sample(col, row)), bound * (1 + 1e-12) + 1e-9);
        }
      }
    }
  }
  for (const auto& met : is_met) EXPECT_EQ(std::count(met.begin(), met.end(), false), 0);
}

TEST_P(LocalTiles, have_one_error_at_nodes_and_at_samples_below_the_blocks) {
  for (std::size_t z = static_cast<std::size_t>(plan_.block_level); z < plan_.levels.size(); ++z) {
    EXPECT_LE(report_.levels[z].node_error, plan_.levels[z].max_error);
    EXPECT_EQ(report_.levels[z].over, 0u);
    EXPECT_EQ(report_.levels[z].bound, report_.levels[z].node_error) << "a plane has no sag";
    if (GetParam().has_holes) continue;
    EXPECT_NEAR(report_.levels[z].source_error, report_.levels[z].node_error, 1e-9);
  }
}

TEST_P(LocalTiles, are_the_same_made_alone_and_with_their_block) {
  const Sink sink(plan_);
  std::uint64_t count = 0;
  for (const auto& [key, bytes] : tiles_) {
    const auto& [z, y, x] = key;
    if (z < plan_.block_level || ++count % 7 != 0) continue;
    const auto tile = make_tile(plan_, {z, x, y}, *nodes_);
    ASSERT_TRUE(tile) << tile.error().message;
    EXPECT_EQ(*sink.encode(*tile), bytes) << z << '/' << x << '/' << y;
  }
  const auto found = find_tiles(plan_, nodes_.get());
  ASSERT_TRUE(found);
  EXPECT_EQ(*found, report_.tiles);
}

TEST_P(LocalTiles, meet_their_neighbours) {
  std::map<Key, io::TileGlb> decoded;
  for (const auto& [key, bytes] : tiles_) decoded[key] = *io::decode_tile_glb(bytes, "tile");
  const auto edge = [](const io::TileGlb& tile, const std::vector<std::uint32_t>& vertices) {
    std::vector<std::array<double, 6>> places;
    for (const std::uint32_t v : vertices) {
      const auto &at = tile.positions[v], &normal = tile.normals[v];
      places.push_back({at[0], at[1], at[2], normal[0], normal[1], normal[2]});
    }
    return places;
  };
  const auto back = [](std::vector<std::uint32_t> vertices) {
    std::reverse(vertices.begin(), vertices.end());
    return vertices;
  };
  for (const auto& [key, tile] : decoded) {
    const auto& [z, y, x] = key;
    if (const auto east = decoded.find({z, y, x + 1}); east != decoded.end()) {
      EXPECT_EQ(edge(tile, tile.east), edge(east->second, back(east->second.west))) << z << '/' << x << '/' << y;
    }
    if (const auto north = decoded.find({z, y + 1, x}); north != decoded.end()) {
      EXPECT_EQ(edge(tile, tile.north), edge(north->second, back(north->second.south))) << z << '/' << x << '/' << y;
    }
  }
}

// One sample more than a power of two, and a few more.
constexpr Shape kOneMore = testing::kIsSanitized ? Shape{129, 65, 1, 1} : Shape{513, 257, 1, 1};
constexpr Shape kFewMore = testing::kIsSanitized ? Shape{131, 73, 2, 2, true} : Shape{515, 290, 2, 2, true};
INSTANTIATE_TEST_SUITE_P(shapes, LocalTiles,
                         ::testing::Values(Shape{2, 2, 1, 1}, Shape{17, 33, 30, 30}, Shape{203, 144, 0.3, 0.3, true},
                                           kOneMore,
                                           Shape{testing::fewer(530), 129, 82.764156697136983, 82.764156697136983},
                                           kFewMore, Shape{90, 200, 10, 14.2}, Shape{70, 60, 1, 1, true, 400}));

TEST(LocalGrid, has_the_tiles_that_the_raster_fills_in_part) {
  const TileGrid grid = TileGrid::of_raster(300, 129, 2, 2, 64);
  EXPECT_EQ(grid.local.side, 512);
  EXPECT_EQ(grid.finest_local(64), 3);
  EXPECT_EQ(grid.roots(), 1u);
  EXPECT_TRUE(grid.has({3, 4, 1}));
  EXPECT_FALSE(grid.has({3, 5, 1})) << "east of the raster";
  EXPECT_FALSE(grid.has({3, 0, 2})) << "the raster ends on its southern border";
  const DegreeBox box = grid.bounds_of({3, 1, 1});
  EXPECT_EQ(box.west, 64);
  EXPECT_EQ(box.north, 128);
  EXPECT_EQ(grid.land_columns(512).last, 299);
  EXPECT_EQ(grid.land_columns(128).last, 75) << "the next node beyond";
  EXPECT_EQ(grid.land_rows(512).first, 512 - 128);
  EXPECT_EQ(grid.tile_width(1, 0), 512);
}

TEST(LocalGrid, has_errors_that_do_not_grow_with_the_relief) {
  PyramidSettings settings;
  settings.grid = TileGrid::of_raster(300, 300, 1, 1, settings.cells);
  const auto plan_for = [&](double low, double high) {
    return plan_pyramid({{0, 0, 299, 299}, 1, low, high, 0}, settings);
  };
  const auto flat = plan_for(0, 9), steep = plan_for(0, 65535), small = plan_for(0, 1e-3);
  ASSERT_TRUE(flat && steep && small);
  for (std::size_t z = 0; z < flat->levels.size(); ++z) {
    EXPECT_EQ(flat->levels[z].max_error, steep->levels[z].max_error);
    EXPECT_LE(steep->levels[z].quantum, steep->levels[z].max_error / 4);
  }
  settings.max_error = 1e-6;
  EXPECT_TRUE(plan_for(0, 1e-3)) << "whose unit is nobody's";
  const auto fine = plan_for(0, 65535);
  ASSERT_FALSE(fine);
  EXPECT_EQ(fine.error().message,
            "a max error of 1e-06 at level 2, the finest, is too fine for heights of 0 to 65535, the background "
            "included: float32 holds them in steps of 0.00390625; give 0.015625 or more");
  settings.max_error = 0.015625;
  EXPECT_TRUE(plan_for(0, 65535)) << "what the sentence names";
}

TEST(LocalGrid, refuses_levels_that_are_not_its_raster_s) {
  PyramidSettings settings;
  settings.grid = TileGrid::of_raster(300, 300, 1, 1, settings.cells);
  settings.max_zoom = 5;
  const auto plan = plan_pyramid({{0, 0, 299, 299}, 1, 0, 9, 0}, settings);
  ASSERT_FALSE(plan);
  EXPECT_NE(plan.error().message.find("the raster's samples"), std::string::npos);
}

}  // namespace
}  // namespace scarp::local_tiles_laws_test
