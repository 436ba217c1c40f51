// The guarantee on real terrain, for every open raster that is small enough to judge sample by sample.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "../../bench/harness.h"
#include "scarp/scarp.h"
#include "source_dir.h"

// After scarp/io.h: Decode::kNone would shadow kNone.
#include "fit/fit.h"
#include "grid/samples.h"
#include "laws/fit_meshes.h"
#include "laws/mesh_laws.h"
#include "laws/sanitized.h"
#include "laws/tile_meshes.h"
#include "metric/height_metric.h"
#include "pieces/release.h"
#include "pieces/tiled.h"

namespace scarp::real_rasters_test {
namespace {

/// Keeps every `stride`th sample of every `stride`th row.
void thin_out(OwnedHeightField& field, int stride) {
  std::vector<float> samples;
  for (int row = 0; row < field.rows; row += stride) {
    for (int col = 0; col < field.cols; col += stride)
      samples.push_back(field.samples[static_cast<std::size_t>(row) * static_cast<std::size_t>(field.cols) +
                                      static_cast<std::size_t>(col)]);
  }
  field.samples = std::move(samples);
  field.cols = (field.cols + stride - 1) / stride;
  field.rows = (field.rows + stride - 1) / stride;
}

/// Sanitized builds use at most this many samples a side, of the whole raster.
constexpr int kSanitizedSide = 150;

class RealRasters : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const auto path = bench::find_raster(source_dir(), GetParam());
    if (!path) GTEST_SKIP() << GetParam() << " is not in ../shared/data";
    auto read = read_height_field(*path);
    ASSERT_TRUE(read) << read.error().message;
    field_ = std::move(*read);
    if (testing::kIsSanitized)
      thin_out(field_, (std::max(field_.cols, field_.rows) + kSanitizedSide - 1) / kSanitizedSide);
    auto samples = grid::Samples::of(field_);
    ASSERT_TRUE(samples) << samples.error().message;
    samples_.emplace(std::move(*samples));
    float low = INFINITY, high = -INFINITY;
    const grid::Raster raster = samples_->raster();
    for (std::int32_t y = 0; y < raster.rows; ++y) {
      for (std::int32_t x = 0; x < raster.cols; ++x) {
        if (!raster.is_valid({x, y})) continue;
        low = std::min(low, raster.at({x, y}));
        high = std::max(high, raster.at({x, y}));
      }
    }
    relief_ = double{high} - low;
  }

  OwnedHeightField field_;
  std::optional<grid::Samples> samples_;
  double relief_ = 0;
};

TEST_P(RealRasters, KeepTheBoundInExactArithmeticWithAnyTiles) {
  const grid::Raster raster = samples_->raster();
  const auto domain = refine::build_domain(raster, 0, Frame{});
  ASSERT_TRUE(domain) << domain.error().message;
  for (const auto& [share, side] : {std::pair{0.003, 100}, {0.03, 256}, {0.03, 0}}) {
    const double threshold = share * relief_;
    auto tiled = pieces::refine_tiled(field_, {.threshold = threshold, .threads = 2, .tile_side = side});
    ASSERT_TRUE(tiled && *tiled);
    tin::Triangulation& tin = (*tiled)->domain.tin;
    const metric::HeightMetric metric(raster, threshold);
    pieces::release_seams(tin, metric, std::move((*tiled)->seams));
    EXPECT_EQ(testing::verify_triangulation(tin, raster.cols, raster.rows, testing::Edges::kAny), "");
    EXPECT_EQ(testing::find_broken_bound(raster, tin, threshold), "");
    EXPECT_EQ(testing::outside_area2(tin), testing::outside_area2(domain->tin));
  }
}

TEST_P(RealRasters, KeepTheBoundInExactArithmeticWithFewerVertices) {
  const grid::Raster raster = samples_->raster();
  for (const double share : {0.003, 0.03}) {
    const double threshold = share * relief_;
    auto tiled = pieces::refine_tiled(field_, {.threshold = threshold, .threads = 2});
    ASSERT_TRUE(tiled && *tiled);
    const tin::Triangulation& tin = (*tiled)->domain.tin;
    const std::int64_t outside = testing::outside_area2(tin);
    const std::size_t vertices = tin.vertex_count();
    const fit::Fitted fitted =
        *fit::fit(raster, std::move((*tiled)->domain.tin), {.threshold = threshold, .threads = 2});
    EXPECT_EQ(testing::verify_triangulation(fitted.tin, raster.cols, raster.rows, testing::Edges::kAny), "");
    EXPECT_EQ(testing::find_broken_bound(raster, fitted.tin, threshold), "");
    EXPECT_EQ(testing::outside_area2(fitted.tin), outside);
    EXPECT_EQ(fitted.tin.vertex_count() + fitted.counts.removed, vertices);
    EXPECT_LT(fitted.tin.vertex_count(), vertices);
  }
}

TEST_P(RealRasters, AreRepairedWithinTheBoundWhateverTheFreedom) {
  const grid::Raster raster = samples_->raster();
  const double threshold = 0.02 * relief_;
  const fit::FitOptions on_samples{.threshold = threshold, .threads = 2, .depth = {.rounds = 2}};
  fit::FitOptions free = on_samples;
  free.vertices_are_free = true;
  const auto refined = [&] {
    auto domain = refine::build_domain(raster, 0, field_.frame);
    const metric::HeightMetric metric(raster, threshold);
    refine::Refinement refinement(metric, domain->tin);
    while (!refinement.done()) refinement.insert_worst();
    return std::move(domain->tin);
  };
  const fit::Fitted repaired = *fit::fit(raster, refined(), on_samples), freed = *fit::fit(raster, refined(), free);
  EXPECT_EQ(testing::verify_triangulation(repaired.tin, raster.cols, raster.rows, testing::Edges::kAny), "");
  EXPECT_EQ(testing::find_broken_bound(raster, repaired.tin, threshold), "");
  EXPECT_EQ(testing::verify_triangulation(freed.tin, testing::in_steps(raster.cols), testing::in_steps(raster.rows),
                                          testing::Edges::kAny),
            "");
  EXPECT_EQ(testing::find_broken_bound(raster, freed, threshold), "");
  EXPECT_LT(freed.tin.vertex_count(), repaired.tin.vertex_count());
}

TEST_P(RealRasters, KeepThePromiseAtThePublicDoorWhateverTheThreads) {
  const double goal = 0.01 * relief_ + field_.sample_rounding;
  SimplifyOptions options{.goals = {.max_error = goal}};
  options.quality.order = Order::kDominant;
  options.output.float32_positions = false;
  options.run.threads = 1;
  const auto one = simplify(field_, options);
  ASSERT_TRUE(one) << one.error().message;
  EXPECT_EQ(one->order, Order::kDominant);
  EXPECT_LE(one->measurement.max_error, goal);
  EXPECT_EQ(one->measurement.uncovered, 0u);
  options.run.threads = 3;
  const auto three = simplify(field_, options);
  ASSERT_TRUE(three) << three.error().message;
  EXPECT_EQ(one->mesh.positions, three->mesh.positions);
  EXPECT_EQ(one->mesh.triangles, three->mesh.triangles);
}

INSTANTIATE_TEST_SUITE_P(
    Open, RealRasters,
    ::testing::Values("jacksboro_fault.tif", "athens_dem_1m.tif", "athens_dsm_1m.tif", "baltoro_srtm.tif",
                      "bijou_gully_5m.asc", "cape_town_srtm_sea_nodata.tif", "crater.tif", "cuyuna_pits_lidar_1m.tif",
                      "egm84_geoid_3857.tif", "everest_srtm_voids.tif", "grenoble_copernicus.tif",
                      "korea_dem5m_34707051.tif", "korea_dem5m_34707052.tif", "korea_dem5m_34707053.tif",
                      "lisbon_30m.tif", "mars_gale_hirise_1m.tif", "pyterra_dgm5.tif", "rainier_srtm_voids.tif",
                      "sainte_helens.tif", "scape_ashby.stm", "scape_crater.stm", "scape_ozark.stm",
                      "sierra_de_bejar_25m.tif", "terrarium_loaders.tif", "tidal_marsh_zSW3.asc", "volcano.tif",
                      "wahoo_swath_nan.tif"),
    [](const auto& raster) {
      std::string name = raster.param;
      std::replace_if(
          name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
      return name;
    });

}  // namespace
}  // namespace scarp::real_rasters_test
