// Rasters opened within a memory limit: floats, 16-bit codes or the file itself, with the same samples.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <limits>

#include "grid/window.h"
#include "unit/raster_files.h"

namespace scarp {
namespace {

using testing::ScratchFolder;
using testing::write_envi;

constexpr int kWide = 37, kHigh = 23;
constexpr std::uint64_t kSamples = kWide * kHigh;

template <class T>
std::vector<T> some_values(int modulus, int shift) {
  std::vector<T> values;
  for (int k = 0; k < static_cast<int>(kSamples); ++k) values.push_back(static_cast<T>(k * 7919 % modulus + shift));
  return values;
}

std::vector<std::uint32_t> bits_of(const HeightField& field) {
  std::vector<float> samples(kSamples);
  EXPECT_TRUE(grid::read_window(field, 0, 0, kWide, kHigh, samples.data(), kWide));
  // Windows of another shape must give the same samples.
  std::vector<float> window(5 * 8, -1.0f);
  EXPECT_TRUE(grid::read_window(field, 9, 11, 5, 4, window.data(), 8));
  std::vector<std::uint32_t> bits;
  for (const float z : samples) bits.push_back(std::isnan(z) ? 0x7fc00000 : std::bit_cast<std::uint32_t>(z));
  for (std::size_t y = 0; y < 4; ++y) {
    for (std::size_t x = 0; x < 8; ++x) {
      const float z = window[8 * y + x], wanted = x < 5 ? samples[(11 + y) * kWide + 9 + x] : -1.0f;
      EXPECT_TRUE(z == wanted || (std::isnan(z) && std::isnan(wanted)));
    }
  }
  return bits;
}

/// Opens with room for floats, for codes, or for neither; all must equal read_height_field().
void expect_same_samples(const std::string& path, ReadOptions options, bool has_codes) {
  const auto whole = read_height_field(path, options);
  ASSERT_TRUE(whole) << whole.error().message;
  const auto wanted = bits_of(*whole);
  const auto expect_alike = [&](const OwnedHeightField& field) {
    EXPECT_EQ(bits_of(field), wanted);
    EXPECT_EQ(field.sample_rounding, whole->sample_rounding);
    EXPECT_EQ(field.info.warnings, whole->info.warnings);
    ASSERT_TRUE(field.info.has_range);
    EXPECT_EQ(field.info.valid, whole->info.valid);
    EXPECT_EQ(field.info.min, whole->info.min);
    EXPECT_EQ(field.info.max, whole->info.max);
  };
  options.with_range = true;
  options.run.memory.limit = 5 * kSamples;
  auto floats = open_height_field(path, options);
  ASSERT_TRUE(floats) << floats.error().message;
  EXPECT_EQ(floats->source, nullptr);
  expect_alike(*floats);

  options.run.memory.limit = 5 * kSamples / 2;
  auto codes = open_height_field(path, options);
  ASSERT_TRUE(codes) << codes.error().message;
  EXPECT_NE(codes->source, nullptr);
  expect_alike(*codes);
  if (has_codes) {
    // The file is no longer needed.
    const std::string hidden = path + ".hidden";
    std::filesystem::rename(path, hidden);
    expect_alike(*codes);
    std::filesystem::rename(hidden, path);
  }

  options.run.memory.limit = 1;
  auto file = open_height_field(path, options);
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_NE(file->source, nullptr);
  expect_alike(*file);
}

TEST(opened_rasters, of_16_bits_have_the_samples_of_read_ones) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.img");
  write_envi<std::int16_t>(path, kWide, kHigh, some_values<std::int16_t>(40000, -20000),
                           "data ignore value = -19999\n");
  expect_same_samples(path, {}, true);
  expect_same_samples(path, {.nodata = -20000.0}, true);
  expect_same_samples(path, {.nodata = 1e30}, true);
  write_envi<std::uint16_t>(path, kWide, kHigh, some_values<std::uint16_t>(65536, 0), "data ignore value = 0\n");
  expect_same_samples(path, {}, true);
  write_envi<std::uint8_t>(path, kWide, kHigh, some_values<std::uint8_t>(256, 0), "data ignore value = 255\n");
  expect_same_samples(path, {}, true);
}

TEST(opened_rasters, are_filled_as_fill_nodata_does_where_memory_holds_them) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.img");
  auto values = some_values<std::int16_t>(1000, 0);
  for (const std::size_t k : {0u, 1u, 77u, 78u, 300u}) values[k] = -1;
  write_envi<std::int16_t>(path, kWide, kHigh, values, "data ignore value = -1\n");
  auto wanted = read_height_field(path);
  ASSERT_TRUE(wanted);
  EXPECT_EQ(fill_nodata(*wanted, 3), 5u);
  for (const auto& filled :
       {read_height_field(path, {.fill_distance = 3}), open_height_field(path, {.fill_distance = 3})}) {
    ASSERT_TRUE(filled) << filled.error().message;
    EXPECT_EQ(filled->samples, wanted->samples);
  }
  for (const std::uint64_t limit : {5 * kSamples / 2, std::uint64_t{1}}) {
    const auto refused = open_height_field(path, {.run = {.memory = {.limit = limit}}, .fill_distance = 3});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, ErrorKind::kInput);
    EXPECT_NE(refused.error().message.find("needs all samples in memory"), std::string::npos);
  }
}

TEST(opened_rasters, of_other_types_have_the_samples_of_read_ones) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.img");
  auto floats = some_values<float>(1000, -500);
  floats[17] = std::numeric_limits<float>::infinity();
  floats[99] = NAN;
  write_envi<float>(path, kWide, kHigh, floats, "data ignore value = -7\n");
  expect_same_samples(path, {}, false);
  auto doubles = some_values<double>(1000, -500);
  for (double& z : doubles) z += 1.0 / 3;
  write_envi<double>(path, kWide, kHigh, doubles);
  expect_same_samples(path, {}, false);
  write_envi<std::int32_t>(path, kWide, kHigh, some_values<std::int32_t>(100000000, 100000000));
  expect_same_samples(path, {}, false);
}

TEST(opened_rasters, with_scale_and_offset_have_the_samples_of_read_ones) {
  const ScratchFolder folder;
  write_envi<std::int16_t>(folder.file("a.img"), kWide, kHigh, some_values<std::int16_t>(2000, -1000));
  testing::write_vrt(folder.file("a.vrt"), "a.img", kWide, kHigh, "Int16", "",
                     "<NoDataValue>-990</NoDataValue><Offset>12.5</Offset><Scale>0.1</Scale>");
  expect_same_samples(folder.file("a.vrt"), {}, true);
}

TEST(opened_rasters, of_packed_colours_have_the_samples_of_read_ones) {
  const ScratchFolder folder;
  auto values = some_values<std::uint8_t>(251, 0);
  const auto one = values;
  values.insert(values.end(), one.rbegin(), one.rend());
  values.insert(values.end(), one.begin(), one.end());
  write_envi<std::uint8_t>(folder.file("a.img"), kWide, kHigh, values);
  expect_same_samples(folder.file("a.img"), {.decode = Decode::kTerrarium}, false);
  expect_same_samples(folder.file("a.img"), {.decode = Decode::kMapbox}, false);
}

TEST(opened_rasters, that_stay_in_their_file_are_not_read_unless_their_range_is_asked_for) {
  const ScratchFolder folder;
  write_envi<float>(folder.file("a.img"), kWide, kHigh, some_values<float>(1000, 0));
  const auto file = open_height_field(folder.file("a.img"), {.run = {.memory = {.limit = 1}}});
  ASSERT_TRUE(file);
  EXPECT_FALSE(file->info.has_range);
  EXPECT_EQ(file->info.valid, 0u);
}

TEST(opened_rasters, that_are_cut_short_name_file_and_row_when_the_row_is_asked_for) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.tif");
  write_envi<float>(folder.file("a.img"), kWide, kHigh, some_values<float>(1000, 0));
  if (!testing::run("gdal_translate -q -co COMPRESS=DEFLATE -co BLOCKYSIZE=1 " + folder.file("a.img") + " " + path))
    GTEST_SKIP() << "needs gdal_translate";
  const auto file = open_height_field(path, {.run = {.memory = {.limit = 1}}});
  ASSERT_TRUE(file) << file.error().message;
  std::filesystem::resize_file(path, std::filesystem::file_size(path) * 2 / 3);
  const auto cut = open_height_field(path, {.run = {.memory = {.limit = 1}}});
  if (!cut) {  // the driver detected it immediately
    EXPECT_EQ(cut.error().kind, ErrorKind::kInput);
    EXPECT_NE(cut.error().message.find("a.tif"), std::string::npos) << cut.error().message;
    return;
  }
  std::vector<float> samples(kSamples);
  const auto read = grid::read_window(*cut, 0, 0, kWide, kHigh, samples.data(), kWide);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().kind, ErrorKind::kInput);
  EXPECT_TRUE(testing::contains(read.error().message, path)) << read.error().message;
  EXPECT_TRUE(testing::contains(read.error().message, "row ")) << read.error().message;
}

TEST(opened_rasters, of_pgm_are_refused_where_they_do_not_fit_as_a_whole) {
  const ScratchFolder folder;
  testing::write_text(folder.file("a.pgm"), "P2 3 2 9 1 2 3 4 5 6");
  const auto small = open_height_field(folder.file("a.pgm"), {.run = {.memory = {.limit = 10}}});
  ASSERT_FALSE(small);
  EXPECT_EQ(small.error().kind, ErrorKind::kInput);
  EXPECT_TRUE(testing::contains(small.error().message, "a.pgm"));
  EXPECT_TRUE(open_height_field(folder.file("a.pgm"), {.run = {.memory = {.limit = 1000}}}));
}

}  // namespace
}  // namespace scarp
