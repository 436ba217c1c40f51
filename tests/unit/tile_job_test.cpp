// The settings that make two tile jobs equal, and the inputs of a block.
#include "scarp/tile_job.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "scarp/tile.h"

namespace scarp::tile_job_test {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

/// Hills between 10° and 19° E; none elsewhere. One place may be higher.
class Land final : public NodeSource {
 public:
  explicit Land(double extra = 0) : extra_(extra) {}
  Result<void> read(const NodeWindow& window, std::span<float> out) const override {
    std::size_t k = 0;
    for (int j = 0; j < window.rows; ++j) {
      for (int i = 0; i < window.cols; ++i)
        out[k++] = at(window.longitude(window.col + i), window.latitude(window.row + j));
    }
    return {};
  }

 private:
  float at(double x, double y) const {
    if (x < 10 || x > 19 || y < 41 || y > 47) return kNone;
    const double lump = std::abs(x - 12) < 0.2 && std::abs(y - 45) < 0.2 ? extra_ : 0;
    return static_cast<float>(std::fmod(37 * x + 91 * y, 701) + lump);
  }

  double extra_;
};

TileJob make_job() {
  PyramidSettings settings;
  settings.cells = 16;
  settings.max_zoom = 8;
  TileJob job;
  job.plan = *plan_pyramid({{10, 41, 19, 47}, 1000, 0, 800}, settings);
  job.rasters = {{"/land.tif", 100, 200}};
  job.mosaics = {1};
  job.facts.name = "land";
  return job;
}

TEST(tile_job, holds_a_local_grid_and_its_place) {
  PyramidSettings settings;
  settings.cells = 16;
  settings.has_siblings = true;
  settings.grid = TileGrid::of_raster(300, 129, 82.764156697136983, 30, settings.cells);
  TileJob job = make_job();
  job.format = TileFormat::kGlb;
  job.plan = *plan_pyramid({{0, 0, 299, 128}, 50, 0, 800, 0}, settings);
  job.facts.units = "metre";
  job.facts.plane.emplace();
  job.facts.plane->transform[12] = 6378137.123456789;
  job.facts.plane->crs = "EPSG:32616";
  job.facts.plane->off_height = 0.1;
  job.reading.cell_size = 0.3;
  const auto bytes = encode_tile_job(job);
  const auto back = decode_tile_job(bytes, "plan.json");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->plan.grid.kind, GridKind::kLocal);
  EXPECT_EQ(back->plan.grid.local, job.plan.grid.local);
  EXPECT_EQ(back->facts.plane, job.facts.plane);
  EXPECT_EQ(back->facts.units, "metre");
  EXPECT_EQ(back->reading.cell_size, 0.3);
  EXPECT_EQ(encode_tile_job(*back), bytes);
  // The job's place does not affect tiles.
  TileJob moved = job;
  moved.facts.plane->transform[12] += 1;
  EXPECT_EQ(settings_key_of(moved), settings_key_of(job));
  // A square whose size differs from its levels' is invalid.
  job.plan.grid.local.side *= 2;
  EXPECT_FALSE(decode_tile_job(encode_tile_job(job), "plan.json"));
}

TEST(tile_job, keys_tell_settings_from_sources) {
  const TileJob job = make_job();
  TileJob other = job;
  other.rasters[0].changed = 201;
  other.plan.covered.east = 20;
  other.facts.attribution = "somebody";
  other.parts = "/earlier.parts";
  EXPECT_EQ(settings_key_of(job), settings_key_of(other));
  EXPECT_NE(sources_key_of(job), sources_key_of(other));
  TileJob effort = job;
  effort.plan.effort = Effort::kHigh;
  EXPECT_NE(settings_key_of(job), settings_key_of(effort));
  EXPECT_EQ(sources_key_of(job), sources_key_of(effort));
  // With known content, time and name do not matter.
  TileJob one = job, two = job;
  one.rasters[0].content = two.rasters[0].content = 7;
  two.rasters[0].path = "/copy.tif";
  two.rasters[0].changed = 9;
  EXPECT_EQ(sources_key_of(one), sources_key_of(two));
  two.rasters[0].content = 8;
  EXPECT_NE(sources_key_of(one), sources_key_of(two));
  // Files named by a VRT and the plan's expectations do not matter.
  TileJob more = job;
  more.files = {{"/member.tif", 5, 6}};
  EXPECT_NE(sources_key_of(job), sources_key_of(more));
  more = job;
  more.estimate = TileEstimate{};
  EXPECT_EQ(key_of(job), key_of(more));
}

TEST(tile_job, comes_back_from_its_file) {
  TileJob job = make_job();
  job.rasters[0].content = 0xfedcba9876543210;
  job.files = {{"/member.tif", 5, 6}};
  job.parts = "/earlier.parts";
  job.plan.max_tile_bytes = 12345;
  job.estimate = TileEstimate{1, 2, 3, 4, 5.25, 6, 7};
  const auto back = decode_tile_job(encode_tile_job(job), "plan");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->rasters, job.rasters);
  EXPECT_EQ(back->files, job.files);
  EXPECT_EQ(back->parts, job.parts);
  EXPECT_EQ(back->plan.max_tile_bytes, 12345u);
  ASSERT_TRUE(back->estimate);
  EXPECT_EQ(back->estimate->core_seconds, 5.25);
  EXPECT_EQ(back->estimate->parts, 7u);
  EXPECT_EQ(encode_tile_job(*back), encode_tile_job(job));
}

TEST(tile_job, one_that_follows_another_keeps_its_levels_or_says_why_not) {
  const TileJob earlier = make_job();
  TileJob now = earlier;
  now.plan.levels.back().max_error *= 3;
  now.plan.covered = {5, 41, 19, 47};
  now.rasters[0].changed = 201;
  const auto job = follow_job(earlier, now);
  ASSERT_TRUE(job);
  EXPECT_EQ(settings_key_of(*job), settings_key_of(earlier));
  EXPECT_EQ(job->plan.covered.west, 5);
  EXPECT_EQ(job->rasters, now.rasters);
  // Steps finer than the heights would get by themselves, then finer than those that can hold them.
  now.plan.levels.back().quantum *= 2;
  EXPECT_TRUE(follow_job(earlier, now));
  now.plan.least_quantum = now.plan.levels.back().quantum;
  const auto refused = follow_job(earlier, now);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("make the set anew"), std::string::npos);
}

TEST(tile_job, a_block_hashes_to_the_same_as_long_as_its_nodes_are_the_same) {
  const TileJob job = make_job();
  const Land land, same, other(3);
  class Kept final : public TileSink {
    Result<std::vector<std::uint8_t>> encode(const TerrainTile& tile) const override {
      return encode_quantized_mesh(tile);
    }
    Result<void> put(TileId, std::span<const std::uint8_t>) override { return {}; }
  } kept;
  std::size_t changed = 0, empty = 0;
  const std::vector<TileId> blocks = find_blocks(job.plan);
  for (const TileId block : blocks) {
    const auto hash = hash_block(job.plan, block, land);
    ASSERT_TRUE(hash);
    EXPECT_EQ(*hash, *hash_block(job.plan, block, same, 2));
    const auto made = make_block(job.plan, block, land, kept);
    ASSERT_TRUE(made);
    EXPECT_EQ(made->hash, *hash);
    changed += *hash != *hash_block(job.plan, block, other);
    empty += *hash == 0;
    EXPECT_EQ(*hash == 0, !made->report.has_heights);
  }
  // The lump lies in one block, or is near enough to affect normals of others.
  EXPECT_GE(changed, 1u);
  EXPECT_LE(changed, 4u);
  EXPECT_LT(changed, blocks.size());
  EXPECT_GE(empty, 1u);
}

TEST(tile_job, a_box_leaves_the_blocks_that_it_touches_across_the_antimeridian_too) {
  PyramidSettings settings;
  settings.cells = 16;
  settings.max_zoom = 9;
  const auto width_of = [&](DegreeBox covered, DegreeBox only) {
    settings.only = only;
    const auto plan = plan_pyramid({covered, 1000, 0, 800}, settings);
    return plan ? static_cast<int>(plan->covered.east - plan->covered.west + 0.5) : -1;
  };
  EXPECT_EQ(width_of({10, 41, 19, 47}, {12, 42, 15, 43}), 3);
  EXPECT_EQ(width_of({10, 41, 19, 47}, {0, 42, 15, 43}), 5);
  EXPECT_EQ(width_of({10, 41, 19, 47}, {12, 50, 15, 53}), -1);
  EXPECT_EQ(width_of({10, 41, 19, 47}, {22, 42, 25, 43}), -1);
  EXPECT_EQ(width_of({170, 41, 190, 47}, {-179, 42, -175, 43}), 4);
  EXPECT_EQ(width_of({170, 41, 190, 47}, {175, 42, 184, 43}), 9);
  EXPECT_EQ(width_of({-180, -90, 180, 90}, {175, 42, 184, 43}), 9);
}

}  // namespace
}  // namespace scarp::tile_job_test
