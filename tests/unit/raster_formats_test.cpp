// Formats written by GDAL: skipped without gdal_translate.
#include <gtest/gtest.h>

#include <cmath>

#include "raster_files.h"

namespace scarp::raster_formats_test {
namespace {

using testing::run;

constexpr int kCols = 300, kRows = 280;

float height_at(int col, int row) { return static_cast<float>((col * 37 + row * 101 + col * row) % 2000); }

class RasterFormats : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!testing::has_program("gdal_translate")) GTEST_SKIP() << "needs gdal_translate (gdal-bin)";
    std::vector<float> samples;
    for (int row = 0; row < kRows; ++row) {
      for (int col = 0; col < kCols; ++col) samples.push_back(height_at(col, row));
    }
    testing::write_envi<float>(scratch_.file("source"), kCols, kRows, samples,
                               "map info = {UTM, 1, 1, 500000, 4100000, 30, 30, 11, North, WGS-84}\n");
  }

  /// Runs gdal_translate from the source to `name` and reads `name`.
  Result<OwnedHeightField> translated(const std::string& options, const std::string& name) {
    EXPECT_TRUE(run("gdal_translate -q " + options + " " + scratch_.file("source") + " " + scratch_.file(name)));
    return read_height_field(scratch_.file(name));
  }

  static void expect_source(const Result<OwnedHeightField>& read, const std::string& what) {
    ASSERT_TRUE(read) << what << ": " << read.error().message;
    ASSERT_EQ(read->cols, kCols) << what;
    ASSERT_EQ(read->rows, kRows) << what;
    EXPECT_EQ(read->sample_rounding, 0) << what;
    for (int row = 0; row < kRows; ++row) {
      for (int col = 0; col < kCols; ++col) {
        ASSERT_EQ(read->samples[static_cast<std::size_t>(row * kCols + col)], height_at(col, row))
            << what << " " << col << " " << row;
      }
    }
  }

  testing::ScratchFolder scratch_;
};

TEST_F(RasterFormats, GeoTiffTypesAndLayouts) {
  for (const std::string type : {"Int16", "UInt16", "Int32", "UInt32", "Float32", "Float64"}) {
    for (const std::string layout :
         {"", "-co TILED=YES -co BLOCKXSIZE=64 -co BLOCKYSIZE=128", "-co COMPRESS=ZSTD -co TILED=YES",
          "-co COMPRESS=DEFLATE -co BLOCKYSIZE=280", "-co COMPRESS=LZW -co PREDICTOR=2"}) {
      if (layout.find("PREDICTOR") != std::string::npos && type.rfind("Float", 0) == 0) continue;
      const auto read = translated("-ot " + type + " " + layout, "dem.tif");
      expect_source(read, type + " " + layout);
      EXPECT_EQ(read->info.sample_type, type);
      EXPECT_EQ(read->info.format, "GTiff");
      EXPECT_EQ(read->info.crs, "EPSG:32611");
      EXPECT_EQ(read->frame.kind, Frame::Kind::kLocal);
      EXPECT_EQ(place_in_source(read->frame, read->info, read->rows)->origin(),
                (std::array<double, 2>{504515, 4095785}));
    }
  }
}

TEST_F(RasterFormats, CogPngAndAscii) {
  expect_source(translated("-of COG -co BLOCKSIZE=128 -co COMPRESS=DEFLATE", "cog.tif"), "COG");
  const auto png = translated("-of PNG -ot UInt16", "dem.png");
  expect_source(png, "PNG");
  EXPECT_EQ(png->info.format, "PNG");
  EXPECT_EQ(png->info.sample_type, "UInt16");
  const auto ascii = translated("-of AAIGrid", "dem.asc");
  expect_source(ascii, "AAIGrid");
  EXPECT_EQ(ascii->info.format, "AAIGrid");
}

TEST_F(RasterFormats, MosaicOfTwoHalves) {
  for (const char* half : {"0 0 160", "160 0 140"}) {
    ASSERT_TRUE(run("gdal_translate -q -ot Int16 -srcwin " + std::string(half) + " 280 " + scratch_.file("source") +
                    " " + scratch_.file(half[0] == '0' ? "west.tif" : "east.tif")));
  }
  ASSERT_TRUE(run("gdalbuildvrt -q " + scratch_.file("both.vrt") + " " + scratch_.file("west.tif") + " " +
                  scratch_.file("east.tif")));
  const auto read = read_height_field(scratch_.file("both.vrt"));
  expect_source(read, "mosaic");
  EXPECT_EQ(read->info.format, "VRT");
  std::filesystem::remove(scratch_.file("east.tif"));
  const Error error = testing::read_error(scratch_.file("both.vrt"));
  EXPECT_EQ(error.kind, ErrorKind::kInput) << "a missing part is no flat ground";
}

TEST_F(RasterFormats, HgtPlainAndZipped) {
  const std::string to_hgt =
      "-of SRTMHGT -ot Int16 -r nearest -outsize 1201 1201 -a_srs EPSG:4326 -a_nodata -32768 "
      "-a_ullr 0.99958333333 42.00041666667 2.00041666667 40.99958333333";
  const auto plain = translated(to_hgt, "N41E001.hgt");
  ASSERT_TRUE(plain) << plain.error().message;
  EXPECT_EQ(plain->info.format, "SRTMHGT");
  EXPECT_EQ(plain->cols, 1201);
  EXPECT_EQ(plain->info.crs, "EPSG:4326");
  EXPECT_TRUE(plain->info.is_geographic);
  EXPECT_EQ(plain->info.unit, "m");
  EXPECT_EQ(plain->info.nodata, -32768.0);
  EXPECT_EQ(plain->frame.kind, Frame::Kind::kLocal);
  if (!testing::has_program("cmake")) GTEST_SKIP() << "needs cmake to make a zip";
  const std::string zip = "cd " + scratch_.file("") + " && cmake -E tar cf ";
  for (const std::string name : {"N41E001.hgt.zip", "tile.zip"}) {
    ASSERT_TRUE(run(zip + name + " --format=zip N41E001.hgt"));
    const auto zipped = read_height_field(scratch_.file(name));
    ASSERT_TRUE(zipped) << zipped.error().message;
    EXPECT_EQ(zipped->samples, plain->samples);
    EXPECT_EQ(zipped->frame.affine, plain->frame.affine);
  }
  ASSERT_TRUE(run(zip + "many.zip --format=zip N41E001.hgt source source.hdr"));
  EXPECT_TRUE(
      testing::contains(testing::read_error(scratch_.file("many.zip")).message, "rasters; name one of them: '/vsizip/"));
  testing::write_text(scratch_.file("cut.zip"), testing::read_text(scratch_.file("tile.zip")).substr(0, 300));
  EXPECT_TRUE(testing::contains(testing::read_error(scratch_.file("cut.zip")).message, "the zip is damaged"));
  testing::write_text(scratch_.file("N41E002.hgt"), testing::read_text(scratch_.file("N41E001.hgt")).substr(0, 99999));
  EXPECT_TRUE(testing::contains(testing::read_error(scratch_.file("N41E002.hgt")).message, "99999 bytes"));
}

TEST_F(RasterFormats, UsgsDem) {
  const auto read = translated(
      "-of USGSDEM -ot Int16 -a_srs EPSG:26911 -a_ullr 499995 4100025 508995 4091625 -co ZRESOLUTION=1", "quad.dem");
  expect_source(read, "USGSDEM");
  EXPECT_EQ(read->info.format, "USGSDEM");
  EXPECT_EQ(read->info.unit, "m");
}

TEST_F(RasterFormats, DamagedFilesFailWithTheRow) {
  const auto cut = [&](const std::string& options, const std::string& name, double share) {
    EXPECT_TRUE(translated(options, name));
    const std::string whole = testing::read_text(scratch_.file(name));
    testing::write_text(scratch_.file(name),
                        whole.substr(0, static_cast<std::size_t>(static_cast<double>(whole.size()) * share)));
    std::filesystem::remove(scratch_.file(name + ".aux.xml"));
    const Error error = testing::read_error(scratch_.file(name));
    EXPECT_EQ(error.kind, ErrorKind::kInput);
    return error.message;
  };
  using testing::contains;
  for (const std::string options :
       {"-ot Int16", "-ot Float32 -co TILED=YES", "-ot Int16 -co COMPRESS=ZSTD", "-ot Float64 -co COMPRESS=DEFLATE"}) {
    for (const double share : {0.02, 0.3, 0.5, 0.9}) {
      const std::string message = cut(options, "dem.tif", share);
      EXPECT_TRUE(contains(message, "row") || contains(message, "damaged")) << message;
    }
  }
  cut("-of COG -co BLOCKSIZE=128", "cog.tif", 0.5);
  EXPECT_TRUE(contains(cut("-of PNG -ot UInt16", "dem.png", 0.5), "row "));
  EXPECT_TRUE(contains(cut("-of AAIGrid", "dem.asc", 0.5), "row 13"));

  ASSERT_TRUE(translated("-ot Int16 -co COMPRESS=ZSTD -co TILED=YES -co BLOCKXSIZE=64 -co BLOCKYSIZE=64", "dem.tif"));
  std::string bytes = testing::read_text(scratch_.file("dem.tif"));
  for (std::size_t k = bytes.size() / 2; k < bytes.size() / 2 + 3000; ++k)
    bytes[k] = static_cast<char>(bytes[k] ^ 0x5a);
  testing::write_text(scratch_.file("dem.tif"), bytes);
  EXPECT_TRUE(contains(testing::read_error(scratch_.file("dem.tif")).message, "row "));
}

TEST_F(RasterFormats, ReadingLeavesNothingBehind) {
  ASSERT_TRUE(translated("-of PNG -ot UInt16", "dem.png"));
  std::filesystem::remove(scratch_.file("dem.png.aux.xml"));
  const auto count = [&] {
    int files = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(scratch_.file(""))) ++files;
    return files;
  };
  const int before = count();
  ASSERT_TRUE(read_height_field(scratch_.file("dem.png")));
  EXPECT_EQ(count(), before);
}

TEST_F(RasterFormats, PngOfAPictureReadsBack) {
  Picture picture{40, 30, {}};
  for (int k = 0; k < 40 * 30 * 3; ++k) picture.rgb.push_back(static_cast<std::uint8_t>(k * 7));
  const auto png = encode_png(picture);
  ASSERT_TRUE(png) << png.error().message;
  EXPECT_EQ(*png, encode_png(picture).value()) << "the same bytes each time";
  testing::write_text(scratch_.file("picture.png"), std::string(png->begin(), png->end()));
  for (int band = 1; band <= 3; ++band) {
    ReadOptions options;
    options.band = band;
    const auto read = read_height_field(scratch_.file("picture.png"), options);
    ASSERT_TRUE(read) << read.error().message;
    for (std::size_t k = 0; k < read->samples.size(); ++k) {
      ASSERT_EQ(read->samples[k], picture.rgb[3 * k + static_cast<std::size_t>(band) - 1]);
    }
  }
  EXPECT_FALSE(encode_png(Picture{0, 0, {}}));
  EXPECT_FALSE(encode_png(Picture{2, 2, {1, 2, 3}}));
}

}  // namespace
}  // namespace scarp::raster_formats_test
