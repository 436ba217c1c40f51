// Makes all tiles: block by block, then the levels above from the blocks' coarse tiles.
#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "base/reporter.h"
#include "scarp/tile.h"
#include "tiles/mesh/tile_maker.h"
#include "tiles/mesh/tile_mesh_parts.h"
#include "tiles/mesh/tile_nodes.h"
#include "tiles/pyramid/coarse_nodes.h"
#include "tiles/pyramid/pyramid_tiles.h"
#include "tiles/pyramid/tile_output.h"

namespace scarp::tiles {
namespace {

Result<std::optional<KeptTile>> make_coarse(const PyramidPlan& plan, TileId id, const CoarseLevel& below,
                                            const TileEncoder& encode) {
  const std::int32_t steps = 2 * kCoarseCells;
  SCARP_TRY(const auto& nodes, TileNodes::read(plan, id, steps, normal_reach(steps), below));
  double source_error = 0;
  const auto judge = [&](const TerrainTile& made) -> Result<TileVerdict> {
    const CoarseVerdict verdict = bound_errors(made, plan.grid, below);
    source_error = verdict.source_error;
    return TileVerdict{verdict.node_error, {}};
  };
  // Land may be between flat nodes.
  const std::array<TileId, 4> children = children_of(id);
  const bool has_land = std::any_of(children.begin(), children.end(),
                                    [&](TileId child) { return below.at(child.x, child.y).has_heights; });
  const auto complete = [&](TerrainTile& tile) -> Result<void> {
    if (nodes.is_flat() && has_land) tile.node_error = judge(tile)->error;
    tile.source_error = source_error;
    return {};
  };
  SCARP_TRY(auto&& kept, make_tile_of(plan, id, nodes, {judge, complete}, encode));
  return std::optional(std::move(kept));
}

CoarseLevel join_level(const PyramidPlan& plan, const std::vector<TileId>& tiles, const CoarseLevel& below) {
  CoarseLevel level(tiles.front().z, plan.background);
  for (const TileId id : tiles) {
    const auto [south_west, south_east, north_west, north_east] = children_of(id);
    const std::array<const CoarseTile*, 4> children{
        &below.at(north_west.x, north_west.y), &below.at(north_east.x, north_east.y),
        &below.at(south_west.x, south_west.y), &below.at(south_east.x, south_east.y)};
    CoarseTile joined = CoarseTile::join(plan.grid, id, children);
    if (joined.has_heights) level.add(id.x, id.y, std::move(joined));
  }
  return level;
}

}  // namespace

}  // namespace scarp::tiles

namespace scarp {

Result<PyramidReport> finish_pyramid(const PyramidPlan& plan, std::vector<BlockReport> blocks, TileSink& sink,
                                     const Run& run) {
  PyramidReport report;
  report.levels.resize(plan.levels.size());
  report.tiles.resize(plan.levels.size());
  tiles::CoarseLevel below(plan.block_level, plan.background);
  for (BlockReport& block : blocks) {
    tiles::add_report(report, block.report);
    if (block.reduced.empty()) continue;
    SCARP_TRY(auto&& coarse, tiles::CoarseTile::from_bytes(block.reduced));
    below.add(block.block.x, block.block.y, std::move(coarse));
    block = {};
  }
  if (plan.block_level == 0) return report;
  tiles::TileOutput output(plan, sink, run);
  const std::vector<tiles::TileSet> chosen = tiles::choose_tiles(plan);
  for (int z = plan.block_level - 1; z >= 0; --z) {
    std::vector<TileId> tiles;
    for (const auto& [y, x] : chosen[static_cast<std::size_t>(z)]) tiles.push_back({z, x, y});
    SCARP_RETURN_IF_ERROR(output.make(
        tiles, [&](TileId id, const TileEncoder& encode) { return tiles::make_coarse(plan, id, below, encode); }));
    below = tiles::join_level(plan, tiles, below);
  }
  tiles::add_report(report, output.take_report());
  return report;
}

Result<PyramidReport> make_pyramid(const PyramidPlan& plan, const NodeSource& source, TileSink& sink, const Run& run) {
  const std::vector<TileId> blocks = find_blocks(plan);
  // A tile above the blocks needs about a thousandth of a block's time, or one unit of its cost.
  std::uint64_t cost = blocks.size(), done = 0;
  for (const TileId block : blocks) cost += block_cost(plan, block);
  const auto share_of = [&](std::uint64_t part) { return static_cast<double>(part) / static_cast<double>(cost); };
  std::vector<BlockReport> made;
  Run part = run;
  for (const TileId block : blocks) {
    const std::uint64_t one_cost = block_cost(plan, block);
    part.progress = part_of(run.progress, share_of(done), share_of(one_cost));
    done += one_cost;
    SCARP_TRY(auto&& one, make_block(plan, block, source, sink, part));
    made.push_back(std::move(one));
  }
  part.progress = part_of(run.progress, share_of(done), share_of(cost - done));
  return finish_pyramid(plan, std::move(made), sink, part);
}

}  // namespace scarp
