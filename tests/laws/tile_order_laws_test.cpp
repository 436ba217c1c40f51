// The choice of a tile's order depends only on its samples.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "laws/started_tiles.h"
#include "refine/tile_order.h"

namespace scarp::tile_order_laws_test {
namespace {

using testing::Field;

constexpr double kDensity = 0.05;

refine::TileOrder order_of(const Field& field, double density = kDensity) {
  refine::Tile tile;
  EXPECT_TRUE(tile.load(field.view(), {0, 0, field.cols, field.rows}));
  return refine::choose_order(tile.view(), density);
}

Field noise(std::int32_t cols, std::int32_t rows) {
  return testing::random_field(4, cols, rows, testing::Relief::kReal);
}

Field dome(std::int32_t cols, std::int32_t rows) {
  Field field{cols, rows, {}};
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < cols; ++x) field.samples.push_back(static_cast<float>(x * x + y * y) / 16.0f);
  return field;
}

TEST(tile_order, is_lazy_on_noise_and_dominant_on_a_smooth_surface) {
  EXPECT_EQ(order_of(noise(257, 257)), refine::TileOrder::kLazyOne);
  EXPECT_EQ(order_of(dome(257, 257)), refine::TileOrder::kDominant);
}

TEST(tile_order, is_dominant_where_the_mesh_is_dense_or_small) {
  EXPECT_EQ(order_of(noise(257, 257), 0.5), refine::TileOrder::kDominant);
  EXPECT_EQ(order_of(noise(257, 257), 0.001), refine::TileOrder::kDominant);
  EXPECT_EQ(order_of(noise(60, 60)), refine::TileOrder::kDominant);
  EXPECT_EQ(order_of(noise(257, 257), 0), refine::TileOrder::kDominant);
}

TEST(tile_order, is_dominant_where_nothing_can_be_told) {
  EXPECT_EQ(order_of(noise(16, 4000)), refine::TileOrder::kDominant);  // no sample is far enough from others
  Field empty = noise(257, 257);
  for (float& sample : empty.samples) sample = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(order_of(empty), refine::TileOrder::kDominant);
  Field flat = noise(257, 257);
  for (float& sample : flat.samples) sample = 7;
  EXPECT_EQ(order_of(flat), refine::TileOrder::kDominant);
}

TEST(tile_order, does_not_change_with_units_or_nodata_here_and_there) {
  Field scaled = noise(257, 257);
  for (float& sample : scaled.samples) sample *= 0x1p30f;
  EXPECT_EQ(order_of(scaled), refine::TileOrder::kLazyOne);
  Field holes = noise(257, 257);
  for (std::size_t i = 0; i < holes.samples.size(); i += 97) holes.samples[i] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(order_of(holes), refine::TileOrder::kLazyOne);
}

}  // namespace
}  // namespace scarp::tile_order_laws_test
