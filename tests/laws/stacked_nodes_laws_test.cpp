// Laws of stacks of sources: each node has the height of the first source that has one, and tiles end where no source
// requires more.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include "scarp/tile.h"

namespace scarp::stacked_nodes_laws_test {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

/// Waves and holes in a box that may extend east beyond 180°.
class Patch final : public NodeSource {
 public:
  Patch(DegreeBox box, std::uint32_t seed, float base) : box_(box), seed_(seed), base_(base) {}

  float at(double longitude, double latitude) const {
    if (longitude < box_.west) longitude += 360;
    if (longitude > box_.east || latitude < box_.south || latitude > box_.north) return kNone;
    const auto cell = static_cast<std::uint32_t>(std::floor((longitude + 360) * 0.7)) * 73856093u ^
                      static_cast<std::uint32_t>(std::floor((latitude + 90) * 0.9)) * 19349663u ^ seed_;
    if ((cell * 2654435761u) >> 29 == 0) return kNone;
    const double wave = std::abs(std::fmod(longitude * 1.7 + latitude * 2.3 + 720, 3) - 1.5);
    return base_ + static_cast<float>(400 * wave);
  }
  Result<void> read(const NodeWindow& window, std::span<float> out) const override {
    std::size_t k = 0;
    for (int j = 0; j < window.rows; ++j) {
      const std::int64_t row = window.row + j;
      for (int i = 0; i < window.cols; ++i)
        out[k++] = at(window.longitude(window.is_pole(row) ? 0 : window.col + i), window.latitude(row));
    }
    return {};
  }
  const DegreeBox& box() const { return box_; }

 private:
  DegreeBox box_;
  std::uint32_t seed_;
  float base_;
};

struct Stack {
  std::vector<std::unique_ptr<Patch>> patches;
  std::unique_ptr<NodeSource> nodes;

  float at(double longitude, double latitude) const {
    for (const auto& patch : patches) {
      const float height = patch->at(longitude, latitude);
      if (!std::isnan(height)) return height;
    }
    return kNone;
  }
};

Stack any_stack(double widest) {
  Stack stack;
  std::vector<StackedSource> sources;
  const int count = *rc::gen::inRange(1, 5);
  const double middle = *rc::gen::inRange(-180, 180), latitude = *rc::gen::inRange(-85, 75);
  for (int k = 0; k < count; ++k) {
    const double west = std::clamp(middle + *rc::gen::inRange(-100, 100) / 100.0 * widest, -180.0, 179.0);
    const double south = std::clamp(latitude + *rc::gen::inRange(-100, 100) / 200.0 * widest, -90.0, 85.0);
    const double width = *rc::gen::inRange(10, 100) / 100.0 * widest;
    const DegreeBox box{west, south, west + width, std::min(90.0, south + width / 2)};
    stack.patches.push_back(
        std::make_unique<Patch>(box, *rc::gen::arbitrary<std::uint32_t>(), static_cast<float>(1000 * k)));
    sources.push_back({stack.patches.back().get(), box});
  }
  stack.nodes = make_stacked_source(std::move(sources));
  return stack;
}

class Kept final : public TileSink {
 public:
  Result<std::vector<std::uint8_t>> encode(const TerrainTile& tile) const override {
    return encode_quantized_mesh(tile);
  }
  Result<void> put(TileId id, std::span<const std::uint8_t> bytes) override {
    tiles[{id.z, id.x, id.y}].assign(bytes.begin(), bytes.end());
    return {};
  }
  std::map<std::tuple<int, std::uint32_t, std::uint32_t>, std::vector<std::uint8_t>> tiles;
};

using EdgeVertex = std::tuple<std::uint16_t, float, std::array<std::uint8_t, 2>>;

std::vector<EdgeVertex> edge_of(const QuantizedMesh& mesh, const std::vector<std::uint32_t>& vertices,
                                const std::vector<std::uint16_t>& along) {
  std::vector<EdgeVertex> edge;
  for (const std::uint32_t v : vertices) {
    const float height = static_cast<float>(mesh.height(v));
    edge.emplace_back(along[v], std::abs(height) < 1e-10f ? 0 : height, mesh.normals[v]);
  }
  return edge;
}

}  // namespace

RC_GTEST_PROP(stacked_nodes, are_the_first_height_at_each_place_for_any_window, ()) {
  const Stack stack = any_stack(150);
  const std::int64_t per_turn = std::int64_t{16} << *rc::gen::inRange(2, 8);
  NodeWindow window{per_turn, *rc::gen::inRange<std::int64_t>(-per_turn, per_turn), 0, *rc::gen::inRange(1, 90), 0};
  window.row = *rc::gen::inRange<std::int64_t>(0, window.last_row());
  window.rows = static_cast<int>(std::min<std::int64_t>(*rc::gen::inRange(1, 90), window.last_row() + 1 - window.row));
  std::vector<float> heights(static_cast<std::size_t>(window.cols) * static_cast<std::size_t>(window.rows));
  RC_ASSERT(stack.nodes->read(window, heights).has_value());
  const NodeWindow land = stack.nodes->land(window);
  const bool is_within = land.col >= window.col && land.col + land.cols <= window.col + window.cols &&
                         land.row >= window.row && land.row + land.rows <= window.row + window.rows;
  RC_ASSERT(is_within && (land.cols > 0) == (land.rows > 0));
  std::size_t k = 0;
  for (int j = 0; j < window.rows; ++j) {
    const std::int64_t row = window.row + j;
    for (int i = 0; i < window.cols; ++i, ++k) {
      const float chosen = stack.at(window.longitude(window.is_pole(row) ? 0 : window.col + i), window.latitude(row));
      RC_ASSERT(heights[k] == chosen || (std::isnan(heights[k]) && std::isnan(chosen)));
      const std::int64_t col = window.col + i;
      const bool is_land =
          col >= land.col && col < land.col + land.cols && row >= land.row && row < land.row + land.rows;
      RC_ASSERT(is_land || std::isnan(chosen));
    }
  }
}

RC_GTEST_PROP(stacked_nodes, make_tiles_that_fit_and_end_where_no_source_asks_for_more, ()) {
  const Stack stack = any_stack(12);
  std::vector<SourceFacts> facts;
  for (const auto& patch : stack.patches) {
    const double cell = 180 / std::ldexp(16, *rc::gen::inRange(4, 8)) / 1.05;
    facts.push_back({patch->box(), cell * 111000, 0, 4500, cell});
  }
  PyramidSettings settings;
  settings.cells = 16;
  settings.effort = Effort::kFast;
  settings.has_siblings = *rc::gen::arbitrary<bool>();
  const auto plan = plan_pyramid(facts, settings);
  RC_ASSERT(plan.has_value());
  Run run;
  run.threads = *rc::gen::inRange(1, 4);
  Kept kept;
  const auto report = make_pyramid(*plan, *stack.nodes, kept, run);
  RC_ASSERT(report.has_value());

  // Blocks in another order on one thread give the same tiles.
  Kept again;
  std::vector<BlockReport> blocks;
  std::vector<TileId> order = find_blocks(*plan);
  std::reverse(order.begin(), order.end());
  for (const TileId block : order) {
    auto made = make_block(*plan, block, *stack.nodes, again);
    RC_ASSERT(made.has_value());
    blocks.push_back(std::move(*made));
  }
  RC_ASSERT(finish_pyramid(*plan, std::move(blocks), again).has_value());
  RC_ASSERT(again.tiles == kept.tiles);
  RC_ASSERT(find_tiles(*plan, stack.nodes.get()).value() == report->tiles);

  for (const auto& [key, bytes] : kept.tiles) {
    const auto [z, x, y] = key;
    const TileId id{z, x, y};
    RC_ASSERT(z == 0 || kept.tiles.count({z - 1, x / 2, y / 2}) == 1);
    if (z > plan->block_level && stack.patches.size() > 1 && !settings.has_siblings) {
      const DegreeBox box = plan->grid.bounds_of(id);
      const double node = (box.east - box.west) * 2;
      bool is_asked = false;
      for (std::size_t k = 0; k < facts.size(); ++k) {
        const DegreeBox& one = facts[k].covered;
        for (const double turn : {-360.0, 0.0, 360.0})
          is_asked |= plan->sources[k].max_zoom >= z && box.south <= one.north + node &&
                      box.north >= one.south - node && box.west + turn <= one.east + node &&
                      box.east + turn >= one.west - node;
      }
      RC_ASSERT(is_asked);
    }
    const auto mesh = decode_quantized_mesh(bytes, "tile");
    RC_ASSERT(mesh.has_value());
    const auto east = kept.tiles.find({z, (x + 1) % plan->grid.columns(z), y});
    if (east != kept.tiles.end()) {
      const auto other = decode_quantized_mesh(east->second, "tile");
      RC_ASSERT(edge_of(*mesh, mesh->east, mesh->v) == edge_of(*other, other->west, other->v));
    }
    const auto north = kept.tiles.find({z, x, y + 1});
    if (north != kept.tiles.end()) {
      const auto other = decode_quantized_mesh(north->second, "tile");
      RC_ASSERT(edge_of(*mesh, mesh->north, mesh->u) == edge_of(*other, other->south, other->u));
    }
  }
}

}  // namespace scarp::stacked_nodes_laws_test
