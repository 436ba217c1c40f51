// The shared reference rasters against their table; skipped if the folder is missing.
#include <gtest/gtest.h>

#include <cmath>

#include "raster_files.h"

namespace scarp {
namespace {

struct Row {
  const char* file;
  int cols, rows;
  const char* type;
  double min, max;
  double nodata_percent;  ///< share of nodata samples
  Frame::Kind frame;
};

constexpr auto kGrid = Frame::Kind::kGrid;
constexpr auto kSource = Frame::Kind::kSource;
constexpr auto kLocal = Frame::Kind::kLocal;

constexpr Row kTable[] = {
    {"srtm3_sierra_nevada_basin_range.tif", 10801, 4801, "Int16", -85, 4404, 0, kLocal},
    {"moon_gld100_caucasus_4096.tif", 4096, 4096, "Int16", -4334, 3585, 0, kLocal},
    {"scape_ashby.stm", 346, 452, "UInt16", 113, 587, 0, kGrid},
    {"scape_crater.stm", 336, 459, "UInt16", 1533, 2478, 0, kGrid},
    {"scape_ozark.stm", 369, 462, "UInt16", 328, 437, 0, kGrid},
    {"scape_ntc.stm", 1024, 1024, "UInt16", 487, 1610, 0, kGrid},
    {"scape_westUS.stm", 1024, 1024, "UInt16", 1459, 3443, 0, kGrid},
    {"crater.pgm", 336, 459, "UInt16", 1533, 2478, 0, kGrid},
    {"crater.tif", 336, 459, "Int16", 1533, 2478, 0, kGrid},
    {"fuji.tif", 512, 512, "Float32", 13.7, 3751, 0, kGrid},
    {"SainteHelens.dem", 327, 468, "Int16", 682, 2543, 2.7, kSource},
    {"sainte_helens.tif", 327, 468, "Int16", 682, 2543, 2.7, kSource},
    {"jacksboro_fault.tif", 403, 344, "Int16", 236, 1076, 0, kLocal},
    {"bigtujunga30m.tif", 1197, 643, "Int16", 315, 2295, 0, kSource},
    {"volcano.tif", 87, 61, "Int16", 94, 195, 0, kGrid},
    {"puget_sound_1k.png", 1025, 1025, "UInt16", 0, 43798, 0, kGrid},
    {"egm84_geoid_3857.tif", 624, 510, "Float32", -107.232, 81.1875, 0, kSource},
    {"pyterra_dgm5.tif", 201, 401, "Float32", 513.42, 562.54, 0, kSource},
    {"N44W072.hgt", 1201, 1201, "Int16", 115, 1908, 0, kLocal},
    {"N27E086.hgt", 1201, 1201, "Int16", 192, 8840, 0, kLocal},
    {"N51W001.hgt.zip", 1201, 1201, "Int16", -30, 296, 100.0 * 28 / (1201 * 1201), kLocal},
    {"N51E000.hgt.zip", 1201, 1201, "Int16", -17, 274, 100.0 * 7 / (1201 * 1201), kLocal},
    {"N41E001.hgt.zip", 1201, 1201, "Int16", -20, 1204, 100.0 * 134 / (1201 * 1201), kLocal},
    {"N42E001.hgt.zip", 1201, 1201, "Int16", 349, 3100, 0.53, kLocal},
    {"korea_dem5m_34707052.tif", 482, 576, "Float32", -0.423159, 156.763, 0, kSource},
    {"everest_srtm_voids.tif", 1201, 1201, "Int16", 192, 8642, 9.1, kLocal},
    {"rainier_srtm_voids.tif", 1201, 1201, "Int16", 263, 4371, 0.63, kLocal},
    {"cape_town_srtm_sea_nodata.tif", 723, 1105, "Int16", -28, 1077, 39, kLocal},
    {"exploradores_aster.tif", 539, 618, "Float32", 317.71, 3959.9, 2.7, kSource},
    {"wahoo_swath_nan.tif", 1000, 800, "Float32", -4719, -4100, 51, kLocal},
    {"nrw_dom1_essen.tif", 1000, 1000, "Float32", 87.29, 167.74, 0, kSource},
    {"athens_dsm_1m.tif", 400, 400, "Float32", 108.961, 174.415, 0, kSource},
    {"cuyuna_pits_lidar_1m.tif", 400, 400, "Float32", 379.659, 410.759, 0, kSource},
    {"azores_bathymetry_1min.tif", 601, 451, "Float32", -5158.37, 1116.68, 0, kLocal},
    {"antarctica_bedmap.tif", 1333, 1333, "Int16", -6887, 4364, 21, kSource},
    {"mars_gale_hirise_1m.tif", 348, 337, "Float32", -4472.67, -4437.88, 0, kSource},
    {"tidal_marsh_zSW3.asc", 300, 452, "Float32", -2.60935, 8.46138, 26, kSource},
    {"bijou_gully_5m.asc", 105, 77, "Float32", 1673.07, 1729.86, 0, kSource},
};

TEST(RasterReference, TheTableHolds) {
  const std::string folder = testing::reference_folder();
  if (folder.empty()) GTEST_SKIP() << "the shared rasters are not here";
  ReadOptions options;
  options.default_frame = DefaultFrame::kMetric;
  for (const Row& row : kTable) {
    const auto read = read_height_field(folder + row.file, options);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->cols, row.cols) << row.file;
    EXPECT_EQ(read->rows, row.rows) << row.file;
    EXPECT_EQ(read->info.sample_type, row.type) << row.file;
    EXPECT_NEAR(read->info.min, row.min, std::abs(row.min) * 5e-6 + 1e-6) << row.file;
    EXPECT_NEAR(read->info.max, row.max, std::abs(row.max) * 5e-6 + 1e-6) << row.file;
    const double nodata_percent =
        100 - 100.0 * static_cast<double>(read->info.valid) / static_cast<double>(read->samples.size());
    EXPECT_NEAR(nodata_percent, row.nodata_percent, row.nodata_percent == 0 ? 0 : row.nodata_percent * 0.03 + 1e-9)
        << row.file;
    EXPECT_EQ(read->sample_rounding, 0) << row.file;
    EXPECT_EQ(read->frame.kind, row.frame) << row.file;
    if (row.frame != kSource) {
      EXPECT_TRUE(offsets_are_exact(read->frame, read->cols, read->rows)) << row.file;
    }
  }
}

TEST(RasterReference, TwoFormatsOneField) {
  const std::string folder = testing::reference_folder();
  if (folder.empty()) GTEST_SKIP() << "the shared rasters are not here";
  const auto samples = [&](const std::string& name, Decode decode = Decode::kNone) {
    ReadOptions options;
    options.decode = decode;
    return read_height_field(folder + name, options).value().samples;
  };
  EXPECT_EQ(samples("crater.pgm"), samples("crater.tif"));
  EXPECT_EQ(samples("crater.pgm"), samples("scape_crater.stm"));
  EXPECT_EQ(samples("terrarium_loaders.png", Decode::kTerrarium), samples("terrarium_loaders.tif"));
  EXPECT_EQ(samples("fuji.png", Decode::kMapbox), samples("fuji.tif"));
}

}  // namespace
}  // namespace scarp
