// Finds the tiles of a pyramid without making them.
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/reporter.h"
#include "scarp/tile.h"
#include "tiles/mesh/tile_maker.h"
#include "tiles/pyramid/pyramid_tiles.h"

namespace scarp {
namespace {

/// Flags of the tiles of a level below a block, by rows from the south.
using Flags = std::vector<bool>;

/// True for each tile of the finest level below a block that has heights.
Result<Flags> find_heights(const PyramidPlan& plan, TileId block, const NodeSource& source) {
  const std::int32_t side = 1 << (plan.max_zoom() - block.z), steps = tiles::steps_of(plan, block.z),
                     cells = plan.cells;
  NodeWindow band = plan.grid.window_of(block, steps);
  const std::int64_t first = band.row;
  band.rows = cells + 1;
  Flags has(static_cast<std::size_t>(side * side));
  std::vector<float> heights(static_cast<std::size_t>(steps + 1) * static_cast<std::size_t>(cells + 1));
  for (std::int32_t y = 0; y < side; ++y) {
    band.row = first + std::int64_t{side - 1 - y} * cells;
    SCARP_RETURN_IF_ERROR(source.read(band, heights));
    for (std::size_t k = 0; k < heights.size(); ++k) {
      if (std::isnan(heights[k])) continue;
      const auto col = static_cast<std::int32_t>(k % static_cast<std::size_t>(steps + 1));
      // A node between two tiles belongs to both.
      const auto mark = [&](std::int32_t x) { has[static_cast<std::size_t>(y * side + x)] = true; };
      if (col < steps) mark(col / cells);
      if (col > 0) mark((col - 1) / cells);
    }
  }
  return has;
}

/// The same, judged only by the tiles' places.
Flags find_covered(const PyramidPlan& plan, TileId block) {
  const int deeper = plan.max_zoom() - block.z;
  const std::uint32_t side = std::uint32_t{1} << deeper;
  Flags has(std::size_t{side} * side);
  for (std::uint32_t y = 0; y < side; ++y) {
    for (std::uint32_t x = 0; x < side; ++x)
      has[std::size_t{y} * side + x] =
          tiles::is_covered(plan, {plan.max_zoom(), (block.x << deeper) + x, (block.y << deeper) + y});
  }
  return has;
}

/// Adds the tiles below a block: on each level those with heights, and their siblings if the plan requires them.
void add_below(const PyramidPlan& plan, TileId block, Flags has, std::vector<std::vector<std::uint64_t>>& levels) {
  for (int z = plan.max_zoom(); z > block.z; --z) {
    const int deeper = z - block.z;
    const std::uint32_t side = std::uint32_t{1} << deeper;
    Flags parents(std::size_t{side / 2} * (side / 2));
    const auto parent = [&](std::uint32_t x, std::uint32_t y) { return std::size_t{y / 2} * (side / 2) + x / 2; };
    for (std::uint32_t y = 0; y < side; ++y) {
      for (std::uint32_t x = 0; x < side; ++x) {
        if (has[std::size_t{y} * side + x]) parents[parent(x, y)] = true;
      }
    }
    for (std::uint32_t y = 0; y < side; ++y) {
      for (std::uint32_t x = 0; x < side; ++x) {
        const TileId id{z, (block.x << deeper) + x, (block.y << deeper) + y};
        if ((has[std::size_t{y} * side + x] || (plan.has_siblings && parents[parent(x, y)])) &&
            tiles::is_wanted(plan, id))
          levels[static_cast<std::size_t>(z)].push_back(std::uint64_t{id.y} << 32 | id.x);
      }
    }
    has = std::move(parents);
  }
}

}  // namespace

Result<std::vector<std::vector<std::uint64_t>>> find_tiles(const PyramidPlan& plan, const NodeSource* source,
                                                           const Run& run) {
  std::vector<std::vector<std::uint64_t>> levels(plan.levels.size());
  const std::vector<tiles::TileSet> chosen = tiles::choose_tiles(plan);
  for (std::size_t z = 0; z < chosen.size(); ++z) {
    for (const auto& [y, x] : chosen[z]) levels[z].push_back(std::uint64_t{y} << 32 | x);
  }
  std::vector<TileId> blocks = find_blocks(plan);
  std::erase_if(blocks, [&](TileId block) { return !tiles::is_covered(plan, block); });
  std::vector<Result<Flags>> found(blocks.size());
  Reporter reporter(run.progress);
  Result<void> result;
  parallel_in_order(
      blocks.size(), run.threads,
      [&](std::size_t k, std::size_t) {
        found[k] = source != nullptr ? find_heights(plan, blocks[k], *source) : find_covered(plan, blocks[k]);
      },
      [&](std::size_t k) {
        Result<Flags> one = std::move(found[k]);
        const double share = static_cast<double>(k) / static_cast<double>(blocks.size());
        if (!one) {
          result = tl::unexpected(one.error());
        } else if (reporter.due() && !reporter.report("look", share, 0, 0)) {
          result = fail(ErrorKind::kCancelled, "cancelled");
        } else {
          add_below(plan, blocks[k], std::move(*one), levels);
        }
        return result.has_value();
      });
  SCARP_RETURN_IF_ERROR(result);
  for (auto& level : levels) std::sort(level.begin(), level.end());
  return levels;
}

}  // namespace scarp
