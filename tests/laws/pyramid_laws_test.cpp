// Laws of whole pyramids: tiles are the same individually, by blocks, in any order and on any number of threads.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <tuple>
#include <vector>

#include "laws/any_land.h"
#include "laws/sanitized.h"
#include "scarp/tile.h"

namespace scarp::pyramid_laws_test {
namespace {

using namespace testing;  // NOLINT: what the laws of tiles share

/// Tiles in memory.
class Kept final : public TileSink {
 public:
  explicit Kept(const TileGrid& grid = {}) : grid_(grid) {}
  Result<std::vector<std::uint8_t>> encode(const TerrainTile& tile) const override {
    const std::lock_guard lock(mutex_);
    made_[key(tile.id)] = tile;
    return encode_quantized_mesh(tile, {}, grid_);
  }
  Result<void> put(TileId id, std::span<const std::uint8_t> bytes) override {
    order.push_back(key(id));
    files[key(id)].assign(bytes.begin(), bytes.end());
    return {};
  }
  const TerrainTile& tile(TileId id) const { return made_.at(key(id)); }

  using Key = std::tuple<int, std::uint32_t, std::uint32_t>;
  static Key key(TileId id) { return {id.z, id.x, id.y}; }
  std::vector<Key> order;
  std::map<Key, std::vector<std::uint8_t>> files;

 private:
  TileGrid grid_;
  mutable std::mutex mutex_;
  mutable std::map<Key, TerrainTile> made_;
};

struct Made {
  explicit Made(const TileGrid& grid) : kept(grid) {}

  PyramidPlan plan;
  Kept kept;
  PyramidReport report;
};

std::unique_ptr<Made> make_small_pyramid(const AnyLand& land, const DegreeBox& covered, int threads,
                                         const TileGrid& grid = {}, std::uint64_t max_tile_bytes = 0,
                                         std::vector<DegreeLine> lines = {}) {
  SourceFacts source{covered, 1, -1000, 1200};
  PyramidSettings settings;
  settings.cells = 16;
  settings.max_zoom = 7;
  settings.grid = grid;
  settings.max_tile_bytes = max_tile_bytes;
  settings.lines = std::move(lines);
  auto made = std::make_unique<Made>(grid);
  made->plan = *plan_pyramid(source, settings);
  Run run;
  run.threads = threads;
  auto report = make_pyramid(made->plan, land, made->kept, run);
  EXPECT_TRUE(report) << report.error().message;
  if (report) made->report = *report;
  return made;
}

const DegreeBox kIsland{10.3, 34.1, 31.9, 50.2};
const std::vector<DegreeLine> kRivers{{{5, 40}, {14, 41.2}, {16.5, 46}, {40, 48.1}},
                                      {{22.5, 30}, {22.5, 55}},
                                      {{12, 36}, {12.4, 36.3}, {13, 36.1}, {12, 36}}};

TEST(pyramid_laws, a_tile_of_a_pyramid_is_the_one_made_alone_and_threads_change_nothing) {
  const AnyLand land(7, 900, 50, false, kIsland);
  for (const TileGrid& grid : kGrids) {
    if (testing::kIsSanitized && grid.has_even_rows()) continue;
    const auto one = make_small_pyramid(land, kIsland, 1, grid), three = make_small_pyramid(land, kIsland, 3, grid);
    EXPECT_EQ(one->kept.order, three->kept.order);
    EXPECT_EQ(one->kept.files, three->kept.files);
    std::size_t alone = 0;
    for (const auto& [key, bytes] : one->kept.files) {
      const auto [z, x, y] = key;
      if (z < one->plan.block_level) continue;
      const auto tile = make_tile(one->plan, {z, x, y}, land);
      ASSERT_TRUE(tile) << tile.error().message;
      EXPECT_EQ(encode_quantized_mesh(*tile, {}, grid), bytes) << grid.name() << " " << z << "/" << x << "/" << y;
      ++alone;
    }
    EXPECT_GT(alone, grid.has_even_rows() ? 200u : 100u) << grid.name();
  }
}

TEST(pyramid_laws, tiles_within_a_limit_of_bytes_and_with_lines_are_those_made_alone_and_are_counted) {
  constexpr std::uint64_t kLimit = 900;
  const AnyLand land(7, 900, 50, false, kIsland);
  const auto one = make_small_pyramid(land, kIsland, 1, {}, kLimit, kRivers);
  const auto three = make_small_pyramid(land, kIsland, 3, {}, kLimit, kRivers);
  EXPECT_EQ(one->kept.files, three->kept.files);
  const TileEncoder encode = [](const TerrainTile& tile) { return encode_quantized_mesh(tile); };
  std::vector<std::uint64_t> coarser(one->plan.levels.size()), oversized(coarser);
  for (const auto& [key, bytes] : one->kept.files) {
    const auto [z, x, y] = key;
    const auto level = static_cast<std::size_t>(z);
    const auto tile = make_tile(one->plan, {z, x, y}, land, encode);
    ASSERT_TRUE(tile) << tile.error().message;
    EXPECT_EQ(tile->bytes, bytes) << z << "/" << x << "/" << y;
    coarser[level] += tile->tile.max_error > one->plan.levels[level].max_error;
    oversized[level] += bytes.size() > kLimit;
  }
  std::uint64_t all = 0;
  for (std::size_t z = 0; z < coarser.size(); ++z) {
    EXPECT_EQ(one->report.levels[z].coarser, coarser[z]) << z;
    EXPECT_EQ(one->report.levels[z].oversized, oversized[z]) << z;
    all += coarser[z];
  }
  EXPECT_GT(all, 50u);
}

TEST(pyramid_laws, a_tile_above_the_blocks_is_the_same_without_its_proof_and_tiles_are_known_before_they_are_made) {
  for (const auto& [grid, has_voids] : {std::pair{kGrids[0], false}, {kGrids[0], true}, {kGrids[1], true}}) {
    const AnyLand land(21, 900, 50, has_voids, kIsland);
    const auto made = make_small_pyramid(land, kIsland, 2, grid);
    std::size_t above = 0;
    for (const auto& [key, bytes] : made->kept.files) {
      const auto [z, x, y] = key;
      if (z >= made->plan.block_level) continue;
      const auto tile = make_tile(made->plan, {z, x, y}, land);
      ASSERT_TRUE(tile) << tile.error().message;
      EXPECT_TRUE(std::isnan(tile->node_error));
      EXPECT_EQ(encode_quantized_mesh(*tile, {}, grid), bytes) << z << "/" << x << "/" << y;
      ++above;
    }
    EXPECT_GE(above, grid.has_even_rows() ? 6u : 5u);
    const auto tiles = find_tiles(made->plan, &land);
    ASSERT_TRUE(tiles) << tiles.error().message;
    EXPECT_EQ(*tiles, made->report.tiles);
    // Without reading nodes, it finds at least these tiles.
    const auto perhaps = find_tiles(made->plan, nullptr);
    ASSERT_TRUE(perhaps);
    for (std::size_t z = 0; z < tiles->size(); ++z)
      EXPECT_TRUE(std::includes((*perhaps)[z].begin(), (*perhaps)[z].end(), (*tiles)[z].begin(), (*tiles)[z].end()));
  }
}

TEST(pyramid_laws, blocks_made_by_different_processes_in_any_order_make_the_same_pyramid) {
  const AnyLand land(13, 900, 50, true, kIsland);
  const auto whole = make_small_pyramid(land, kIsland, 2);
  const std::vector<TileId> blocks = find_blocks(whole->plan);
  ASSERT_GT(blocks.size(), 3u);
  std::map<Kept::Key, std::vector<std::uint8_t>> files;
  std::vector<BlockReport> reports;
  for (auto block = blocks.rbegin(); block != blocks.rend(); ++block) {
    Kept kept;
    auto made = make_block(whole->plan, *block, land, kept);
    ASSERT_TRUE(made) << made.error().message;
    reports.push_back(std::move(*made));
    files.merge(kept.files);
    EXPECT_TRUE(kept.files.empty()) << "a tile of two blocks";
  }
  Kept top;
  const auto report = finish_pyramid(whole->plan, std::move(reports), top);
  ASSERT_TRUE(report) << report.error().message;
  files.merge(top.files);
  EXPECT_EQ(files, whole->kept.files);
  EXPECT_EQ(report->tiles, whole->report.tiles);
  for (std::size_t z = 0; z < report->levels.size(); ++z) {
    EXPECT_EQ(report->levels[z].bytes, whole->report.levels[z].bytes);
    EXPECT_EQ(report->levels[z].bound, whole->report.levels[z].bound);
  }
}

TEST(pyramid_laws, blocks_follow_a_curve_of_neighbours) {
  SourceFacts source{{-180, -90, 180, 90}, 1, 0, 100};
  PyramidSettings settings;
  settings.max_zoom = 9;
  const PyramidPlan plan = *plan_pyramid(source, settings);
  const std::vector<TileId> blocks = find_blocks(plan);
  ASSERT_EQ(blocks.size(), 2u << (2 * plan.block_level));
  for (std::size_t k = 1; k < blocks.size(); ++k) {
    const std::int64_t right = std::int64_t{blocks[k].x} - blocks[k - 1].x,
                       up = std::int64_t{blocks[k].y} - blocks[k - 1].y;
    EXPECT_EQ(std::abs(right) + std::abs(up), 1) << "at block " << k;
  }
}

TEST(pyramid_laws, every_tile_with_heights_is_there_with_its_ancestors_and_siblings) {
  const AnyLand land(7, 900, 50, false, kIsland);
  const auto made = make_small_pyramid(land, kIsland, 2);
  std::set<Kept::Key> expected;
  for (int z = 0; z <= made->plan.max_zoom(); ++z) {
    for (std::uint32_t y = 0; y < std::uint32_t{1} << z; ++y) {
      for (std::uint32_t x = 0; x < std::uint32_t{2} << z; ++x) {
        const DegreeBox box = TileGrid{}.bounds_of({z, x, y});
        const bool meets = box.west < kIsland.east && box.east > kIsland.west && box.south < kIsland.north &&
                           box.north > kIsland.south;
        if (!meets) continue;
        expected.insert({z, x, y});
        if (z == 0 || z > made->plan.block_level) continue;
        for (const std::uint32_t k : {0u, 1u, 2u, 3u}) expected.insert({z, (x & ~1u) + (k & 1), (y & ~1u) + (k >> 1)});
      }
    }
  }
  expected.insert({0, 0, 0});
  expected.insert({0, 1, 0});
  for (const Kept::Key& key : expected) {
    const auto [z, x, y] = key;
    // A corner of a tile may contain none of its nodes.
    if (made->kept.files.count(key) == 0) {
      const auto tile = make_tile(made->plan, {z, x, y}, land);
      ASSERT_TRUE(tile);
      EXPECT_TRUE(z > made->plan.block_level) << z << "/" << x << "/" << y;
      for (const std::int32_t height : tile->heights) EXPECT_EQ(height, 0);
    }
  }
  for (const auto& [key, bytes] : made->kept.files) EXPECT_TRUE(expected.count(key) > 0);
  std::uint64_t tiles = 0;
  for (const LevelSummary& level : made->report.levels) tiles += level.tiles;
  EXPECT_EQ(tiles, made->kept.files.size());
}

TEST(pyramid_laws, bounds_above_the_blocks_hold_for_all_nodes_below) {
  const AnyLand land(11, 900, 120, true, kIsland);
  for (const TileGrid& grid : kGrids) {
    if (testing::kIsSanitized && grid.has_even_rows()) continue;
    const auto made = make_small_pyramid(land, kIsland, 2, grid);
    ASSERT_EQ(made->plan.block_level, 2);
    for (int z = 0; z < made->plan.block_level; ++z) {
      for (const std::uint64_t id : made->report.tiles[static_cast<std::size_t>(z)]) {
        const TileId tile{z, static_cast<std::uint32_t>(id), static_cast<std::uint32_t>(id >> 32)};
        const TerrainTile& mesh = made->kept.tile(tile);
        const double error = brute_force(decode(mesh, grid), tile, nodes_of(made->plan, z), land, 0, grid);
        EXPECT_LE(error, mesh.node_error) << grid.name() << " " << z << "/" << tile.x << "/" << tile.y;
        EXPECT_GE(error, 0.5 * mesh.node_error) << "the bound says little";
      }
    }
  }
}

void expect_same_edges(const DegreeBox& covered, int least, const TileGrid& grid = {},
                       const std::vector<DegreeLine>& lines = {}) {
  const AnyLand land(11, 900, 120, true, covered);
  const auto made = make_small_pyramid(land, covered, 2, grid, 0, lines);
  int edges = 0;
  for (int z = 0; z <= made->plan.max_zoom(); ++z) {
    const std::uint32_t across = grid.columns(z);
    for (const auto& [key, bytes] : made->kept.files) {
      const auto [level, x, y] = key;
      if (level != z) continue;
      const QuantizedMesh here = *decode_quantized_mesh(bytes, "tile");
      if (const auto east = made->kept.files.find({z, (x + 1) % across, y}); east != made->kept.files.end()) {
        const QuantizedMesh there = *decode_quantized_mesh(east->second, "tile");
        EXPECT_EQ(without_dust(edge_of(here, here.east, here.v)), without_dust(edge_of(there, there.west, there.v)));
        ++edges;
      }
      if (const auto north = made->kept.files.find({z, x, y + 1}); north != made->kept.files.end()) {
        const QuantizedMesh there = *decode_quantized_mesh(north->second, "tile");
        EXPECT_EQ(without_dust(edge_of(here, here.north, here.u)), without_dust(edge_of(there, there.south, there.u)));
        ++edges;
      }
    }
  }
  EXPECT_GT(edges, least);
}

TEST(pyramid_laws, neighbours_in_a_pyramid_decode_to_the_same_edge) {
  if (!testing::kIsSanitized) expect_same_edges(kIsland, 300);
  if (!testing::kIsSanitized) expect_same_edges(kIsland, 100, kGrids[1]);
  expect_same_edges(kIsland, 300, {}, kRivers);
  // Around the antimeridian, up to the end of the grid.
  expect_same_edges({170, 78, 190, 90}, 50, kGrids[1]);
}

TEST(pyramid_laws, land_that_ends_just_before_an_edge_is_seen_by_the_tile_behind_it) {
  expect_same_edges({100, 20, 179.95, 22.45}, 50);
  expect_same_edges({45.05, 44.95, 60, 50}, 50);
}

}  // namespace
}  // namespace scarp::pyramid_laws_test
