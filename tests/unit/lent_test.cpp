// A lent raster is read by name like a file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "io/lend.h"
#include "scarp/height_field.h"
#include "scarp/io.h"

namespace scarp::lent_test {
namespace {

struct Lender {
  std::vector<float> samples{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  io::LentRaster raster;

  Lender() {
    raster.samples = samples.data();
    raster.cols = 4;
    raster.rows = 3;
  }
};

TEST(Lent, SamplesAreReadWithoutACopyWhileTheyAreLent) {
  Lender lender;
  {
    const io::Lent lent("hills.pgm", lender.raster);
    const auto field = read_height_field("hills.pgm");
    ASSERT_TRUE(field);
    EXPECT_EQ(field->view().samples, lender.samples.data());
    EXPECT_TRUE(field->samples.empty());
    EXPECT_EQ(field->info.valid, 12u);
    EXPECT_EQ(field->info.max, 12);
    EXPECT_EQ(field->frame.affine, grid_frame(3).affine);
  }
  EXPECT_EQ(read_height_field("hills.pgm").error().kind, ErrorKind::kInput);
}

TEST(Lent, WhatWasLentLastCounts) {
  Lender first, second;
  second.samples[0] = 100;
  const io::Lent below("a", first.raster);
  {
    const io::Lent above("a", second.raster);
    EXPECT_EQ(read_height_field("a")->info.max, 100);
  }
  EXPECT_EQ(read_height_field("a")->info.max, 12);
}

TEST(Lent, SamplesThatAreNoHeightsCostOneCopy) {
  Lender lender;
  lender.samples[5] = std::numeric_limits<float>::infinity();
  lender.raster.nodata = 3.0f;
  const io::Lent lent("a", lender.raster);
  const auto field = read_height_field("a");
  ASSERT_TRUE(field);
  EXPECT_EQ(field->lent, nullptr);
  EXPECT_TRUE(std::isnan(field->samples[2]) && std::isnan(field->samples[5]));
  EXPECT_EQ(field->info.valid, 10u);
  EXPECT_EQ(lender.samples[2], 3);
  EXPECT_THAT(field->info.warnings, ::testing::ElementsAre(::testing::HasSubstr("infinite")));
}

TEST(Lent, WhoeverChangesSamplesOwnsThemFirst) {
  Lender lender;
  const io::Lent lent("a", lender.raster);
  auto field = read_height_field("a");
  ASSERT_TRUE(field);
  apply_edits({{1, 1, 6, 60}}, *field);
  EXPECT_EQ(field->samples[5], 60);
  EXPECT_EQ(lender.samples[5], 6);
  lender.samples[0] = std::numeric_limits<float>::quiet_NaN();
  field = read_height_field("a");
  EXPECT_EQ(fill_background(*field, 7), 1u);
  EXPECT_EQ(field->samples[0], 7);
  EXPECT_TRUE(std::isnan(lender.samples[0]));
}

TEST(Lent, DegreesBecomeMetres) {
  Lender lender;
  lender.raster.geotransform = {8, 1.0 / 3600, 0, 46, 0, -1.0 / 3600};
  lender.raster.is_geographic = true;
  const io::Lent lent("a", lender.raster);
  const auto local = read_height_field("a", {.default_frame = DefaultFrame::kMetric});
  ASSERT_TRUE(local);
  EXPECT_EQ(local->frame.kind, Frame::Kind::kLocal);
  EXPECT_NEAR(local->frame.affine[1], 21.5, 0.2);
  EXPECT_NEAR(local->frame.affine[5], -30.87, 0.05);
  const auto source = read_height_field("a", {.crs = "source"});
  ASSERT_TRUE(source);
  EXPECT_EQ(source->frame.affine[0], 8 + 1.0 / 3600 / 2);
}

TEST(Lent, WhatCannotBeReadIsRefusedInOneSentence) {
  Lender lender;
  const auto sentence = [&](const ReadOptions& options = {}) {
    const io::Lent lent("heights", lender.raster);
    const auto field = read_height_field("heights", options);
    return field ? std::string() : field.error().message;
  };
  EXPECT_THAT(sentence({.band = 2}), ::testing::HasSubstr("heights has 1 band"));
  EXPECT_THAT(sentence({.crs = "source"}), ::testing::HasSubstr("no georeference"));
  lender.raster.geotransform = {0, 0, 0, 0, 0, 0};
  EXPECT_THAT(sentence(), ::testing::HasSubstr("to a line"));
  lender.raster.geotransform.reset();
  lender.raster.rows = 1;
  EXPECT_THAT(sentence(), ::testing::HasSubstr("at least 2 x 2"));
  lender.raster.rows = 3;
  lender.raster.samples = nullptr;
  EXPECT_THAT(sentence(), ::testing::HasSubstr("null"));
}

TEST(Lent, MeshesAndPointsToo) {
  Mesh mesh;
  mesh.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  mesh.triangles = {0, 1, 2};
  PointSet points;
  points.x = points.y = points.z = {1, 2, 3};
  const io::Lent lent_mesh("thing", mesh);
  const io::Lent lent_points("thing", points);
  EXPECT_EQ(read_mesh("thing")->triangles, mesh.triangles);
  EXPECT_EQ(read_points("thing")->x, points.x);
}

}  // namespace
}  // namespace scarp::lent_test
