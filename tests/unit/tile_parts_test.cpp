// Parts of a set whose raster changes while blocks are made.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "scarp/tile.h"
#include "scarp/tile_job.h"

namespace scarp::tile_parts_test {
namespace {

namespace fs = std::filesystem;

/// Waves around the globe; touches a file after some reads.
class ChangingLand final : public NodeSource {
 public:
  ChangingLand(std::string file, int reads) : file_(std::move(file)), reads_(reads) {}

  Result<void> read(const NodeWindow& window, std::span<float> out) const override {
    if (--reads_ == 0) std::ofstream(file_, std::ios::app) << "more";
    std::size_t k = 0;
    for (int j = 0; j < window.rows; ++j) {
      for (int i = 0; i < window.cols; ++i)
        out[k++] = static_cast<float>(std::abs(window.latitude(window.row + j)) * 3);
    }
    return {};
  }

 private:
  std::string file_;
  mutable std::atomic<int> reads_;
};

}  // namespace

TEST(tile_parts, of_a_raster_that_changes_are_not_kept_and_those_before_are) {
  const fs::path folder = fs::temp_directory_path() / ("scarp_parts_" + std::to_string(getpid()));
  fs::create_directories(folder);
  const std::string raster = (folder / "land.tif").string();
  std::ofstream(raster) << "samples";
  const fs::file_time_type time = fs::last_write_time(raster);
  PyramidSettings settings;
  settings.cells = 16;
  settings.max_zoom = 7;
  TileJob job;
  job.plan = *plan_pyramid({{-1, -1, 1, 1}, 1000, 0, 300}, settings);
  job.rasters = {stamp_of(raster)};
  job.mosaics = {1};
  const std::vector<TileId> ids = find_blocks(job.plan);
  const std::size_t blocks = ids.size();
  ASSERT_GE(blocks, 4u);
  const std::string parts = (folder / "parts").string();

  const auto stopped = make_parts(job, ChangingLand(raster, 6), parts, {});
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().kind, ErrorKind::kInput);
  EXPECT_NE(stopped.error().message.find("land.tif has changed"), std::string::npos) << stopped.error().message;
  const auto found = TileParts::open(parts, job);
  ASSERT_TRUE(found);
  const auto kept =
      static_cast<std::size_t>(std::count_if(ids.begin(), ids.end(), [&](TileId id) { return (*found)->has(id); }));
  EXPECT_GT(kept, 0u);
  EXPECT_LT(kept, blocks);

  fs::remove(raster);
  EXPECT_NE(find_changed(job)->find("not there any more"), std::string::npos);
  std::ofstream(raster) << "samples";
  fs::last_write_time(raster, time);
  EXPECT_FALSE(find_changed(job));
  const auto whole = make_parts(job, ChangingLand(raster, -1), parts, {});
  ASSERT_TRUE(whole) << whole.error().message;
  EXPECT_EQ(whole->there, kept);
  EXPECT_EQ(whole->blocks, blocks - kept);
  fs::remove_all(folder);
}

}  // namespace scarp::tile_parts_test
