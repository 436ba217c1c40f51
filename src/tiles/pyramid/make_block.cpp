// Makes a block: the tile of the block level and all below it, from nodes that are read once.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/bits.h"
#include "globe/row_range.h"
#include "scarp/tile.h"
#include "tiles/mesh/tile_maker.h"
#include "tiles/mesh/tile_mesh_parts.h"
#include "tiles/mesh/tile_nodes.h"
#include "tiles/nodes/held_nodes.h"
#include "tiles/pyramid/coarse_nodes.h"
#include "tiles/pyramid/pyramid_tiles.h"
#include "tiles/pyramid/tile_output.h"
#include "tiles/water/tile_waters.h"

namespace scarp::tiles {
namespace {

/// All nodes in and around a block, read by all threads; nothing if none has a height.
Result<std::optional<HeldNodes>> read_block(const PyramidPlan& plan, TileId block, const NodeSource& source,
                                            int threads) {
  if (!is_covered(plan, block)) return std::optional<HeldNodes>();
  const std::int32_t steps = steps_of(plan, block.z);
  SCARP_TRY(auto&& nodes, HeldNodes::read(plan.grid.window_of(block, steps, normal_reach(steps)), source, threads));
  if (!nodes.has_heights()) return std::optional<HeldNodes>();
  return std::optional(std::move(nodes));
}

std::uint64_t mixed(std::uint64_t hash, double value) {
  hash = (hash ^ bit_cast<std::uint64_t>(value)) * 0xff51afd7ed558ccd;
  return hash ^ (hash >> 32);
}

/// A hash of the nodes, and of each sample with its place, independent of the order in which the source visits them.
Result<std::uint64_t> hash_of(const PyramidPlan& plan, TileId block, const HeldNodes& nodes) {
  const DegreeBox box = plan.grid.bounds_of(block);
  std::uint64_t sum = nodes.hash();
  auto visited = nodes.visit_samples(box, [&](const SampleRow& row) {
    const auto [first, end] = globe::range_within(row.longitude, row.step_longitude, row.latitude, row.step_latitude,
                                                  row.heights.size(), box);
    for (std::size_t i = first; i < end; ++i) {
      if (std::isnan(row.heights[i])) continue;
      const auto steps = static_cast<double>(i);
      sum +=
          mixed(mixed(mixed(0, row.longitude + steps * row.step_longitude), row.latitude + steps * row.step_latitude),
                double{row.heights[i]});
    }
  });
  SCARP_RETURN_IF_ERROR(visited);
  return std::max<std::uint64_t>(sum, 1);
}

/// Adds the water shapes of masks, which are not in the nodes.
std::uint64_t with_masks(const PyramidPlan& plan, TileId block, std::uint64_t nodes) {
  if (!plan.has_water_mask || !plan.waters) return nodes;
  const std::uint64_t shapes = WaterMasks(*plan.waters).hash(block);
  return shapes == 0 ? nodes : std::max<std::uint64_t>(nodes * 0xff51afd7ed558ccd + shapes, 1);
}

/// The block's tile, then level by level those below it, by rows.
std::vector<TileId> tiles_of(TileId block, int deepest) {
  std::vector<TileId> tiles;
  for (int deeper = 0; deeper <= deepest - block.z; ++deeper) {
    const std::uint32_t side = std::uint32_t{1} << deeper;
    for (std::uint32_t y = 0; y < side; ++y) {
      for (std::uint32_t x = 0; x < side; ++x)
        tiles.push_back({block.z + deeper, (block.x << deeper) + x, (block.y << deeper) + y});
    }
  }
  return tiles;
}

/// True for a tile with heights, the block's own, and a required sibling of a tile that may have some.
bool is_made(const PyramidPlan& plan, TileId id, const HeldNodes& nodes) {
  const auto has_heights = [&](TileId tile) {
    return nodes.has_heights(plan.grid.window_of(tile, steps_of(plan, tile.z)));
  };
  return is_wanted(plan, id) && (id.z == plan.block_level || has_heights(id) ||
                                 (plan.has_siblings && has_heights({id.z - 1, id.x / 2, id.y / 2})));
}

Result<std::optional<KeptTile>> make_if_any(const PyramidPlan& plan, TileId id, const HeldNodes& held,
                                            const TileEncoder& encode) {
  if (!is_made(plan, id, held)) return std::optional<KeptTile>();
  const std::int32_t steps = steps_of(plan, id.z);
  SCARP_TRY(const auto& nodes, TileNodes::read(plan, id, steps, normal_reach(steps), held));
  SCARP_TRY(auto&& kept, make_tile_of(plan, id, nodes, proof_at_nodes(plan, nodes, held), encode));
  return std::optional(std::move(kept));
}

}  // namespace

}  // namespace scarp::tiles

namespace scarp {

Result<std::uint64_t> hash_block(const PyramidPlan& plan, TileId block, const NodeSource& source, int threads) {
  SCARP_TRY(const auto& nodes, tiles::read_block(plan, block, source, threads));
  const auto hash = nodes ? tiles::hash_of(plan, block, *nodes) : Result<std::uint64_t>(0);
  return hash ? tiles::with_masks(plan, block, *hash) : hash;
}

Result<BlockReport> make_block(const PyramidPlan& plan, TileId block, const NodeSource& source, TileSink& sink,
                               const Run& run, int deepest) {
  tiles::TileOutput output(plan, sink, run);
  BlockReport made;
  made.block = block;
  SCARP_TRY(const auto& read, tiles::read_block(plan, block, source, run.threads));
  const std::optional<tiles::HeldNodes>& nodes = read;
  if (!nodes) {
    const auto complete = [](TerrainTile& tile) -> Result<void> {
      tile.source_error = 0;
      return {};
    };
    const auto make_flat = [&](TileId id, const TileEncoder& encode) -> Result<std::optional<KeptTile>> {
      SCARP_TRY(auto&& flat,
                tiles::make_tile_of(plan, id, tiles::TileNodes::flat(plan, id, 1), {{}, complete}, encode));
      return std::optional(std::move(flat));
    };
    SCARP_RETURN_IF_ERROR(output.make({block}, make_flat));
    made.report = output.take_report();
    made.hash = tiles::with_masks(plan, block, 0);
    return made;
  }
  const auto make = [&](TileId id, const TileEncoder& encode) { return tiles::make_if_any(plan, id, *nodes, encode); };
  SCARP_RETURN_IF_ERROR(output.make(tiles::tiles_of(block, std::min(deepest, plan.max_zoom())), make));
  made.report = output.take_report();
  made.report.has_heights = true;
  SCARP_TRY(const auto& hash, tiles::hash_of(plan, block, *nodes));
  made.hash = tiles::with_masks(plan, block, hash);
  if (plan.block_level == 0) return made;
  const std::int32_t steps = tiles::steps_of(plan, block.z);
  SCARP_TRY(const auto& whole, tiles::TileNodes::read(plan, block, steps, 0, *nodes));
  SCARP_TRY(const auto& reduced, tiles::CoarseTile::reduce(plan, block, whole, source));
  made.reduced = reduced.to_bytes();
  return made;
}

}  // namespace scarp
