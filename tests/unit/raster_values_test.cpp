// Types, nodata, scale and offset, masks, colours.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "raster_files.h"

namespace scarp {
namespace {

using testing::contains;
using testing::read_error;
using testing::ScratchFolder;
using testing::warns;
using testing::write_envi;
using testing::write_vrt;

template <class T>
class RasterTypes : public ::testing::Test {};
using AllTypes = ::testing::Types<std::uint8_t, std::int16_t, std::uint16_t, std::int32_t, std::uint32_t, std::int64_t,
                                  std::uint64_t, float, double>;
TYPED_TEST_SUITE(RasterTypes, AllTypes);

TYPED_TEST(RasterTypes, ExtremesAndNodata) {
  using T = TypeParam;
  const ScratchFolder scratch;
  const std::string path = scratch.file("dem");
  const T low = std::is_floating_point_v<T> ? T(-1e6) : std::numeric_limits<T>::lowest();
  const T high = std::is_floating_point_v<T> ? T(1e6) : std::numeric_limits<T>::max();
  const std::vector<T> values{low, T(1), T(2), T(3), T(7), high};
  if constexpr (std::is_integral_v<T> && sizeof(T) == 8) {
    testing::write_raw_vrt<T>(path, 3, 2, values, std::is_signed_v<T> ? "Int64" : "UInt64",
                              "<NoDataValue>7</NoDataValue>");
  } else {
    write_envi<T>(path, 3, 2, values, "data ignore value = 7\n");
  }
  auto read = read_height_field(path);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->samples[0], static_cast<float>(low));
  EXPECT_EQ(read->samples[3], 3);
  EXPECT_EQ(read->samples[5], static_cast<float>(high));
  EXPECT_TRUE(std::isnan(read->samples[4]));
  EXPECT_EQ(read->info.valid, 5u);
  EXPECT_EQ(read->info.nodata, 7.0);
  // 2^31 − 1, 2^32 − 1, 2^63 − 1 and 2^64 − 1 are one less than a float32.
  EXPECT_EQ(read->sample_rounding, sizeof(T) >= 4 && !std::is_floating_point_v<T> ? 1 : 0);

  ReadOptions options;
  options.nodata = 3;
  read = read_height_field(path, options);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_TRUE(std::isnan(read->samples[3]));
  EXPECT_EQ(read->samples[4], 7) << "the declared value is a height once another one is given";
  EXPECT_EQ(read->info.nodata, 3.0);
}

TEST(RasterValues, DoubleRoundingIsTheLargest) {
  const ScratchFolder scratch;
  write_envi<double>(scratch.file("dem"), 2, 2, {0.1, 1000.1, 2, -8848.86});
  const auto read = read_height_field(scratch.file("dem"));
  ASSERT_TRUE(read) << read.error().message;
  double expected = 0;
  for (const double z : {0.1, 1000.1, 2.0, -8848.86}) {
    expected = std::max(expected, std::abs(z - static_cast<double>(static_cast<float>(z))));
  }
  EXPECT_GT(expected, 0);
  EXPECT_EQ(read->sample_rounding, expected);
}

TEST(RasterValues, Int32BeyondFloatIsCounted) {
  const ScratchFolder scratch;
  write_envi<std::int32_t>(scratch.file("dem"), 2, 2, {0, 1 << 24, (1 << 24) + 1, -(1 << 26) - 3});
  const auto read = read_height_field(scratch.file("dem"));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->sample_rounding, 3);
}

TEST(RasterValues, InfinitiesAreNodataWithAWarning) {
  const ScratchFolder scratch;
  const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  write_envi<float>(scratch.file("dem"), 3, 2, {1, inf, -inf, nan, 2, 3});
  auto read = read_height_field(scratch.file("dem"));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->info.valid, 3u);
  EXPECT_EQ(read->info.max, 3);
  EXPECT_TRUE(warns(read->info, "2 samples are infinite"));
  for (std::size_t k = 1; k < 4; ++k) EXPECT_TRUE(std::isnan(read->samples[k]));

  write_envi<double>(scratch.file("wide"), 2, 2, {1, 1e300, -std::numeric_limits<double>::infinity(), 2});
  read = read_height_field(scratch.file("wide"));
  ASSERT_FALSE(read) << "a height that no float32 holds is not nodata";
  EXPECT_NE(read.error().message.find("the value 1e+300 at column 1, row 0 is beyond what a float32 holds"),
            std::string::npos);

  write_envi<float>(scratch.file("finite"), 2, 2, {1, nan, 3, 4});
  read = read_height_field(scratch.file("finite"));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_TRUE(read->info.warnings.empty()) << "NaN is plain nodata";
}

TEST(RasterValues, ImpreciseLowestFloatIsNodata) {
  const ScratchFolder scratch;
  const float lowest = std::numeric_limits<float>::lowest();
  for (const std::string declared : {"-3.40282e+38", "-3.4028234663852886e+38", "-3.402823466e+38", "-3.4e+38"}) {
    write_envi<float>(scratch.file("dem"), 2, 2, {1, lowest, -5, 4}, "data ignore value = " + declared + "\n");
    const auto read = read_height_field(scratch.file("dem"));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->info.valid, 3u) << declared;
    EXPECT_EQ(read->info.min, -5) << declared;
    EXPECT_TRUE(read->info.warnings.empty());
    write_envi<double>(scratch.file("dem"), 2, 2, {1, static_cast<double>(lowest), -5, 4},
                       "data ignore value = " + declared + "\n");
    EXPECT_EQ(read_height_field(scratch.file("dem"))->info.valid, 3u) << declared;
  }
}

TEST(RasterValues, NodataIsComparedInTheBandsType) {
  const ScratchFolder scratch;
  write_envi<float>(scratch.file("dem"), 2, 2, {1, 0.1f, -5, 4}, "data ignore value = 0.1\n");
  EXPECT_EQ(read_height_field(scratch.file("dem"))->info.valid, 3u) << "0.1 as float32 is what the file holds";
  ReadOptions scaled;
  scaled.z_scale = 2;
  EXPECT_EQ(read_height_field(scratch.file("dem"), scaled)->info.valid, 3u) << "whatever is made of the others";
  write_envi<std::int16_t>(scratch.file("ints"), 2, 2, {1, -9999, 2, 3}, "data ignore value = -9999.5\n");
  EXPECT_EQ(read_height_field(scratch.file("ints"))->info.valid, 4u) << "no int16 is -9999.5";
}

TEST(RasterValues, ScaleAndOffsetWorkInDouble) {
  const ScratchFolder scratch;
  write_envi<std::int16_t>(scratch.file("raw"), 3, 2, {0, 1, 123, -9999, 32767, -32768});
  write_vrt(scratch.file("dem.vrt"), "raw", 3, 2, "Int16", "",
            "<NoDataValue>-9999</NoDataValue><UnitType>m</UnitType><Offset>100</Offset><Scale>0.1</Scale>");
  const auto read = read_height_field(scratch.file("dem.vrt"));
  ASSERT_TRUE(read) << read.error().message;
  const int raw[] = {0, 1, 123, -9999, 32767, -32768};
  double rounding = 0;
  for (std::size_t k = 0; k < 6; ++k) {
    if (k == 3) continue;
    const double height = raw[k] * 0.1 + 100;
    EXPECT_EQ(read->samples[k], static_cast<float>(height));
    rounding = std::max(rounding, std::abs(height - static_cast<double>(read->samples[k])));
  }
  EXPECT_TRUE(std::isnan(read->samples[3])) << "nodata is a raw value";
  EXPECT_EQ(read->sample_rounding, rounding);
  EXPECT_EQ(read->info.unit, "m");
}

TEST(RasterValues, MaskBandAndAlphaHide) {
  const ScratchFolder scratch;
  write_envi<float>(scratch.file("raw"), 2, 2, {1, 2, 3, 4});
  write_envi<std::uint8_t>(scratch.file("shown"), 2, 2, {255, 0, 1, 255});
  write_vrt(scratch.file("masked.vrt"), "raw", 2, 2, "Float32",
            "<MaskBand><VRTRasterBand dataType=\"Byte\"><SimpleSource><SourceFilename "
            "relativeToVRT=\"1\">shown</SourceFilename>"
            "<SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></MaskBand>",
            "");
  auto read = read_height_field(scratch.file("masked.vrt"));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->info.valid, 3u);
  EXPECT_TRUE(std::isnan(read->samples[1]));

  const std::string alpha =
      "</VRTRasterBand><VRTRasterBand dataType=\"Byte\" band=\"2\"><ColorInterp>Alpha</ColorInterp><SimpleSource>"
      "<SourceFilename "
      "relativeToVRT=\"1\">shown</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand>";
  for (const std::string nodata : {"", "<NoDataValue>4</NoDataValue>"}) {
    write_vrt(scratch.file("alpha.vrt"), "raw", 2, 2, "Float32", "", nodata);
    std::string text = testing::read_text(scratch.file("alpha.vrt"));
    text.replace(text.rfind("</VRTRasterBand>"), 16, alpha);
    testing::write_text(scratch.file("alpha.vrt"), text);
    read = read_height_field(scratch.file("alpha.vrt"));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_TRUE(std::isnan(read->samples[1]));
    EXPECT_EQ(std::isnan(read->samples[3]), !nodata.empty()) << "alpha counts beside a declared value";
    EXPECT_EQ(read->samples[2], 3);
  }
}

TEST(RasterValues, BandsAndTheirRange) {
  const ScratchFolder scratch;
  const std::string path = scratch.file("dem");
  write_envi<std::int16_t>(path, 2, 2, {1, 2, 3, 4, 11, 12, 13, 14});
  ReadOptions options;
  options.band = 2;
  EXPECT_EQ(read_height_field(path, options)->samples, (std::vector<float>{11, 12, 13, 14}));
  for (const int band : {0, -1, 3}) {
    options.band = band;
    const Error error = read_error(path, options);
    EXPECT_EQ(error.kind, ErrorKind::kInput);
    EXPECT_TRUE(contains(error.message, "has 2 bands; there is no band " + std::to_string(band))) << error.message;
  }
}

TEST(RasterValues, Colours) {
  const ScratchFolder scratch;
  const std::string path = scratch.file("rgb");
  const std::vector<std::uint8_t> rgb{128, 131, 1, 0, /* G */ 0, 5, 134, 0, /* B */ 0, 64, 160, 0};
  write_envi<std::uint8_t>(path, 2, 2, rgb);
  ReadOptions options;
  options.decode = Decode::kTerrarium;
  auto read = read_height_field(path, options);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->samples, (std::vector<float>{0, 773.25f, 256 + 134 + 160 / 256.0f - 32768, -32768}));
  EXPECT_EQ(read->sample_rounding, 0);

  options.decode = Decode::kMapbox;
  read = read_height_field(path, options);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->samples[2], static_cast<float>(-10000 + (65536 + 134 * 256 + 160) * 0.1));
  EXPECT_EQ(read->samples[3], -10000);
  EXPECT_GT(read->sample_rounding, 0);
  EXPECT_LT(read->sample_rounding, 0.05);

  auto with_alpha = rgb;
  for (const int alpha : {255, 0, 1, 255}) with_alpha.push_back(static_cast<std::uint8_t>(alpha));
  write_envi<std::uint8_t>(path, 2, 2, with_alpha);
  read = read_height_field(path, options);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_TRUE(std::isnan(read->samples[1]));
  EXPECT_EQ(read->info.valid, 3u);

  options.nodata = -10000;
  EXPECT_EQ(read_height_field(path, options)->info.valid, 2u) << "nodata is compared with decoded heights";

  write_envi<std::uint8_t>(path, 2, 2, {1, 2, 3, 4});
  EXPECT_TRUE(contains(read_error(path, options).message, "3 or 4 bands of bytes, and this raster has 1 of type Byte"));
  write_envi<std::uint16_t>(path, 2, 2, std::vector<std::uint16_t>(12, 1));
  EXPECT_TRUE(contains(read_error(path, options).message, "has 3 of type UInt16"));
}

}  // namespace
}  // namespace scarp
