// Images as channels: every band with colours, nodata and place.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "raster_files.h"
#include "scarp/picture.h"

namespace scarp {
namespace {

using testing::contains;
using testing::run;
using testing::ScratchFolder;

Error channels_error(const std::string& path, const ReadOptions& options = {}, bool all_bands = true) {
  const auto read = read_channels(path, options, all_bands);
  if (read) {
    ADD_FAILURE() << path << " was read";
    return {};
  }
  EXPECT_TRUE(contains(read.error().message, path)) << read.error().message;
  EXPECT_FALSE(contains(read.error().message, "\n")) << read.error().message;
  return read.error();
}

Picture sample_picture(int width, int height) {
  Picture picture{width, height, {}};
  for (int i = 0; i < width * height; ++i) {
    for (const int part : {i % 256, i / 7 % 256, 255 - i % 256}) picture.rgb.push_back(static_cast<std::uint8_t>(part));
  }
  return picture;
}

TEST(Channels, APhotoHasRedGreenAndBlue) {
  const ScratchFolder scratch;
  const Picture picture = sample_picture(40, 30);
  ASSERT_TRUE(write_file(scratch.file("photo.png"), *encode_png(picture)));
  const auto channels = read_channels(scratch.file("photo.png"));
  ASSERT_TRUE(channels) << channels.error().message;
  EXPECT_EQ(channels->cols, 40);
  EXPECT_EQ(channels->rows, 30);
  EXPECT_TRUE(channels->is_8bit);
  EXPECT_TRUE(channels->is_color);
  EXPECT_TRUE(channels->info.warnings.empty());
  EXPECT_EQ(channels->info.valid, 1200u);
  ASSERT_EQ(channels->bands.size(), 3u);
  for (std::size_t i = 0; i < 1200; ++i) {
    for (std::size_t k = 0; k < 3; ++k) ASSERT_EQ(channels->bands[k][i], static_cast<float>(picture.rgb[3 * i + k]));
  }
  ReadOptions green;
  green.band = 2;
  const auto one = read_channels(scratch.file("photo.png"), green, false);
  ASSERT_TRUE(one);
  ASSERT_EQ(one->bands.size(), 1u);
  EXPECT_EQ(one->bands[0], channels->bands[1]);
  EXPECT_FALSE(one->is_color);
  EXPECT_TRUE(one->is_8bit);
}

TEST(Channels, ManyBandsKeepTheirOrderScaleAndNodata) {
  const ScratchFolder scratch;
  constexpr int kBands = 5, kCols = 300, kRows = 900;
  std::vector<std::uint16_t> values;
  for (int i = 0; i < kBands * kCols * kRows; ++i) values.push_back(static_cast<std::uint16_t>((i * 31) % 5003));
  testing::write_envi(scratch.file("bands"), kCols, kRows, values, "data ignore value = 17\n");
  const auto channels = read_channels(scratch.file("bands"));
  ASSERT_TRUE(channels) << channels.error().message;
  ASSERT_EQ(channels->bands.size(), 5u);
  EXPECT_FALSE(channels->is_8bit);
  EXPECT_FALSE(channels->is_color);
  std::uint64_t valid = 0;
  for (std::size_t i = 0; i < kCols * kRows; ++i) {
    bool all = true;
    for (std::size_t k = 0; k < kBands; ++k) {
      const std::uint16_t wanted = values[k * kCols * kRows + i];
      all &= wanted != 17;
      if (wanted == 17) {
        ASSERT_TRUE(std::isnan(channels->bands[k][i]));
      } else {
        ASSERT_EQ(channels->bands[k][i], static_cast<float>(wanted));
      }
    }
    valid += all;
  }
  EXPECT_EQ(channels->info.valid, valid);
  EXPECT_LT(valid, std::uint64_t{kCols * kRows});
  EXPECT_EQ(channels->info.min, 0);
  EXPECT_EQ(channels->info.max, 5002);
}

TEST(Channels, APgmIsOneChannel) {
  const ScratchFolder scratch;
  testing::write_text(scratch.file("grey.pgm"), "P2\n3 2\n255\n1 2 3\n4 5 255\n");
  const auto channels = read_channels(scratch.file("grey.pgm"));
  ASSERT_TRUE(channels) << channels.error().message;
  EXPECT_TRUE(channels->is_8bit);
  ASSERT_EQ(channels->bands.size(), 1u);
  EXPECT_EQ(channels->bands[0], (std::vector<float>{1, 2, 3, 4, 5, 255}));
}

TEST(Channels, PalettesBecomeColours) {
  if (!testing::has_program("gdal_translate")) GTEST_SKIP() << "needs gdal_translate (gdal-bin)";
  const ScratchFolder scratch;
  std::vector<std::uint8_t> numbers;
  for (int i = 0; i < 64; ++i) numbers.push_back(static_cast<std::uint8_t>(i % 4));
  testing::write_envi(scratch.file("numbers"), 8, 8, numbers);
  testing::write_vrt(scratch.file("palette.vrt"), "numbers", 8, 8, "Byte", "",
                     "<ColorInterp>Palette</ColorInterp><ColorTable><Entry c1=\"10\" c2=\"20\" c3=\"30\" c4=\"255\"/>"
                     "<Entry c1=\"255\" c2=\"0\" c3=\"1\" c4=\"255\"/><Entry c1=\"7\" c2=\"8\" c3=\"9\" c4=\"255\"/>"
                     "<Entry c1=\"0\" c2=\"0\" c3=\"0\" c4=\"0\"/></ColorTable>");
  ASSERT_TRUE(run("gdal_translate -q -of PNG " + scratch.file("palette.vrt") + " " + scratch.file("palette.png")));
  for (const char* name : {"palette.vrt", "palette.png"}) {
    const auto channels = read_channels(scratch.file(name));
    ASSERT_TRUE(channels) << channels.error().message;
    ASSERT_EQ(channels->bands.size(), 3u);
    EXPECT_TRUE(channels->is_color);
    EXPECT_TRUE(channels->is_8bit);
    EXPECT_EQ(channels->bands[0][0], 10);
    EXPECT_EQ(channels->bands[1][0], 20);
    EXPECT_EQ(channels->bands[2][0], 30);
    EXPECT_EQ(channels->bands[0][1], 255);
    EXPECT_EQ(channels->bands[2][2], 9);
    EXPECT_TRUE(std::isnan(channels->bands[1][3])) << name;
    EXPECT_EQ(channels->info.valid, 48u);
  }
}

TEST(Channels, WhatCannotBeChannelsIsRefusedWithAWayOut) {
  const ScratchFolder scratch;
  const std::vector<std::uint8_t> values(65 * 4, 3);
  testing::write_envi(scratch.file("many"), 2, 2, values);
  EXPECT_TRUE(contains(channels_error(scratch.file("many")).message, "65 bands"));
  ReadOptions last;
  last.band = 65;
  EXPECT_TRUE(read_channels(scratch.file("many"), last, false));
  last.band = 66;
  EXPECT_TRUE(contains(channels_error(scratch.file("many"), last, false).message, "no band 66"));

  ReadOptions small;
  small.run.memory.limit = 1000;
  EXPECT_TRUE(contains(channels_error(scratch.file("many"), small).message, "65 bands"));
  testing::write_envi(scratch.file("five"), 10, 10, std::vector<std::uint8_t>(500, 1));
  EXPECT_TRUE(contains(channels_error(scratch.file("five"), small).message, "of 5 bands need"));
  small.run.memory.limit = 2500;
  EXPECT_TRUE(read_channels(scratch.file("five"), small));

  ReadOptions packed;
  packed.decode = Decode::kTerrarium;
  channels_error(scratch.file("five"), packed);
  channels_error(scratch.file("missing.png"));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  testing::write_envi(scratch.file("void"), 2, 2, std::vector<float>(8, nan));
  EXPECT_TRUE(contains(channels_error(scratch.file("void")).message, "nodata"));
}

TEST(Channels, TransparencyIsNoChannel) {
  if (!testing::has_program("gdal_translate")) GTEST_SKIP() << "needs gdal_translate (gdal-bin)";
  const ScratchFolder scratch;
  testing::write_envi(scratch.file("four"), 8, 8, std::vector<std::uint8_t>(256, 200));
  ASSERT_TRUE(run("gdal_translate -q -of PNG -colorinterp red,green,blue,alpha " + scratch.file("four") + " " +
                  scratch.file("alpha.png")));
  const Error error = channels_error(scratch.file("alpha.png"));
  EXPECT_TRUE(contains(error.message, "band 4 is transparency")) << error.message;
  EXPECT_TRUE(contains(error.message, "gdal_translate -b")) << error.message;
}

TEST(Channels, RealPhotosAndAerials) {
  const std::string folder = testing::reference_folder();
  if (folder.empty()) GTEST_SKIP() << "the reference rasters are not here";
  for (const char* name : {"kodim05.png", "kodim23.png", "astronaut.png"}) {
    const auto photo = read_channels(folder + name);
    ASSERT_TRUE(photo) << photo.error().message;
    EXPECT_TRUE(photo->is_color && photo->is_8bit) << name;
  }
  const auto aerial = read_channels(folder + "santa_barbara_aerial.tif");
  ASSERT_TRUE(aerial) << aerial.error().message;
  const auto heights = read_height_field(folder + "santa_barbara_elev.tif");
  ASSERT_TRUE(heights) << heights.error().message;
  const auto difference =
      find_grid_difference(heights->info, heights->cols, heights->rows, aerial->info, aerial->cols, aerial->rows);
  EXPECT_EQ(difference.has_value(), aerial->cols != heights->cols || aerial->rows != heights->rows)
      << difference.value_or("");
}

TEST(GridDifference, NamesWhatDiffers) {
  RasterInfo a;
  a.has_georeference = true;
  a.crs = "EPSG:32611";
  a.geotransform = {500000, 30, 0, 4100000, 0, -30};
  RasterInfo b = a;
  EXPECT_FALSE(find_grid_difference(a, 30, 40, b, 30, 40));
  EXPECT_EQ(*find_grid_difference(a, 30, 40, b, 10, 20), "is 10 x 20 samples instead of 30 x 40");
  b.geotransform[0] += 0.2;
  EXPECT_FALSE(find_grid_difference(a, 30, 40, b, 30, 40));
  b.geotransform[0] = 500015;
  EXPECT_EQ(*find_grid_difference(a, 30, 40, b, 30, 40), "begins at 500015, 4100000 instead of 500000, 4100000");
  b = a;
  b.geotransform[1] = 31;
  EXPECT_EQ(*find_grid_difference(a, 30, 40, b, 30, 40), "ends at 500930, 4098800 instead of 500900, 4098800");
  b = a;
  b.crs = "EPSG:4326";
  EXPECT_EQ(*find_grid_difference(a, 30, 40, b, 30, 40), "is in EPSG:4326 instead of EPSG:32611");
  b.crs = "+proj=utm +zone=11 +datum=WGS84";
  EXPECT_FALSE(find_grid_difference(a, 30, 40, b, 30, 40));
  b.crs.clear();
  EXPECT_FALSE(find_grid_difference(a, 30, 40, b, 30, 40));
  EXPECT_FALSE(find_grid_difference(a, 30, 40, RasterInfo{}, 30, 40));
  b = a;
  b.geotransform = {500000, 0, -30, 4100000, 30, 0};
  EXPECT_TRUE(find_grid_difference(a, 30, 30, b, 30, 30));
}

TEST(Script, ReadsStepsAndComments) {
  const ScratchFolder scratch;
  testing::write_text(scratch.file("s.txt"), "# points\n\n s 3 4 # a peak\r\ni 0 0\nu\t9 7\n");
  const auto steps = read_script(scratch.file("s.txt"), 10, 8);
  ASSERT_TRUE(steps) << steps.error().message;
  ASSERT_EQ(steps->size(), 3u);
  EXPECT_EQ(steps->inserted, (std::vector<SampleAt>{{3, 4}}));
  EXPECT_EQ(steps->ignored, (std::vector<SampleAt>{{0, 0}, {9, 7}}));
  testing::write_text(scratch.file("empty.txt"), "");
  EXPECT_TRUE(read_script(scratch.file("empty.txt"), 10, 8)->size() == 0);
}

TEST(Script, NamesTheLineThatIsWrong) {
  const ScratchFolder scratch;
  for (const auto& [line, word] : {std::pair{"x 1 2", "'x'"},
                                   {"s 1", "needs a column and a row"},
                                   {"s", "needs a column and a row"},
                                   {"s 1 # 2", "needs a column and a row"},
                                   {"s 1.5 2", "'1.5'"},
                                   {"s 1 2 3", "'3'"},
                                   {"s 10 2", "(10, 2)"},
                                   {"i 1 8", "(1, 8)"},
                                   {"u -1 0", "(-1, 0)"},
                                   {"s 99999999999 0", "(99999999999, 0)"},
                                   {"s 99999999999999999999 0", "'99999999999999999999'"},
                                   {"i 1 1", "sample (1, 1) is ignored, but line 1 inserts it"},
                                   {"\x01\x02", "'\?\?'"}}) {
    testing::write_text(scratch.file("s.txt"), std::string("s 1 1\n\n") + line + "\ns 1 1\n");
    const auto steps = read_script(scratch.file("s.txt"), 10, 8);
    ASSERT_FALSE(steps) << line;
    EXPECT_EQ(steps.error().kind, ErrorKind::kInput);
    EXPECT_TRUE(contains(steps.error().message, scratch.file("s.txt") + ": line 3: ")) << steps.error().message;
    EXPECT_TRUE(contains(steps.error().message, word)) << steps.error().message;
  }
  EXPECT_FALSE(read_script(scratch.file("missing.txt"), 10, 8));
}

}  // namespace
}  // namespace scarp
