// Positions of rasters: frames, CRS options, their errors.
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
  for (const std::string crs : {"source", "EPSG:32611"}) EXPECT_EQ(read_error(path, in(crs)).kind, ErrorKind::kUsage);
  const auto local = read_height_field(path, in("local"));
  ASSERT_TRUE(local) << local.error().message;
  EXPECT_EQ(local->frame.affine, (std::array<double, 6>{-20, 1, 0, 15, 0, -1}));
}

TEST_F(RasterFrames, CellsHaveTheWidthThatWasGiven) {
  ReadOptions options;
  options.cell_size = 0.1;
  const auto read = read_height_field(scratch_.file("raw"), options);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->frame.kind, Frame::Kind::kLocal);
  EXPECT_NEAR(read->frame.affine[1], 0.1, 1e-7);
  EXPECT_EQ(read->frame.affine[5], -read->frame.affine[1]);
  EXPECT_EQ(frame_origin(read->frame, kCols, kRows), (std::array<double, 2>{0, 0}));
  EXPECT_TRUE(offsets_are_exact(read->frame, kCols, kRows));
  const auto place = place_in_source(read->frame, read->info, kRows);
  ASSERT_TRUE(place);
  EXPECT_EQ(place->origin(), (std::array<double, 2>{20, 14}));  // like grid_frame()
  EXPECT_NEAR(place->to_source[1], 10, 1e-5);
  EXPECT_TRUE(place->crs.empty());

  const std::string path = placed("EPSG:32611", "500000, 30, 0, 4100000, 0, -30");
  const Error error = read_error(path, options);
  EXPECT_EQ(error.kind, ErrorKind::kUsage);
  EXPECT_TRUE(contains(error.message, "has a georeference")) << error.message;
  options.crs = "grid";
  options.cell_size = 8;
  const auto cells = read_height_field(path, options);
  ASSERT_TRUE(cells) << cells.error().message;
  EXPECT_EQ(cells->frame.affine, (std::array<double, 6>{-160, 8, 0, 120, 0, -8}));
  for (const double size : {0.0, -1.0, 1e-300, 1e300}) {
    options.cell_size = size;
    EXPECT_EQ(read_error(path, options).kind, ErrorKind::kUsage) << size;
  }
}

TEST_F(RasterFrames, DefaultsFollowWhatReadsTheFile) {
  const std::string projected = placed("EPSG:32611", "500000, 30, 0, 4100000, 0, -30");
  ReadOptions options;
  EXPECT_EQ(read_height_field(projected, options)->frame.affine, (std::array<double, 6>{-600, 30, 0, 450, 0, -30}));
  for (const DefaultFrame frame : {DefaultFrame::kMetric, DefaultFrame::kSource}) {
    options.default_frame = frame;
    EXPECT_EQ(read_height_field(projected, options)->frame.kind, Frame::Kind::kSource);
  }
  const std::string degrees = placed("EPSG:4326", "9.98, 0.001, 0, 45.0155, 0, -0.001");
  EXPECT_EQ(read_height_field(degrees, options)->frame.kind, Frame::Kind::kSource);
  for (const DefaultFrame frame : {DefaultFrame::kMetric, DefaultFrame::kLocal}) {
    options.default_frame = frame;
    EXPECT_EQ(read_height_field(degrees, options)->frame.kind, Frame::Kind::kLocal);
  }
  const auto nowhere = read_height_field(placed("", "100, 2, 0, 50, 0, -2"));
  ASSERT_TRUE(nowhere) << nowhere.error().message;
  EXPECT_EQ(nowhere->frame.affine, (std::array<double, 6>{-40, 2, 0, 30, 0, -2}));
  EXPECT_TRUE(contains(nowhere->frame.description, "local units")) << nowhere->frame.description;
}

TEST_F(RasterFrames, TellTheWayBackToTheSource) {
  for (const std::string geotransform : {"500000, 30, 0, 4100000, 0, -30", "500000, 8.1, 4, 4100000, 4, -8.3"}) {
    const auto read = read_height_field(placed("EPSG:32611", geotransform));
    ASSERT_TRUE(read) << read.error().message;
    const auto place = place_in_source(read->frame, read->info, kRows);
    ASSERT_TRUE(place);
    EXPECT_EQ(place->crs, "EPSG:32611");
    const Frame source = read_height_field(placed("EPSG:32611", geotransform), in("source"))->frame;
    for (const auto& [col, row] : {std::pair{0.0, 0.0}, {40.0, 0.0}, {13.5, 29.0}}) {
      const auto [x, y] = read->frame.apply_affine(col, row);
      const auto& t = place->to_source;
      const auto there = source.apply_affine(col, row);
      EXPECT_NEAR(t[0] + t[1] * x + t[2] * y, there[0], 1e-8);
      EXPECT_NEAR(t[3] + t[4] * x + t[5] * y, there[1], 1e-8);
    }
    EXPECT_EQ(place_in_source(source, read->info, kRows)->to_source, (std::array<double, 6>{0, 1, 0, 0, 0, 1}));
  }
  const auto bent = read_height_field(placed("EPSG:4326", "9.98, 0.001, 0, 45.0155, 0, -0.001"), in("32632"));
  ASSERT_TRUE(bent) << bent.error().message;
  EXPECT_EQ(bent->frame.crs, "EPSG:32632");
  EXPECT_FALSE(place_in_source(bent->frame, bent->info, kRows));
}

TEST_F(RasterFrames, HeightsAreScaled) {
  const std::string path = placed("EPSG:32611", "500000, 30, 0, 4100000, 0, -30",
                                  "<UnitType>ft</UnitType><NoDataValue>7</NoDataValue><Scale>2</Scale>");
  ReadOptions options;
  options.z_scale = 0.3048;
  options.z_offset = 100;
  const auto whole = read_height_field(path, options);
  ASSERT_TRUE(whole) << whole.error().message;
  EXPECT_TRUE(std::isnan(whole->samples[7])) << "nodata is the file's value";
  EXPECT_EQ(whole->samples[8], static_cast<float>(8 * (2 * 0.3048) + 100));
  EXPECT_GT(whole->sample_rounding, 0);
  EXPECT_EQ(whole->info.max, whole->samples.back());
  EXPECT_EQ(whole->info.unit, "m");
  EXPECT_FALSE(warns(whole->info, "z is in")) << "feet have become metres";
  options.run.memory.limit = 100;
  const auto streamed = open_height_field(path, options);
  ASSERT_TRUE(streamed) << streamed.error().message;
  ASSERT_TRUE(streamed->source);
  std::vector<float> samples(whole->samples.size());
  ASSERT_TRUE(streamed->source->read(0, 0, kCols, kRows, samples.data(), kCols));
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (k != 7) {
      EXPECT_EQ(samples[k], whole->samples[k]);
    }
  }
  EXPECT_EQ(streamed->sample_rounding, whole->sample_rounding);
  options.run.memory.limit = 0;
  options.z_scale = 3;
  EXPECT_TRUE(read_height_field(path, options)->info.unit.empty()) << "nobody knows it";

  testing::write_text(scratch_.file("dem.pgm"), "P2 2 2 255\n1 2 3 4\n");
  options.z_scale = -0.1;
  options.nodata = 3;
  const auto pgm = read_height_field(scratch_.file("dem.pgm"), options);
  ASSERT_TRUE(pgm) << pgm.error().message;
  EXPECT_EQ(pgm->samples[0], static_cast<float>(99.9));
  EXPECT_TRUE(std::isnan(pgm->samples[2]));
  EXPECT_EQ(pgm->info.z_scale, -0.1);
}

TEST_F(RasterFrames, ProjectedKeepsItsCoordinates) {
  const std::string path = placed("EPSG:32611", "500000, 30, 0, 4100000, 0, -30");
  for (const std::string crs : {"source", "EPSG:32611", "32611", "+proj=utm +zone=11 +datum=WGS84"}) {
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
  const auto turned = read_height_field(placed("EPSG:32611", "500000, 8, 4, 4100000, 4, -8"), in("source"));
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

TEST_F(RasterFrames, EarthCentredThroughProj) {
  const std::string path = placed("EPSG:4326", "9.98, 0.001, 0, 45.0155, 0, -0.001");
  const auto read = read_height_field(path, in("EPSG:4978"));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->frame.kind, Frame::Kind::kGeocentric);
  EXPECT_EQ(read->frame.crs, "EPSG:4978");
  EXPECT_FALSE(read->frame.is_affine());
  EXPECT_TRUE(warns(read->info, "ellipsoid"));
  ASSERT_NE(read->frame.space, nullptr);
  std::vector<double> x{0, 90, 0, 30}, y{0, 0, 90, 45}, z{0, 100, 0, 1000};
  ASSERT_TRUE(read->frame.space->to_space(x, y, z));
  EXPECT_NEAR(x[0], 6378137, 1e-6);
  EXPECT_NEAR(y[1], 6378237, 1e-6);
  EXPECT_NEAR(z[2], 6356752.3142, 1e-4);
  EXPECT_NEAR(std::hypot(x[3], y[3]), 4518297.9857, 1e-3) << "(N + h) cos 45";
  ASSERT_TRUE(read->frame.space->from_space(x, y, z));
  EXPECT_NEAR(x[3], 30, 1e-11);
  EXPECT_NEAR(y[3], 45, 1e-11);
  EXPECT_NEAR(z[3], 1000, 1e-6);
  for (const double coordinate : read->frame.space->origin()) EXPECT_EQ(coordinate, std::floor(coordinate));
  EXPECT_FALSE(place_in_source(read->frame, read->info, read->rows));
}

TEST_F(RasterFrames, EastNorthUpOfTheCentre) {
  const std::string path = placed("EPSG:4326", "9.98, 0.001, 0, 45.0155, 0, -0.001");
  const auto read = read_height_field(path, in("enu"));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->frame.kind, Frame::Kind::kTangent);
  EXPECT_EQ(read->frame.crs, "");
  const auto [lon, lat] = read->frame.apply_affine(kCols / 2, kRows / 2);
  std::vector<double> x{lon, lon, lon + 0.001, lon}, y{lat, lat, lat, lat + 0.001}, z{0, 250, 0, 0};
  ASSERT_TRUE(read->frame.space->to_space(x, y, z));
  EXPECT_NEAR(std::hypot(x[0], y[0], z[0]), 0, 1e-8);
  EXPECT_NEAR(z[1], 250, 1e-8);
  EXPECT_NEAR(x[2], 78.85, 0.05) << "east";
  EXPECT_NEAR(y[3], 111.13, 0.05) << "north";
  EXPECT_NEAR(z[3], -111.13 * 111.13 / 2 / 6371000, 1e-5) << "below the tangent plane";
  const auto m = read->frame.space->to_earth();
  std::vector<double> u{lon}, v{lat}, h{250};
  const auto earth = read_height_field(path, in("EPSG:4978"));
  ASSERT_TRUE(earth->frame.space->to_space(u, v, h));
  EXPECT_NEAR(m[0] * x[1] + m[1] * y[1] + m[2] * z[1] + m[3], u[0], 1e-6);
  EXPECT_NEAR(m[4] * x[1] + m[5] * y[1] + m[6] * z[1] + m[7], v[0], 1e-6);
  EXPECT_NEAR(m[8] * x[1] + m[9] * y[1] + m[10] * z[1] + m[11], h[0], 1e-6);
}

TEST_F(RasterFrames, LongitudesComeBackAsTheRasterHasThem) {
  // Across the 180th meridian, and from 0 to 360.
  for (const std::string west : {"179.985", "269.985"}) {
    const auto read = read_height_field(placed("EPSG:4326", west + ", 0.001, 0, -16, 0, -0.001"), in("EPSG:4978"));
    ASSERT_TRUE(read) << read.error().message;
    const auto at = read->frame.apply_affine(kCols - 1, 0);
    std::vector<double> x{at[0]}, y{at[1]}, z{5};
    ASSERT_TRUE(read->frame.space->to_space(x, y, z));
    ASSERT_TRUE(read->frame.space->from_space(x, y, z));
    EXPECT_NEAR(x[0], at[0], 1e-9);
  }
}

TEST_F(RasterFrames, WhatIsTooLargeForSpaceIsRefused) {
  for (const auto& [place, words] : {std::pair{"-180, 9, 0, 90, 0, -6", "60 degrees"},
                                     std::pair{"-180, 9, 0, 90, 0, -0.1", "more than half around the earth"}}) {
    const auto read = read_height_field(placed("EPSG:4326", place), in("enu"));
    ASSERT_FALSE(read) << place;
    EXPECT_EQ(read.error().kind, ErrorKind::kUsage);
    EXPECT_NE(read.error().message.find(words), std::string::npos) << read.error().message;
  }
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
  const auto local = read_height_field(placed("EPSG:4326", "9.98, 0.001, 0, 45.0155, 0, -0.001", feet));
  ASSERT_TRUE(local) << local.error().message;
  EXPECT_TRUE(warns(local->info, "heights in ft become metres"));
  EXPECT_EQ(local->info.unit, "m");
  EXPECT_EQ(local->info.file_unit, "ft");
  EXPECT_TRUE(warns(read_height_field(placed("EPSG:32611", "500000, 30, 0, 4100000, 0, -30", feet), in("source"))->info,
                    "z is in ft"));
  const auto all_feet = read_height_field(placed("EPSG:2263", "500000, 30, 0, 200000, 0, -30", feet), in("source"));
  ASSERT_TRUE(all_feet) << all_feet.error().message;
  EXPECT_TRUE(all_feet->info.warnings.empty());
  EXPECT_NEAR(all_feet->info.cell_x_m, 9.144, 1e-3);
  EXPECT_TRUE(warns(read_height_field(placed("", "10.5, 0.001, 0, 45, 0, -0.001"))->info, "look like degrees"));
}

}  // namespace
}  // namespace scarp::raster_frames_test
