// Invalid input: one clear message each.
#include <gtest/gtest.h>

#include <thread>

#include "raster_files.h"

namespace scarp {
namespace {

using testing::contains;
using testing::read_error;
using testing::ScratchFolder;

TEST(RasterErrors, OneSentenceEach) {
  const ScratchFolder scratch;
  const auto expect = [&](const std::string& name, const std::string& part) {
    const Error error = read_error(scratch.file(name));
    EXPECT_EQ(error.kind, ErrorKind::kInput);
    EXPECT_TRUE(contains(error.message, part)) << error.message;
  };
  expect("missing.tif", "no such file");
  expect("", "the folder holds no raster");
  testing::write_text(scratch.file("empty.tif"), "");
  expect("empty.tif", "empty");
  testing::write_text(scratch.file("notes.txt"), "not a raster\n");
  expect("notes.txt", "not a raster");
  testing::write_text(scratch.file("points.geojson"),
                      R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{},"geometry":)"
                      R"({"type":"Point","coordinates":[1,2]}}]})");
  expect("points.geojson", "holds vector data (GeoJSON)");
  testing::write_envi<std::int16_t>(scratch.file("row"), 9, 1, std::vector<std::int16_t>(9, 1));
  expect("row", "9 x 1");
  testing::write_envi<std::int16_t>(scratch.file("column"), 1, 9, std::vector<std::int16_t>(9, 1));
  expect("column", "1 x 9");
  testing::write_envi<float>(scratch.file("void"), 2, 2, {5, 5, 5, 5}, "data ignore value = 5\n");
  expect("void", "all are nodata");
  testing::write_text(scratch.file("zero.vrt"), "<VRTDataset rasterXSize=\"0\" rasterYSize=\"0\"></VRTDataset>");
  expect("zero.vrt", "zero.vrt");
  testing::write_vrt(scratch.file("complex.vrt"), "void", 2, 2, "CFloat32", "", "");
  expect("complex.vrt", "complex numbers (CFloat32)");
  const Error error = read_height_field("").error();
  EXPECT_EQ(error.kind, ErrorKind::kInput);
}

TEST(RasterErrors, AnImpossibleSizeIsRefusedWithTheFigure) {
  const ScratchFolder scratch;
  testing::write_envi<float>(scratch.file("raw"), 2, 2, {1, 2, 3, 4});
  testing::write_vrt(scratch.file("huge.vrt"), "raw", 2000000000, 2000000000, "Float32", "", "");
  const Error error = read_error(scratch.file("huge.vrt"));
  EXPECT_EQ(error.kind, ErrorKind::kInput);
  EXPECT_TRUE(contains(error.message, "need 17.3 EiB of memory")) << error.message;

  ReadOptions options;
  options.run.memory.limit = 19;
  EXPECT_TRUE(contains(read_error(scratch.file("raw"), options).message, "are allowed"));
  options.run.memory.limit = 20;
  EXPECT_TRUE(read_height_field(scratch.file("raw"), options));
  EXPECT_EQ(max_samples(500), 100u);
  EXPECT_GT(max_samples(0), 1000u);
}

TEST(RasterErrors, TheCallbackCancels) {
  const ScratchFolder scratch;
  std::vector<float> samples(3000 * 3000, 1);
  testing::write_envi<float>(scratch.file("dem"), 3000, 3000, samples);
  ReadOptions options;
  double last = 0;
  options.run.progress = [&](const Progress& progress) {
    EXPECT_EQ(progress.pass, "read");
    EXPECT_GE(progress.fraction, last);
    EXPECT_LE(progress.fraction, 1);
    last = progress.fraction;
    return false;
  };
  const auto read = read_height_field(scratch.file("dem"), options);
  // If the machine reads everything in a tenth of a second, progress is never reported.
  if (last > 0) {
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().kind, ErrorKind::kCancelled);
  } else {
    EXPECT_TRUE(read);
  }
}

TEST(RasterErrors, NothingIsPrinted) {
  const ScratchFolder scratch;
  testing::write_text(scratch.file("cut.tif"), std::string("II*\0\x08\0\0\0", 8));
  ::testing::internal::CaptureStderr();
  ::testing::internal::CaptureStdout();
  read_error(scratch.file("cut.tif"));
  read_error(scratch.file("none.tif"));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
}

}  // namespace
}  // namespace scarp
