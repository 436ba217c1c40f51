// Laws of tiles and the samples of their source: claims about samples hold at each sample's own place.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <tuple>
#include <vector>

#include "laws/sanitized.h"
#include "scarp/tile.h"

namespace scarp::tile_source_laws_test {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

/// x shrinks with the distance from the equator, as in many projections.
double squeeze(double latitude) { return 1 + latitude * latitude / 8100; }

class Squeeze final : public PointTransform {
 public:
  explicit Squeeze(bool to_degrees) : to_degrees_(to_degrees) {}
  bool apply(std::span<double> x, std::span<double> y) const override {
    for (std::size_t k = 0; k < x.size(); ++k) x[k] = to_degrees_ ? x[k] * squeeze(y[k]) : x[k] / squeeze(y[k]);
    return true;
  }

 private:
  bool to_degrees_;
};

/// A plane.
class Slope final : public HeightZero {
 public:
  static double at(double longitude, double latitude) { return 20 + longitude / 4 - latitude / 2; }
  void find(std::span<const double> longitudes, std::span<const double> latitudes,
            std::span<double> heights) const override {
    for (std::size_t k = 0; k < heights.size(); ++k) heights[k] = at(longitudes[k], latitudes[k]);
  }
};

/// A raster of steep noise with voids, in degrees or squeezed, straight or rotated.
struct Land {
  int cols = 0, rows = 0;
  std::vector<float> samples;
  RasterPlace place;
  bool is_raised = false;
  std::unique_ptr<NodeSource> plain, raised;

  Land(std::uint32_t seed, double west, double cell, bool is_squeezed, bool is_turned, bool has_voids, bool raises)
      : cols(90), rows(70), is_raised(raises) {
    std::uint32_t state = seed | 1;
    const auto random = [&] { return (state = state * 1664525u + 1013904223u) >> 8; };
    for (int k = 0; k < cols * rows; ++k) {
      const double wave = 800 * std::sin(k % cols * 0.2) * std::cos(k / cols * 0.13);
      samples.push_back(has_voids && random() % 60 == 0 ? kNone : static_cast<float>(wave + random() % 200));
    }
    const double slant = is_turned ? cell / 5 : 0;
    place.affine = {west, cell, slant, 48, slant / 2, -0.9 * cell};
    if (is_squeezed) {
      place.from_degrees = std::make_shared<Squeeze>(false);
      place.to_degrees = std::make_shared<Squeeze>(true);
    }
    plain = *make_node_source(field(), place);
    if (raises) raised = make_raised_source(*plain, std::make_shared<Slope>());
  }
  HeightField field() const {
    HeightField field;
    field.samples = samples.data();
    field.cols = cols;
    field.rows = rows;
    return field;
  }
  const NodeSource& source() const { return raised ? *raised : *plain; }
};

/// The largest error at samples that count, by brute force: every sample against every triangle.
double brute_force(const TerrainTile& tile, std::int32_t steps, const Land& land) {
  const TileGrid grid;
  const DegreeBox box = grid.bounds_of(tile.id);
  const NodeWindow window = grid.window_of(tile.id, steps);
  std::vector<float> nodes(static_cast<std::size_t>(window.cols) * static_cast<std::size_t>(window.rows));
  EXPECT_TRUE(land.source().read(window, nodes));
  double worst = 0;
  for (int row = 0; row < land.rows; ++row) {
    for (int col = 0; col < land.cols; ++col) {
      const float sample = land.samples[static_cast<std::size_t>(row * land.cols + col)];
      const std::array<double, 6>& a = land.place.affine;
      double x = a[0] + a[1] * col + a[2] * row, y = a[3] + a[4] * col + a[5] * row;
      if (land.place.to_degrees) land.place.to_degrees->apply({&x, 1}, {&y, 1});
      while (x > box.east) x -= 360;
      while (x < box.west) x += 360;
      if (std::isnan(sample) || x > box.east || y < box.south || y > box.north) continue;
      const double height = double{sample} + (land.is_raised ? Slope::at(x, y) : 0);
      const double u = 32767 * (x - box.west) / (box.east - box.west),
                   v = 32767 * (y - box.south) / (box.north - box.south);
      const auto i = std::min(static_cast<int>(u / 32767 * steps), steps - 1),
                 j = std::min(static_cast<int>((1 - v / 32767) * steps), steps - 1);
      bool counts = true;
      for (const int k :
           {j * (steps + 1) + i, j * (steps + 1) + i + 1, (j + 1) * (steps + 1) + i, (j + 1) * (steps + 1) + i + 1})
        counts = counts && !std::isnan(nodes[static_cast<std::size_t>(k)]);
      if (!counts) continue;
      for (std::size_t k = 0; k < tile.triangles.size(); k += 3) {
        const std::uint32_t p = tile.triangles[k], q = tile.triangles[k + 1], r = tile.triangles[k + 2];
        const double px = tile.u[p], py = tile.v[p], qx = tile.u[q] - px, qy = tile.v[q] - py, rx = tile.u[r] - px,
                     ry = tile.v[r] - py, area = qx * ry - rx * qy;
        const double b = ((u - px) * ry - rx * (v - py)) / area, c = (qx * (v - py) - (u - px) * qy) / area;
        if (b < -1e-9 || c < -1e-9 || b + c > 1 + 1e-9) continue;
        const double mesh = tile.quantum * (tile.heights[p] + b * (tile.heights[q] - tile.heights[p]) +
                                            c * (tile.heights[r] - tile.heights[p]));
        worst = std::max(worst, std::abs(mesh - height));
        break;
      }
    }
  }
  return worst;
}

PyramidPlan plan_of(int finest, Effort effort) {
  PyramidSettings settings;
  settings.cells = 16;
  settings.max_zoom = finest;
  settings.effort = effort;
  settings.max_error = 60;
  const SourceFacts facts{{-180, -90, 180, 90}, 1, -1000, 1200};
  return *plan_pyramid(facts, settings);
}

/// Next to cliffs, rounding of a place changes a height; interpolation between exact places also does.
double allowance(bool is_squeezed) { return is_squeezed ? 1.0 : 1e-3; }

TEST(tile_source_laws, samples_that_are_bound_are_nearer_and_land_that_nodes_can_follow_keeps_the_max_error) {
  const Land rough(7, 10.013, 0.0137, false, false, false, false);
  Land smooth(7, 10.013, 0.0137, false, true, false, true);
  for (int k = 0; k < smooth.cols * smooth.rows; ++k)
    smooth.samples[static_cast<std::size_t>(k)] =
        static_cast<float>(800 * std::sin(k % smooth.cols * 0.2) * std::cos(k / smooth.cols * 0.13));
  for (const Land* land : {static_cast<const Land*>(&rough), static_cast<const Land*>(&smooth)}) {
    PyramidPlan plan = plan_of(11, Effort::kNormal);
    const TileId id{10, static_cast<std::uint32_t>((10.5 + 180) / 180 * 1024),
                    static_cast<std::uint32_t>((47.6 + 90) / 180 * 1024)};
    const auto free = make_tile(plan, id, land->source());
    plan.binds_samples = true;
    const auto bound = make_tile(plan, id, land->source());
    ASSERT_TRUE(free && bound);
    EXPECT_LE(bound->source_error, free->source_error);
    EXPECT_LE(bound->node_error, bound->max_error);
    EXPECT_NEAR(brute_force(*bound, 32, *land), bound->source_error, allowance(false));
    if (land == &smooth) {
      EXPECT_LE(bound->source_error, bound->max_error);
    }
  }
}

RC_GTEST_PROP(tile_source_laws, the_source_error_is_that_of_all_samples_at_their_places, ()) {
  const bool is_squeezed = *rc::gen::arbitrary<bool>(), is_turned = *rc::gen::arbitrary<bool>();
  const double west = *rc::gen::element(10.013, 179.511, 356.02);
  const Land land(*rc::gen::arbitrary<std::uint32_t>(), is_squeezed ? 10.013 : west, 0.0137, is_squeezed, is_turned,
                  *rc::gen::arbitrary<bool>(), *rc::gen::arbitrary<bool>());
  const int finest = *rc::gen::element(9, 10, 11), z = finest - *rc::gen::inRange(0, 3);
  PyramidPlan plan = plan_of(finest, *rc::gen::element(Effort::kFast, Effort::kNormal));
  plan.binds_samples = *rc::gen::arbitrary<bool>();
  // A tile around a sample.
  const int col = *rc::gen::inRange(0, land.cols), row = *rc::gen::inRange(0, land.rows);
  const std::array<double, 6>& a = land.place.affine;
  double x = a[0] + a[1] * col + a[2] * row, y = a[3] + a[4] * col + a[5] * row;
  if (is_squeezed) land.place.to_degrees->apply({&x, 1}, {&y, 1});
  if (x > 180) x -= 360;
  const double side = 180.0 / (1 << z);
  const TileId id{z, static_cast<std::uint32_t>((x + 180) / side), static_cast<std::uint32_t>((y + 90) / side)};
  const auto tile = make_tile(plan, id, land.source());
  RC_ASSERT(tile.has_value());
  const double error = brute_force(*tile, 16 << (finest - z), land);
  RC_ASSERT(std::abs(error - tile->source_error) <= allowance(is_squeezed));
}

/// Tiles in memory.
class Kept final : public TileSink {
 public:
  Result<std::vector<std::uint8_t>> encode(const TerrainTile& tile) const override {
    const std::lock_guard lock(mutex_);
    tiles[{tile.id.z, tile.id.x, tile.id.y}] = tile;
    return encode_quantized_mesh(tile);
  }
  Result<void> put(TileId, std::span<const std::uint8_t>) override { return {}; }

  mutable std::map<std::tuple<int, std::uint32_t, std::uint32_t>, TerrainTile> tiles;

 private:
  mutable std::mutex mutex_;
};

TEST(tile_source_laws, above_the_blocks_the_source_error_bounds_that_of_all_samples) {
  for (const bool is_squeezed : {false, true}) {
    if (testing::kIsSanitized && !is_squeezed) continue;
    const Land land(5, 10.013, 0.0537, is_squeezed, false, true, false);
    constexpr int kFinest = 8;
    PyramidPlan plan = plan_of(kFinest, Effort::kFast);
    plan.covered = {9, 40, 18, 49};
    Kept kept;
    const auto report = make_pyramid(plan, land.source(), kept, {.threads = 2});
    ASSERT_TRUE(report) << report.error().message;
    std::vector<double> largest(plan.levels.size(), 0);
    for (const auto& [key, tile] : kept.tiles) {
      const int z = tile.id.z;
      double& level = largest[static_cast<std::size_t>(z)];
      level = std::max(level, tile.source_error);
      if (z > plan.block_level) continue;
      const double error = brute_force(tile, 16 << (kFinest - z), land);
      if (z == plan.block_level) {
        EXPECT_NEAR(error, tile.source_error, allowance(is_squeezed));
      } else {
        EXPECT_LE(error, tile.source_error + allowance(is_squeezed)) << z << "/" << tile.id.x << "/" << tile.id.y;
        EXPECT_GE(error, 0.5 * tile.source_error) << "the bound says little";
      }
    }
    for (std::size_t z = 0; z < largest.size(); ++z) EXPECT_EQ(report->levels[z].source_error, largest[z]);
  }
}

/// Nodes without samples.
class Sea final : public NodeSource {
 public:
  Result<void> read(const NodeWindow&, std::span<float> out) const override {
    std::fill(out.begin(), out.end(), 1.0f);
    return {};
  }
};

TEST(tile_source_laws, the_error_of_samples_that_nobody_shows_is_not_known) {
  PyramidPlan plan = plan_of(7, Effort::kFast);
  plan.covered = {9, 40, 12, 42};
  Kept kept;
  const auto report = make_pyramid(plan, Sea(), kept);
  ASSERT_TRUE(report) << report.error().message;
  for (const LevelSummary& level : report->levels) EXPECT_TRUE(std::isnan(level.source_error));
}

}  // namespace
}  // namespace scarp::tile_source_laws_test
