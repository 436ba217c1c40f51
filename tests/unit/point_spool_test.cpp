// Points of LAS files in blocks on disk.
#include "io/points/point_spool.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <tuple>
#include <vector>

#include "scarp/io.h"
#include "scarp/points.h"
#include "unit/las_files.h"
#include "unit/raster_files.h"

namespace scarp::point_spool_test {
namespace {

using testing::Bytes;
using testing::FilePoint;
using testing::LasFile;

using Spot = std::tuple<double, double, double>;

std::vector<Spot> places_of(const PointSet& points) {
  std::vector<Spot> places;
  for (std::size_t i = 0; i < points.size(); ++i) places.emplace_back(points.x[i], points.y[i], points.z[i]);
  return places;
}

/// The places of all blocks, sorted; fails the test for a block of more than `most`.
std::vector<Spot> places_of(const PointBlocks& blocks, std::size_t most) {
  std::vector<Spot> all;
  for (std::size_t i = 0; i < blocks.block_count(); ++i) {
    const auto block = blocks.read(i);
    EXPECT_TRUE(block.has_value());
    EXPECT_LE(block->size(), most);
    const auto places = places_of(*block);
    all.insert(all.end(), places.begin(), places.end());
  }
  std::sort(all.begin(), all.end());
  EXPECT_EQ(all.size(), blocks.size());
  return all;
}

/// Points at random of 40 × 40 places, so that some are duplicates.
std::string write_las(const testing::ScratchFolder& scratch, const std::string& name, std::size_t count) {
  LasFile file;
  std::mt19937 random(3);
  for (std::size_t i = 0; i < count; ++i) {
    FilePoint& of = file.points.emplace_back();
    of.point.x = static_cast<std::int32_t>(random() % 40) * 700;
    of.point.y = static_cast<std::int32_t>(random() % 40) * 900;
    of.point.z = static_cast<std::int32_t>(random() % 5000);
    of.point.number = 2;
  }
  const Bytes bytes = file.las();
  testing::write_text(scratch.file(name), {bytes.begin(), bytes.end()});
  return scratch.file(name);
}

TEST(PointSpool, blocks_have_the_points_that_count_at_each_place) {
  const testing::ScratchFolder scratch;
  const std::vector<std::string> paths{write_las(scratch, "a.las", 3000), write_las(scratch, "b.las", 500)};
  PointSet all = *read_points(paths[0]);
  ASSERT_TRUE(append_points(*read_points(paths[1]), all));
  for (const auto policy : {DuplicatePolicy::kFirst, DuplicatePolicy::kLast, DuplicatePolicy::kHighest}) {
    std::vector<Spot> expected;
    const std::vector<Spot> given = places_of(all);
    for (std::size_t i = 0; i < given.size(); ++i) {
      const double x = std::get<0>(given[i]), y = std::get<1>(given[i]), z = std::get<2>(given[i]);
      const auto same = [&](const Spot& other) { return std::get<0>(other) == x && std::get<1>(other) == y; };
      const auto end = given.begin() + static_cast<std::ptrdiff_t>(i);
      const bool has_before = std::any_of(given.begin(), end, same),
                 has_after = std::any_of(end + 1, given.end(), same);
      const bool is_highest = std::all_of(given.begin(), given.end(),
                                          [&](const Spot& other) { return !same(other) || std::get<2>(other) <= z; });
      if (policy == DuplicatePolicy::kFirst ? !has_before : policy == DuplicatePolicy::kLast ? !has_after : is_highest)
        expected.push_back(given[i]);
    }
    std::sort(expected.begin(), expected.end());
    expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
    for (const std::uint64_t most : {40u, 700u, 100000u}) {
      const auto spooled = spool_points(paths, {}, policy, most);
      ASSERT_TRUE(spooled.has_value()) << spooled.error().message;
      EXPECT_EQ(places_of(*spooled->blocks, most), expected);
      EXPECT_EQ(spooled->duplicates, all.size() - expected.size());
      EXPECT_EQ(spooled->facts.las->points, 3500u);
      const auto [least, most_z] = std::minmax_element(spooled->facts.z.begin(), spooled->facts.z.end());
      const auto by_height = [](const Spot& a, const Spot& b) { return std::get<2>(a) < std::get<2>(b); };
      EXPECT_EQ(*least, std::get<2>(*std::min_element(expected.begin(), expected.end(), by_height)));
      EXPECT_EQ(*most_z, std::get<2>(*std::max_element(expected.begin(), expected.end(), by_height)));
    }
  }
}

TEST(PointSpool, options_of_reading_apply) {
  const testing::ScratchFolder scratch;
  const std::vector<std::string> path{write_las(scratch, "a.las", 2000)};
  const ReadPointsOptions options{.nodata = 12.5, .z_scale = 2, .extent = std::array{0.0, 0.0, 100.0, 100.0}};
  const PointSet read = *read_points(path[0], options);
  const auto spooled = spool_points(path, options, DuplicatePolicy::kFirst, 100);
  ASSERT_TRUE(spooled.has_value()) << spooled.error().message;
  EXPECT_EQ(spooled->blocks->size() + spooled->duplicates, read.size());
  EXPECT_EQ(spooled->facts.outside, read.outside);
  EXPECT_EQ(spooled->facts.without_height, read.without_height);
  EXPECT_EQ(spooled->facts.heights.z_scale, 2);
  const std::vector<Spot> given = places_of(read);
  for (const Spot& place : places_of(*spooled->blocks, 100))
    EXPECT_NE(std::find(given.begin(), given.end(), place), given.end());
}

TEST(PointSpool, degrees_need_a_crs_since_their_middle_is_unknown) {
  const testing::ScratchFolder scratch;
  LasFile file;
  file.scale = {1e-7, 1e-7, 0.01};
  file.records = {testing::geo_keys({{1024, 2}, {2048, 4326}})};
  for (int i = 0; i < 9; ++i) {
    FilePoint& of = file.points.emplace_back();
    of.point.x = 150'000'000 + i % 3 * 1000;
    of.point.y = 500'000'000 + i / 3 * 1000;
    of.point.z = i;
  }
  const Bytes bytes = file.las();
  testing::write_text(scratch.file("a.las"), {bytes.begin(), bytes.end()});
  const std::vector<std::string> paths{scratch.file("a.las")};
  const auto refused = spool_points(paths, {}, DuplicatePolicy::kFirst, 100);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().kind, ErrorKind::kUsage);
  EXPECT_TRUE(testing::contains(refused.error().message, "ask for --crs source")) << refused.error().message;
  for (const char* const crs : {"source", "EPSG:32633"}) {
    const auto spooled = spool_points(paths, {.crs = crs}, DuplicatePolicy::kFirst, 100);
    ASSERT_TRUE(spooled.has_value()) << spooled.error().message;
    const PointSet read = *read_points(paths[0], {.crs = crs});
    std::vector<Spot> expected = places_of(read);
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(places_of(*spooled->blocks, 100), expected);
    EXPECT_EQ(spooled->facts.crs, read.crs);
  }
}

TEST(PointSpool, what_cannot_be_read_in_parts_is_refused) {
  const testing::ScratchFolder scratch;
  testing::write_text(scratch.file("a.csv"), "1,2,3\n4,5,6\n7,9,9\n");
  const auto fault = [](const std::string& path, std::uint64_t most, const ReadPointsOptions& options = {}) {
    const std::vector<std::string> paths{path};
    return spool_points(paths, options, DuplicatePolicy::kFirst, most).error();
  };
  EXPECT_EQ(fault(scratch.file("a.csv"), 100).kind, ErrorKind::kUsage);
  EXPECT_EQ(fault(scratch.file("none.las"), 100).kind, ErrorKind::kUsage);
  const std::string las = write_las(scratch, "a.las", 2000);
  EXPECT_EQ(fault(las, 1).kind, ErrorKind::kMemory);  // many points at one place
  EXPECT_EQ(fault(las, 100, {.choice = {.classes = {9}}}).kind, ErrorKind::kInput);
  EXPECT_EQ(fault(las, 100, {.extent = std::array{-9.0, -9.0, -8.0, -8.0}}).kind, ErrorKind::kInput);
  EXPECT_EQ(fault(las, 100, {.layer = "a"}).kind, ErrorKind::kUsage);
  ReadPointsOptions stopped;
  stopped.progress = [](const Progress&) { return false; };
  EXPECT_EQ(fault(las, 100, stopped).kind, ErrorKind::kCancelled);
}

}  // namespace
}  // namespace scarp::point_spool_test
