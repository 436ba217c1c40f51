// A block: the tile of the block level and all below it, of nodes that are read once.
#include <optional>
#include <utility>
#include <vector>

#include "scarp/tile.h"
#include "tiles/coarse_nodes.h"
#include "tiles/pyramid_tiles.h"
#include "tiles/tile_maker.h"
#include "tiles/tile_mesh_parts.h"
#include "tiles/tile_nodes.h"
#include "tiles/tile_output.h"

namespace scarp {
namespace {

/// All nodes of a block and around it, read by all threads.
Result<HeldNodes> read_block(const PyramidPlan& plan, TileId block, const NodeSource& source, int threads) {
  const std::int32_t steps = steps_of(plan, block.z);
  return HeldNodes::read(plan.grid.window_of(block, steps, normal_reach(steps)), source, threads);
}

/// The block's tile, then level by level those below it, by rows.
std::vector<TileId> tiles_of(const PyramidPlan& plan, TileId block) {
  std::vector<TileId> tiles;
  for (int deeper = 0; deeper <= plan.max_zoom() - block.z; ++deeper) {
    const std::uint32_t side = std::uint32_t{1} << deeper;
    for (std::uint32_t y = 0; y < side; ++y) {
      for (std::uint32_t x = 0; x < side; ++x)
        tiles.push_back({block.z + deeper, (block.x << deeper) + x, (block.y << deeper) + y});
    }
  }
  return tiles;
}

Result<TileNodes> read_nodes(const PyramidPlan& plan, TileId id, const NodeSource& source) {
  const std::int32_t steps = steps_of(plan, id.z);
  return TileNodes::read(plan, id, steps, normal_reach(steps), source);
}

/// Nothing for a tile without heights, unless it is the block's own or a wanted sibling of one that may have some.
Result<std::optional<TerrainTile>> make_if_any(const PyramidPlan& plan, TileId id, const NodeSource& source) {
  if (!is_wanted(plan, id)) return std::optional<TerrainTile>();
  const auto nodes = read_nodes(plan, id, source);
  if (!nodes) return tl::unexpected(nodes.error());
  if (!nodes->has_heights() && id.z > plan.block_level) {
    if (!plan.has_siblings) return std::optional<TerrainTile>();
    const auto parent = read_nodes(plan, {id.z - 1, id.x / 2, id.y / 2}, source);
    if (!parent) return tl::unexpected(parent.error());
    if (!parent->has_heights()) return std::optional<TerrainTile>();
  }
  auto tile = make_proven_tile(plan, id, *nodes, source);
  if (!tile) return tl::unexpected(tile.error());
  return std::optional(std::move(*tile));
}

}  // namespace

Result<BlockReport> make_block(const PyramidPlan& plan, TileId block, const NodeSource& source, TileSink& sink,
                               const Run& run) {
  TileOutput output(plan, sink, run);
  BlockReport made;
  made.block = block;
  std::optional<HeldNodes> nodes;
  if (is_covered(plan, block)) {
    auto read = read_block(plan, block, source, run.threads);
    if (!read) return tl::unexpected(read.error());
    if (read->has_heights()) nodes = std::move(*read);
  }
  if (!nodes) {
    Result<TerrainTile> flat = make_flat_tile(plan, block);
    if (!flat) return tl::unexpected(flat.error());
    flat->source_error = 0;
    if (auto put = output.put(*flat); !put) return tl::unexpected(put.error());
    made.report = output.take_report();
    return made;
  }
  const auto make = [&](TileId id) { return make_if_any(plan, id, *nodes); };
  if (auto put = output.make(tiles_of(plan, block), make); !put) return tl::unexpected(put.error());
  made.report = output.take_report();
  made.report.has_heights = true;
  if (plan.block_level == 0) return made;
  const std::int32_t steps = steps_of(plan, block.z);
  const auto whole = TileNodes::read(plan, block, steps, 0, *nodes);
  if (!whole) return tl::unexpected(whole.error());
  const auto reduced = CoarseTile::reduce(plan, block, *whole, source);
  if (!reduced) return tl::unexpected(reduced.error());
  made.reduced = reduced->to_bytes();
  return made;
}

}  // namespace scarp
