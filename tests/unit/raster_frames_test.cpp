// Where rasters lie: frames, CRS options, their errors.
#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "raster_files.h"

namespace scarp::raster_frames_test {
namespace {

using testing::contains;
using testing::read_error;
using testing::ScratchFolder;
using testing::vrt_position;
using testing::warns;

constexpr int kCols = 41, kRows = 30;

/// One raster of 41 × 30 samples at different places.
class RasterFrames : public ::testing::Test {
 protected:
  RasterFrames() {
    std::vector<float> samples;
    for (int k = 0; k < kCols * kRows; ++k) samples.push_back(static_cast<float>(k));
    testing::write_envi<float>(scratch_.file("raw"), kCols, kRows, samples);
  }
  std::string placed(const std::string& crs, const std::string& geotransform, const std::string& band = "") {
    testing::write_vrt(scratch_.file("dem.vrt"), "raw", kCols, kRows, "Float32", vrt_position(crs, geotransform), band);
    return scratch_.file("dem.vrt");
  }
  static ReadOptions in(const std::string& crs) {
    ReadOptions options;
    options.crs = crs;
    return options;
  }
  ScratchFolder scratch_;
};

TEST_F(RasterFrames, WithoutGeoreference) {
  const std::string path = scratch_.file("raw");
  for (const std::string crs : {"", "grid"}) {
    const auto read = read_height_field(path, in(crs));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->frame.kind, Frame::Kind::kGrid);
    EXPECT_EQ(read->frame.apply_affine(3, 0), (std::array<double, 2>{3, kRows - 1}));
    EXPECT_FALSE(read->info.has_georeference);
    EXPECT_TRUE(read->info.crs.empty());
  }
  for (const std::string crs : {"source", "local", "EPSG:32611"})
    EXPECT_EQ(read_error(path, in(crs)).kind, ErrorKind::kUsage);
}

TEST_F(RasterFrames, ProjectedKeepsItsCoordinates) {
  const std::string path = placed("EPSG:32611", "500000, 30, 0, 4100000, 0, -30");
  for (const std::string crs : {"", "source", "EPSG:32611", "+proj=utm +zone=11 +datum=WGS84"}) {
    const auto read = read_height_field(path, in(crs));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->frame.kind, Frame::Kind::kSource) << crs;
    EXPECT_EQ(read->frame.crs, "EPSG:32611");
    EXPECT_EQ(read->frame.affine, (std::array<double, 6>{500015, 30, 0, 4099985, 0, -30}));
    EXPECT_TRUE(offsets_are_exact(read->frame, kCols, kRows));
    EXPECT_EQ(read->info.cell_x_m, 30);
    EXPECT_FALSE(read->info.is_geographic);
  }
  const auto local = read_height_field(path, in("local"));
  ASSERT_TRUE(local) << local.error().message;
  EXPECT_EQ(local->frame.affine, (std::array<double, 6>{-600, 30, 0, 450, 0, -30}));
  EXPECT_EQ(read_height_field(path, in("grid"))->frame.kind, Frame::Kind::kGrid);
}

TEST_F(RasterFrames, RotatedAndSouthUp) {
  const auto turned = read_height_field(placed("EPSG:32611", "500000, 8, 4, 4100000, 4, -8"));
  ASSERT_TRUE(turned) << turned.error().message;
  EXPECT_EQ(turned->frame.affine, (std::array<double, 6>{500006, 8, 4, 4099998, 4, -8}));
  EXPECT_EQ(turned->info.cell_x, std::hypot(8, 4));
  const auto up = read_height_field(placed("EPSG:32611", "500000, 30, 0, 4100000, 0, 30"));
  ASSERT_TRUE(up) << up.error().message;
  EXPECT_GT(up->frame.determinant(), 0);
  const auto geographic = read_height_field(placed("EPSG:4326", "10, 0.001, 0.0003, 45, 0.0002, -0.001"));
  ASSERT_TRUE(geographic) << geographic.error().message;
  EXPECT_EQ(geographic->frame.kind, Frame::Kind::kLocal);
  EXPECT_TRUE(offsets_are_exact(geographic->frame, kCols, kRows));
  EXPECT_NEAR(geographic->frame.affine[2] / geographic->frame.affine[1], 0.3, 1e-5);
}

TEST_F(RasterFrames, GeographicBecomesMetres) {
  const auto read = read_height_field(placed("EPSG:4326", "9.98, 0.001, 0, 45.0155, 0, -0.001"));
  ASSERT_TRUE(read) << read.error().message;
  const Frame& frame = read->frame;
  EXPECT_EQ(frame.kind, Frame::Kind::kLocal);
  EXPECT_EQ(frame.apply_affine(20, 15), (std::array<double, 2>{0, 0}));
  EXPECT_EQ(frame_origin(frame, kCols, kRows), (std::array<double, 2>{0, 0}));
  EXPECT_TRUE(offsets_are_exact(frame, kCols, kRows));
  EXPECT_NEAR(frame.affine[1], 78.84681, 1e-4) << "a thousandth of a degree of longitude at 45 degrees";
  EXPECT_NEAR(frame.affine[5], -111.13175, 1e-4);
  EXPECT_TRUE(contains(frame.description, "local metres east and north of 10.0005, 45 (EPSG:4326), 78.84"))
      << frame.description;
  EXPECT_TRUE(read->info.is_geographic);
  EXPECT_NEAR(read->info.cell_x_m, 78.84681, 1e-4);
  EXPECT_EQ(read->info.cell_x, 0.001);
  EXPECT_TRUE(read->info.warnings.empty());
}

TEST_F(RasterFrames, OtherWorldsHaveTheirOwnMetres) {
  const std::string moon =
      "GEOGCS[\"Moon\",DATUM[\"Moon\",SPHEROID[\"Moon\",1737400,0]],PRIMEM[\"Reference\",0],UNIT[\"degree\",0."
      "0174532925199433]]";
  const auto read = read_height_field(placed(moon, "16, 0.01, 0, 60.155, 0, -0.01"));
  ASSERT_TRUE(read) << read.error().message;
  const double degree = 1737400 * std::acos(-1.0) / 180;
  EXPECT_NEAR(read->frame.affine[5], -0.01 * degree, 1e-3);
  EXPECT_NEAR(read->frame.affine[1], 0.01 * degree * 0.5, 1e-3);
}

TEST_F(RasterFrames, DegreesOnRequestComeWithAWarning) {
  const std::string path = placed("EPSG:4326", "9.98, 0.001, 0, 45.0155, 0, -0.001");
  for (const std::string crs : {"source", "EPSG:4326"}) {
    const auto read = read_height_field(path, in(crs));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->frame.kind, Frame::Kind::kSource);
    EXPECT_NEAR(read->frame.affine[0], 9.9805, 1e-12);
    EXPECT_TRUE(warns(read->info, "degrees"));
  }
}

TEST_F(RasterFrames, AnotherCrsThroughProj) {
  const auto read = read_height_field(placed("EPSG:4326", "9.98, 0.001, 0, 45.0155, 0, -0.001"), in("EPSG:32632"));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->frame.kind, Frame::Kind::kProjected);
  EXPECT_EQ(read->frame.crs, "EPSG:32632");
  ASSERT_FALSE(read->frame.is_affine());
  std::vector<double> x{9, 9}, y{45, 0};
  ASSERT_TRUE(read->frame.transform->apply(x, y));
  EXPECT_NEAR(x[0], 500000, 1e-6) << "9 degrees east is the zone's central meridian";
  EXPECT_NEAR(y[0], 4982950.40, 0.01);
  EXPECT_NEAR(y[1], 0, 1e-6);
  const auto origin = frame_origin(read->frame, kCols, kRows);
  EXPECT_NEAR(origin[0], 578854.71, 0.01) << "as gdaltransform has it";
}

TEST_F(RasterFrames, TransformsAgreeAcrossThreads) {
  const auto read = read_height_field(placed("EPSG:4326", "9.98, 0.001, 0, 45.0155, 0, -0.001"), in("EPSG:3035"));
  ASSERT_TRUE(read) << read.error().message;
  const auto transformed = [&](std::size_t batch) {
    std::vector<double> x, y;
    for (int k = 0; k < 5000; ++k) {
      x.push_back(9.98 + k * 8e-6);
      y.push_back(45 + k * 3e-6);
    }
    for (std::size_t at = 0; at < x.size(); at += batch) {
      const std::size_t count = std::min(batch, x.size() - at);
      EXPECT_TRUE(read->frame.transform->apply(std::span(x).subspan(at, count), std::span(y).subspan(at, count)));
    }
    x.insert(x.end(), y.begin(), y.end());
    return x;
  };
  const auto expected = transformed(5000);
  std::vector<std::vector<double>> results(6);
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < results.size(); ++k)
    threads.emplace_back([&, k] { results[k] = transformed(1 + 97 * k); });
  for (auto& thread : threads) thread.join();
  for (const auto& result : results) EXPECT_EQ(result, expected) << "bit for bit, whatever the thread and the batch";
}

TEST_F(RasterFrames, RefusesWhatCannotBe) {
  const std::string path = placed("EPSG:4326", "9.98, 0.001, 0, 45.0155, 0, -0.001");
  const auto unknown = read_height_field(path, in("EPSG:99999999"));
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().kind, ErrorKind::kUsage);
  EXPECT_TRUE(contains(unknown.error().message, "'EPSG:99999999'"));

  Error error = read_error(placed("EPSG:4326", "179.98, 0.001, 0, 45.0155, 0, -0.001"), in("EPSG:3857"));
  EXPECT_EQ(error.kind, ErrorKind::kUsage);
  EXPECT_TRUE(contains(error.message, "fold or tear")) << error.message;

  error = read_error(placed("EPSG:3031", "-20500, 1000, 0, 15000, 0, -1000"), in("EPSG:4326"));
  EXPECT_EQ(error.kind, ErrorKind::kUsage) << "the pole lies within";

  error = read_error(placed("EPSG:4326", "0, 0.001, 0, 90.015, 0, -0.001"));
  EXPECT_EQ(error.kind, ErrorKind::kUsage);
  EXPECT_TRUE(contains(error.message, "pole")) << error.message;

  error = read_error(placed("", "100, 2, 0, 50, 0, -2"), in("EPSG:32632"));
  EXPECT_EQ(error.kind, ErrorKind::kUsage);
  EXPECT_TRUE(contains(error.message, "has no CRS")) << error.message;

  error = read_error(placed("EPSG:32611", "500000, 30, 0, 4100000, 0, 0"));
  EXPECT_EQ(error.kind, ErrorKind::kInput);
  EXPECT_TRUE(contains(error.message, "geotransform")) << error.message;
}

TEST_F(RasterFrames, UnitsThatDoNotMix) {
  const std::string feet = "<UnitType>ft</UnitType>";
  EXPECT_TRUE(
      warns(read_height_field(placed("EPSG:4326", "9.98, 0.001, 0, 45.0155, 0, -0.001", feet))->info, "z is in ft"));
  EXPECT_TRUE(
      warns(read_height_field(placed("EPSG:32611", "500000, 30, 0, 4100000, 0, -30", feet))->info, "z is in ft"));
  const auto all_feet = read_height_field(placed("EPSG:2263", "500000, 30, 0, 200000, 0, -30", feet));
  ASSERT_TRUE(all_feet) << all_feet.error().message;
  EXPECT_TRUE(all_feet->info.warnings.empty());
  EXPECT_NEAR(all_feet->info.cell_x_m, 9.144, 1e-3);
  EXPECT_TRUE(warns(read_height_field(placed("", "10.5, 0.001, 0, 45, 0, -0.001"))->info, "look like degrees"));
}

}  // namespace
}  // namespace scarp::raster_frames_test
