// Rasters written and read back.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "io/raster/pgm.h"
#include "raster_files.h"

namespace scarp {
namespace {

using testing::contains;
using testing::ScratchFolder;

const float kNan = std::numeric_limits<float>::quiet_NaN();

RC_GTEST_PROP(RasterWrite, PgmReadsBackRounded, ()) {
  const int cols = *rc::gen::inRange(2, 20), rows = *rc::gen::inRange(2, 20);
  std::vector<float> samples;
  for (int i = 0; i < cols * rows; ++i) samples.push_back(static_cast<float>(*rc::gen::inRange(0, 655340)) / 10);
  samples[0] = kNan;
  const auto bytes = encode_raster({samples, cols, rows}, RasterFormat::kPgm);
  RC_ASSERT(bytes.has_value());
  ReadOptions options;
  options.nodata = 65535;
  const auto back = io::decode_pgm(*bytes, "x.pgm", options);
  RC_ASSERT(back.has_value());
  RC_ASSERT(back->cols == cols && back->rows == rows);
  RC_ASSERT(std::isnan(back->samples[0]));
  for (std::size_t i = 1; i < samples.size(); ++i) {
    RC_ASSERT(back->samples[i] == std::floor(back->samples[i]));
    RC_ASSERT(std::abs(back->samples[i] - samples[i]) <= 0.5f);
  }
}

TEST(RasterWrite, PgmRefusesWhatItCannotHold) {
  const auto refusal = [](std::vector<float> samples) {
    const auto bytes = encode_raster({samples, 2, 2}, RasterFormat::kPgm);
    EXPECT_FALSE(bytes);
    EXPECT_EQ(bytes.error().kind, ErrorKind::kOutput);
    return bytes.error().message;
  };
  EXPECT_TRUE(contains(refusal({1, 2, -1, 4}), "sample (0, 1) is -1"));
  EXPECT_TRUE(contains(refusal({1, 65536, 1, 4}), "sample (1, 0) is 65536"));
  EXPECT_TRUE(contains(refusal({1, INFINITY, 1, 4}), "sample (1, 0)"));
  EXPECT_TRUE(contains(refusal({1, 65535, 1, kNan}), "sample (1, 0) is 65535"));
  EXPECT_TRUE(encode_raster({std::vector<float>{1, 65535, 1, 0}, 2, 2}, RasterFormat::kPgm));
  EXPECT_FALSE(encode_raster({std::vector<float>{1, 2, 3}, 2, 2}, RasterFormat::kPgm));
  EXPECT_FALSE(encode_raster({{}, 0, 0}, RasterFormat::kGeoTiff));
}

TEST(RasterWrite, GeoTiffKeepsValuesPlaceAndUnit) {
  const ScratchFolder scratch;
  constexpr int kCols = 301, kRows = 77;
  std::vector<float> samples;
  for (int i = 0; i < kCols * kRows; ++i) samples.push_back(static_cast<float>(std::sin(i) * 1e4) + 0.1f);
  samples[5] = kNan;
  samples[6] = -0.0f;
  samples[7] = std::numeric_limits<float>::denorm_min();
  for (const std::string crs : {"EPSG:32611", "EPSG:4326", "EPSG:3031", ""}) {
    RasterInfo like;
    like.crs = crs;
    like.has_georeference = true;
    like.geotransform = crs == "EPSG:4326" ? std::array<double, 6>{-117.5, 1.0 / 3600, 0, 34.25, 0, -1.0 / 3600}
                                           : std::array<double, 6>{500000.5, 30, 0, 4100000.25, 0, -30};
    like.unit = "ft";
    const auto bytes = encode_raster({samples, kCols, kRows, &like}, RasterFormat::kGeoTiff);
    ASSERT_TRUE(bytes) << bytes.error().message;
    EXPECT_EQ(*bytes, *encode_raster({samples, kCols, kRows, &like}, RasterFormat::kGeoTiff));
    ASSERT_TRUE(write_file(scratch.file("out.tif"), *bytes));
    const auto back = read_height_field(scratch.file("out.tif"), {.heights_in = HeightsIn::kFile});
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back->info.crs, crs);
    EXPECT_EQ(back->info.unit, "ft");
    EXPECT_EQ(back->info.geotransform, like.geotransform);
    EXPECT_EQ(back->info.sample_type, "Float32");
    EXPECT_EQ(back->info.valid, samples.size() - 1);
    EXPECT_FALSE(find_grid_difference(like, kCols, kRows, back->info, back->cols, back->rows));
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (i == 5) {
        ASSERT_TRUE(std::isnan(back->samples[i]));
      } else {
        ASSERT_EQ(back->samples[i], samples[i]) << i;
      }
    }
  }
  const auto bare = encode_raster({samples, kCols, kRows}, RasterFormat::kGeoTiff);
  ASSERT_TRUE(bare);
  ASSERT_TRUE(write_file(scratch.file("bare.tif"), *bare));
  EXPECT_FALSE(read_height_field(scratch.file("bare.tif"))->info.has_georeference);
}

TEST(RasterWrite, RowByRowTheBytesAreThoseOfAWhole) {
  const ScratchFolder scratch;
  for (const auto& [cols, rows] : {std::pair{700, 530}, {3, 256}, {90, 7}, {2000, 1300}}) {
    std::vector<float> samples;
    for (int i = 0; i < cols * rows; ++i) samples.push_back(i % 97 == 5 ? kNan : static_cast<float>(std::sin(i) * 1e4));
    RasterInfo like;
    like.has_georeference = true;
    like.geotransform = {500000, 30, 0, 4100000, 0, -30};
    like.crs = "EPSG:32611";
    const std::string path = scratch.file("rows.tif");
    auto file = RasterFile::create(path, cols, rows, &like);
    ASSERT_TRUE(file) << file.error().message;
    for (int y = 0; y < rows; ++y)
      ASSERT_TRUE(
          file->add(std::span(samples).subspan(static_cast<std::size_t>(y * cols), static_cast<std::size_t>(cols))));
    ASSERT_TRUE(file->finish());
    EXPECT_FALSE(read_file(path).has_value() && cols == 700) << "the file has its name too early";
    const FileBytes ready{path, {}, &*file};
    ASSERT_TRUE(write_files({&ready, 1}));
    const auto whole = encode_raster({samples, cols, rows, &like}, RasterFormat::kGeoTiff);
    const auto written = read_file(path);
    ASSERT_TRUE(whole && written);
    EXPECT_TRUE(*whole == *written) << cols << " x " << rows;
    EXPECT_EQ(file->size(), whole->size());
  }
  EXPECT_FALSE(RasterFile::create(scratch.file("rows.tif"), 4, 4, nullptr, false));
  {
    auto dropped = RasterFile::create(scratch.file("dropped.tif"), 4, 4, nullptr);
    ASSERT_TRUE(dropped && dropped->add(std::vector<float>(4)));
  }
  const auto left = std::filesystem::directory_iterator(std::filesystem::path(scratch.file("rows.tif")).parent_path());
  EXPECT_EQ(std::distance(left, {}), 1);
}

TEST(RasterWrite, GeoTiffOfARealRasterLiesWhereTheRasterLies) {
  const std::string folder = testing::reference_folder();
  if (folder.empty()) GTEST_SKIP() << "the reference rasters are not here";
  const ScratchFolder scratch;
  for (const char* name : {"jacksboro_fault.tif", "antarctica_bedmap.tif", "egm84_geoid_3857.tif", "SainteHelens.dem",
                           "mars_gale_hirise_1m.tif", "wahoo_swath_nan.tif", "grenoble_copernicus.tif"}) {
    const auto field = read_height_field(folder + name);
    ASSERT_TRUE(field) << field.error().message;
    const auto bytes = encode_raster({field->samples, field->cols, field->rows, &field->info}, RasterFormat::kGeoTiff);
    ASSERT_TRUE(bytes) << name << ": " << bytes.error().message;
    ASSERT_TRUE(write_file(scratch.file("out.tif"), *bytes));
    const auto back = read_height_field(scratch.file("out.tif"));
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back->info.valid, field->info.valid) << name;
    const auto difference =
        find_grid_difference(field->info, field->cols, field->rows, back->info, back->cols, back->rows);
    EXPECT_FALSE(difference) << name << " " << *difference;
    EXPECT_EQ(back->info.unit, field->info.unit) << name;
    EXPECT_EQ(back->frame.kind, field->frame.kind) << name;
  }
}

}  // namespace
}  // namespace scarp
