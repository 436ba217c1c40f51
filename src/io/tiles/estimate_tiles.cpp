// What a set of tiles will take.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include "scarp/tile_job.h"

namespace scarp {
namespace {

/// Time of all levels ÷ that of the finest: docs/tiles.md, "Speed".
constexpr double kPyramidTime = 1.8;
/// Bytes of all levels ÷ those of the finest. Each level has a quarter of the tiles, and more triangles in each.
constexpr double kPyramidBytes = 1.6;
/// What finish_pyramid() needs of a block.
constexpr std::uint64_t kReducedBytes = 330'000;
/// The program, without nodes.
constexpr std::uint64_t kProgramBytes = 90'000'000;

bool overlap(const PyramidPlan& plan, const DegreeBox& box, const DegreeBox& covered) {
  if (box.south >= covered.north || box.north <= covered.south) return false;
  return std::ranges::any_of(
      plan.grid.turns(), [&](double turn) { return box.west + turn < covered.east && box.east + turn > covered.west; });
}

/// Whether a tile of the finest level may be made.
bool is_expected(const PyramidPlan& plan, TileId id) {
  const DegreeBox box = plan.grid.bounds_of(id);
  if (plan.sources.empty()) return overlap(plan, box, plan.covered);
  return std::ranges::any_of(plan.sources, [&](const PlannedSource& source) {
    return source.max_zoom >= id.z && overlap(plan, box, source.covered);
  });
}

/// Tiles of the finest level below a block that may have heights.
std::vector<TileId> finest_tiles(const PyramidPlan& plan, TileId block) {
  const int deeper = plan.max_zoom() - block.z;
  const std::uint32_t side = std::uint32_t{1} << deeper;
  std::vector<TileId> tiles;
  for (std::uint32_t y = 0; y < side; ++y) {
    for (std::uint32_t x = 0; x < side; ++x) {
      const TileId id{plan.max_zoom(), (block.x << deeper) + x, (block.y << deeper) + y};
      if (is_expected(plan, id)) tiles.push_back(id);
    }
  }
  return tiles;
}

Result<bool> has_heights(const PyramidPlan& plan, TileId id, const NodeSource& nodes) {
  const NodeWindow window = plan.grid.window_of(id, plan.cells);
  std::vector<float> heights(static_cast<std::size_t>(window.cols) * static_cast<std::size_t>(window.rows));
  if (auto read = nodes.read(window, heights); !read) return tl::unexpected(read.error());
  return std::any_of(heights.begin(), heights.end(), [](float height) { return !std::isnan(height); });
}

}  // namespace

Result<TileEstimate> estimate_tiles(const TileJob& job, const NodeSource& nodes, int samples) {
  const PyramidPlan& plan = job.plan;
  const TileEncoder encode = make_tile_encoder(job.format, plan);
  TileEstimate estimate;
  std::vector<TileId> blocks;
  for (const TileId block : find_blocks(plan)) {
    const std::size_t tiles = finest_tiles(plan, block).size();
    if (tiles == 0) continue;
    blocks.push_back(block);
    estimate.finest_tiles += tiles;
  }
  estimate.blocks = blocks.size();
  double made = 0, seconds = 0, bytes = 0, looked_at = 0;
  for (int k = 0; k < samples && !blocks.empty(); ++k) {
    const auto count = static_cast<std::size_t>(samples), at = static_cast<std::size_t>(k);
    const std::vector<TileId> tiles = finest_tiles(plan, blocks[at * blocks.size() / count]);
    // Steps of the golden ratio spread the places in the blocks.
    const double place = std::fmod(0.6180339887498949 * (k + 1), 1);
    const TileId id = tiles[static_cast<std::size_t>(place * static_cast<double>(tiles.size()))];
    const auto start = std::chrono::steady_clock::now();
    const Result<bool> is_land = has_heights(plan, id, nodes);
    if (!is_land) return tl::unexpected(is_land.error());
    ++looked_at;
    if (!*is_land) continue;
    const auto tile = make_tile(plan, id, nodes);
    if (!tile) return tl::unexpected(tile.error());
    const auto packed = encode(*tile);
    if (!packed) return tl::unexpected(packed.error());
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    bytes += static_cast<double>(packed->size());
    ++made;
  }
  const double share = looked_at > 0 ? made / looked_at : 0;
  const double finest = share * static_cast<double>(estimate.finest_tiles), each = std::max(made, 1.0);
  estimate.core_seconds = kPyramidTime * finest * seconds / each;
  estimate.bytes = static_cast<std::uint64_t>(kPyramidBytes * finest * bytes / each);
  estimate.finest_tiles = static_cast<std::uint64_t>(finest);
  estimate.tiles =
      static_cast<std::uint64_t>(finest * 4 / 3) + 4 * static_cast<std::uint64_t>(plan.block_level) + plan.grid.roots();
  estimate.parts = estimate.bytes + kReducedBytes * estimate.blocks;
  const auto side = static_cast<std::uint64_t>(plan.cells) << (plan.max_zoom() - plan.block_level);
  estimate.memory = kProgramBytes + 3 * sizeof(float) * side * side;
  return estimate;
}

}  // namespace scarp
