// Tiles made on demand equal those of the finished set, whatever is cached.
#include "jobs/live_tiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "scarp/tile.h"
#include "scarp/tile_job.h"

namespace scarp::live_tiles_test {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Land on a part of the globe, with voids; none elsewhere.
class Land final : public NodeSource {
 public:
  Result<void> read(const NodeWindow& window, std::span<float> out) const override {
    std::size_t k = 0;
    for (int j = 0; j < window.rows; ++j) {
      for (int i = 0; i < window.cols; ++i) out[k++] = at(window.per_turn, window.col + i, window.row + j);
    }
    return {};
  }

 private:
  static float at(std::int64_t per_turn, std::int64_t col, std::int64_t row) {
    col = ((col % per_turn) + per_turn) % per_turn;
    const double lon = -180 + 360.0 * static_cast<double>(col) / static_cast<double>(per_turn);
    const double lat = 90 - 360.0 * static_cast<double>(row) / static_cast<double>(per_turn);
    if (lon < 10 || lon > 19 || lat < 41 || lat > 47 || (col / 8 + row / 8) % 17 == 0)
      return std::numeric_limits<float>::quiet_NaN();
    return static_cast<float>((col * 37 + row * 91) % 701);
  }
};

class Kept final : public TileSink {
 public:
  explicit Kept(TileEncoder encode) : encode_(std::move(encode)) {}
  Result<Bytes> encode(const TerrainTile& tile) const override { return encode_(tile); }
  Result<void> put(TileId id, std::span<const std::uint8_t> bytes) override {
    files[{id.z, id.x, id.y}].assign(bytes.begin(), bytes.end());
    return {};
  }
  std::map<std::tuple<int, std::uint32_t, std::uint32_t>, Bytes> files;

 private:
  TileEncoder encode_;
};

TileJob make_job() {
  PyramidSettings settings;
  settings.cells = 16;
  settings.max_zoom = 7;
  TileJob job;
  job.plan = *plan_pyramid({{10, 41, 19, 47}, 1000, 0, 700}, settings);
  job.rasters = {{"land", 0, 0}};
  job.mosaics = {1};
  job.facts.name = "land";
  return job;
}

TEST(live_tiles, are_those_of_the_finished_set_for_any_cache_and_several_readers) {
  const Land land;
  TileJob job = make_job();
  Kept free(make_tile_encoder(job.format, job.plan));
  const LevelSummary finest = make_pyramid(job.plan, land, free)->levels.back();
  job.plan.max_tile_bytes = finest.bytes / finest.tiles;
  Kept kept(make_tile_encoder(job.format, job.plan));
  const auto report = make_pyramid(job.plan, land, kept);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_GT(report->levels.back().coarser, 0u);
  EXPECT_LT(report->levels.back().coarser, report->levels.back().tiles);
  std::vector<std::pair<TileId, const Bytes*>> wanted;
  for (const auto& [key, bytes] : kept.files)
    wanted.push_back({{std::get<0>(key), std::get<1>(key), std::get<2>(key)}, &bytes});
  for (const std::uint64_t cache : {0ull, 30'000ull, 100'000'000ull}) {
    const auto live = jobs::LiveTileSet::open(job, land, cache);
    ASSERT_TRUE(live) << live.error().message;
    EXPECT_EQ((*live)->tiles(), report->tiles);
    std::vector<int> wrong(2 * wanted.size());
    parallel_for(wrong.size(), 4, [&](std::size_t k) {
      const auto& [id, bytes] = wanted[k % wanted.size()];
      const auto tile = (*live)->make(id);
      wrong[k] = !tile || (*tile)->bytes != *bytes || (*tile)->bound.has_value() != (id.z >= job.plan.block_level);
    });
    EXPECT_EQ(std::count(wrong.begin(), wrong.end(), 1), 0);
    EXPECT_FALSE((*live)->make({7, 0, 0}));
    EXPECT_FALSE((*live)->make({8, 0, 0}));
    EXPECT_FALSE((*live)->read_file("tileset.json"));
  }
}

TEST(live_tiles, that_are_prepared_are_those_of_the_finished_set_with_its_bounds) {
  const Land land;
  const TileJob job = make_job();
  Kept kept(make_tile_encoder(job.format, job.plan));
  const auto report = make_pyramid(job.plan, land, kept);
  ASSERT_TRUE(report);
  const auto live = jobs::LiveTileSet::open(job, land, 100'000'000);
  ASSERT_TRUE(live);
  // During concurrent requests.
  std::vector<std::size_t> wrong(2);
  parallel_for(2, 2, [&](std::size_t k) {
    if (k == 0) {
      const Result<bool> all = (*live)->prepare(2, [] { return false; });
      wrong[k] = !all || !*all;
      return;
    }
    for (const auto& [key, bytes] : kept.files)
      wrong[k] += (*live)->read_tile({std::get<0>(key), std::get<1>(key), std::get<2>(key)}) != bytes;
  });
  EXPECT_EQ(wrong, std::vector<std::size_t>(2));
  std::vector<double> bounds(job.plan.levels.size());
  for (const auto& [key, bytes] : kept.files) {
    const auto tile = (*live)->make({std::get<0>(key), std::get<1>(key), std::get<2>(key)});
    ASSERT_TRUE(tile && (*tile)->bound);
    EXPECT_EQ((*tile)->bytes, bytes);
    double& largest = bounds[static_cast<std::size_t>(std::get<0>(key))];
    largest = std::max(largest, *(*tile)->bound);
  }
  for (std::size_t z = 0; z < bounds.size(); ++z) EXPECT_EQ(bounds[z], report->levels[z].bound) << z;
}

TEST(live_tiles, are_prepared_as_far_as_there_is_room_and_until_nobody_waits) {
  const Land land;
  const TileJob job = make_job();
  const auto full = jobs::LiveTileSet::open(job, land, 300'000), over = jobs::LiveTileSet::open(job, land, 100'000'000);
  ASSERT_TRUE(full && over);
  const Result<bool> all = (*full)->prepare(1, [] { return false; });
  ASSERT_TRUE(all) << all.error().message;
  EXPECT_FALSE(*all);
  int asked = 0;
  const Result<bool> ended = (*over)->prepare(1, [&] { return ++asked > 3; });
  ASSERT_FALSE(ended);
  EXPECT_EQ(ended.error().kind, ErrorKind::kCancelled);
  for (const auto& set : {std::cref(*full), std::cref(*over)}) EXPECT_FALSE((*set.get()->make({0, 0, 0}))->bound);
}

TEST(live_tiles, layer_json_says_what_there_is_and_nothing_of_errors_that_nobody_knows) {
  const Land land;
  TileJob job = make_job();
  const auto live = jobs::LiveTileSet::open(job, land, 0);
  ASSERT_TRUE(live) << live.error().message;
  const auto bytes = (*live)->read_file("layer.json");
  ASSERT_TRUE(bytes);
  const nlohmann::json layer = nlohmann::json::parse(bytes->begin(), bytes->end());
  EXPECT_EQ(layer.at("available").size(), 8u);
  EXPECT_FALSE(layer.at("scarp").at("levels").at(0).contains("bound"));
  EXPECT_EQ(layer.at("scarp").at("levels").at(7).at("tiles"), (*live)->tiles()[7].size());
  // Another raster is another version, so clients request tiles again.
  job.rasters[0].changed = 1;
  const auto later = jobs::LiveTileSet::open(job, land, 0);
  ASSERT_TRUE(later);
  EXPECT_NE(*(*later)->read_file("layer.json"), *bytes);
}

TEST(live_tiles, too_many_nodes_to_look_at_are_taken_for_heights) {
  const Land land;
  const TileJob job = make_job();
  const auto looked = jobs::LiveTileSet::open(job, land, 0), not_looked = jobs::LiveTileSet::open(job, land, 0, {}, 1);
  ASSERT_TRUE(looked && not_looked);
  EXPECT_GE((*not_looked)->tiles()[7].size(), (*looked)->tiles()[7].size());
  for (const std::uint64_t key : (*not_looked)->tiles()[7])
    EXPECT_TRUE((*not_looked)->make({7, static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32)}));
}

TEST(live_tiles, three_d_tiles_are_refused) {
  const Land land;
  TileJob job = make_job();
  job.format = TileFormat::kGlb;
  const auto live = jobs::LiveTileSet::open(job, land, 0);
  ASSERT_FALSE(live);
  EXPECT_EQ(live.error().kind, ErrorKind::kUsage);
}

}  // namespace
}  // namespace scarp::live_tiles_test
