// Laws of water in the nodes of tiles: a node depends only on its place, not on the window, and follows the polygons.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "laws/sanitized.h"
#include "tiles/water/tile_waters.h"

namespace scarp::tile_water_laws_test {
namespace {

constexpr std::int64_t kTurn = 1 << 12;

/// Heights from a hash of a node's place.
class Land final : public NodeSource {
 public:
  static float at(const NodeWindow& window, std::int64_t col, std::int64_t row) {
    const std::int64_t stride = kTurn / window.per_turn;
    const auto x = static_cast<std::uint64_t>(((col * stride) % kTurn + kTurn) % kTurn);
    const std::uint64_t hash = (x * 2654435761u ^ static_cast<std::uint64_t>(row * stride) * 40503u) % 1009;
    return hash % 17 == 0 ? NAN : static_cast<float>(hash);
  }
  Result<void> read(const NodeWindow& window, std::span<float> out) const override {
    std::size_t k = 0;
    for (int j = 0; j < window.rows; ++j) {
      for (int i = 0; i < window.cols; ++i) out[k++] = at(window, window.col + i, window.row + j);
    }
    return {};
  }
};

class Slope final : public HeightZero {
 public:
  void find(std::span<const double> longitudes, std::span<const double> latitudes,
            std::span<double> heights) const override {
    for (std::size_t k = 0; k < heights.size(); ++k) heights[k] = std::abs(longitudes[k]) / 8 - latitudes[k] / 4;
  }
};

double any_place(double low, double high) { return low + (high - low) * (*rc::gen::inRange(0, 100003)) / 100003.0; }

/// A star around a place, possibly across the antimeridian.
tiles::TileLake any_lake(double level) {
  tiles::TileLake lake;
  lake.level = level;
  lake.rings.emplace_back();
  const double col = any_place(-60, 60), row = any_place(900, 1000);
  const int corners = *rc::gen::inRange(3, 9);
  for (int k = 0; k < corners; ++k) {
    const double angle = 6.2831853 * k / corners, reach = any_place(1, 40);
    lake.rings.back().push_back({col + reach * std::cos(angle), row + reach * std::sin(angle)});
  }
  lake.rings.back().push_back(lake.rings.back().front());
  return lake;
}

/// 1 in the polygon, −1 outside, 0 if too close: flatten_lakes() also includes nodes within a 128th of an edge's line,
/// and just beyond its ends.
int side_of(const tiles::TileLake& lake, double col, double row) {
  bool is_inside = false, is_near = false;
  const auto& ring = lake.rings.front();
  for (const auto& [x, y] : ring) is_near = is_near || (std::abs(x - col) < 42 && std::abs(y - row) < 42);
  if (!is_near) return -1;
  for (std::size_t k = 0; k + 1 < ring.size(); ++k) {
    const auto &p = ring[k], &q = ring[k + 1];
    const double dx = q[0] - p[0], dy = q[1] - p[1], length = std::hypot(dx, dy);
    const double along = ((col - p[0]) * dx + (row - p[1]) * dy) / length;
    const double beside = ((col - p[0]) * dy - (row - p[1]) * dx) / length;
    if (std::abs(beside) < 0.02 && along > -1 && along < length + 1) return 0;
    if ((p[1] <= row) != (q[1] <= row) && col < p[0] + (row - p[1]) / dy * dx) is_inside = !is_inside;
  }
  return is_inside ? 1 : -1;
}

std::shared_ptr<TileWaters> any_waters() {
  auto waters = std::make_shared<TileWaters>();
  waters->covered = {-180, -90, 180, 90};
  waters->per_turn = kTurn;
  waters->lakes = {any_lake(300), any_lake(500)};
  tiles::TileRiver river{
      "", {{any_place(-60, 60), any_place(900, 1000), 250}, {any_place(-60, 60), any_place(900, 1000), 240}}};
  waters->rivers.push_back(std::move(river));
  return waters;
}

RC_GTEST_PROP(tile_water_laws, a_node_is_the_same_in_every_window, ()) {
  const Land land;
  const auto zero = *rc::gen::arbitrary<bool>() ? std::make_shared<Slope>() : nullptr;
  const auto nodes = tiles::make_watered_source(land, any_waters(), zero);
  const NodeWindow whole{kTurn, -128, 832, 256, 256};
  std::vector<float> all(256 * 256);
  RC_ASSERT(nodes->read(whole, all).has_value());
  for (const std::int64_t stride : {1, 2, 8}) {
    const auto steps = static_cast<int>(256 / stride);
    const int col = *rc::gen::inRange(0, steps - 2), row = *rc::gen::inRange(0, steps - 2);
    NodeWindow part{kTurn / stride, whole.col / stride + col, whole.row / stride + row, 0, 0};
    part.cols = *rc::gen::inRange(1, steps - col + 1);
    part.rows = *rc::gen::inRange(1, steps - row + 1);
    // A further turn gives the same place.
    part.col += *rc::gen::element<std::int64_t>(-1, 0, 1) * part.per_turn;
    std::vector<float> some(static_cast<std::size_t>(part.cols) * static_cast<std::size_t>(part.rows));
    RC_ASSERT(nodes->read(part, some).has_value());
    for (int j = 0; j < part.rows; ++j) {
      for (int i = 0; i < part.cols; ++i) {
        const float one = some[static_cast<std::size_t>(j * part.cols + i)];
        const float other = all[static_cast<std::size_t>((row + j) * stride * 256 + (col + i) * stride)];
        // Zeros are interpolated between other places if nodes are farther apart.
        if (std::isnan(other)) {
          RC_ASSERT(std::isnan(one));
        } else if (zero == nullptr) {
          RC_ASSERT(one == other);
        } else {
          RC_ASSERT(std::abs(one - other) < 0.01f);
        }
      }
    }
  }
}

RC_GTEST_PROP(tile_water_laws, nodes_are_what_the_polygons_say, ()) {
  const Land land;
  const auto waters = any_waters();
  const auto nodes = tiles::make_watered_source(land, waters, nullptr);
  const NodeWindow window{kTurn, -128, 832, 256, 256};
  std::vector<float> heights(256 * 256);
  RC_ASSERT(nodes->read(window, heights).has_value());
  const auto &p = waters->rivers[0].course[0], &q = waters->rivers[0].course[1];
  for (int j = 0; j < 256; j += testing::kIsSanitized ? 5 : 1) {
    for (int i = 0; i < 256; ++i) {
      const double col = -128 + i, row = 832 + j;
      const float own = Land::at(window, window.col + i, window.row + j),
                  is = heights[static_cast<std::size_t>(j * 256 + i)];
      RC_ASSERT(std::isnan(own) == std::isnan(is));
      if (std::isnan(own)) continue;
      // The antimeridian is column 0 of this window's turn, with lakes on both sides.
      const int first = side_of(waters->lakes[0], col, row), second = side_of(waters->lakes[1], col, row);
      if (first == 0 || second == 0) continue;
      if (first == 1 || second == 1) {
        RC_ASSERT(is == (second == 1 ? 500.0f : 300.0f));
        continue;
      }
      const double dx = q[0] - p[0], dy = q[1] - p[1];
      const double along =
          std::clamp(((col - p[0]) * dx + (row - p[1]) * dy) / std::max(dx * dx + dy * dy, 1e-9), 0.0, 1.0);
      const double beside = std::max(std::abs(p[0] + along * dx - col), std::abs(p[1] + along * dy - row));
      if (beside < 0.1) RC_ASSERT(is >= 240 && is <= 250);
      if (beside < 1.5) continue;
      double rim = -1;
      for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
          for (const tiles::TileLake& lake : waters->lakes) {
            const int side = side_of(lake, col + x, row + y);
            if (side == 0) rim = NAN;
            if (side == 1) rim = std::max(rim, lake.level + 0.01);
          }
        }
      }
      if (!std::isnan(rim)) RC_ASSERT(is == std::max(own, static_cast<float>(rim)));
    }
  }
}

TEST(tile_water, nodes_between_those_of_the_waters_are_refused) {
  const Land land;
  const auto waters = std::make_shared<TileWaters>();
  waters->per_turn = kTurn;
  waters->lakes = {{"", 300, {{{1, 901}, {9, 901}, {9, 909}, {1, 901}}}}};
  const auto nodes = tiles::make_watered_source(land, waters, nullptr);
  std::vector<float> heights(16 * 16);
  const NodeWindow same{kTurn, 0, 896, 16, 16}, halves{kTurn / 2, 0, 448, 16, 16};
  for (const NodeWindow& window : {same, halves}) EXPECT_TRUE(nodes->read(window, heights).has_value());
  NodeWindow other_grid = same;
  other_grid.grid.kind = GridKind::kMercator;
  const NodeWindow finer{2 * kTurn, 0, 1792, 16, 16}, between{kTurn * 3 / 4, 0, 672, 16, 16};
  for (const NodeWindow& window : {finer, between, other_grid}) {
    const auto read = nodes->read(window, heights);
    ASSERT_FALSE(read.has_value());
    EXPECT_EQ(read.error().kind, ErrorKind::kUsage);
  }
}

}  // namespace
}  // namespace scarp::tile_water_laws_test
