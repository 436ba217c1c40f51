// Estimates the cost of a set of tiles.
#include <algorithm>
#include <cmath>
#include <vector>

#include "jobs/core_seconds.h"
#include "scarp/tile.h"
#include "scarp/tile_job.h"

namespace scarp {
namespace {

/// Limit of the trial's core time. Coarser levels are then extrapolated.
constexpr double kMostSeconds = 5;
/// Largest fraction of a level's tiles in a trial, so that estimating a small set does not build all of it.
constexpr double kMostShare = 0.25;
/// Cost of a tile relative to a tile of the next finer level, which has a quarter of the nodes and most of the
/// triangles.
constexpr double kTimeOfLarger = 2.2, kBytesOfLarger = 1.3;
/// Seconds per lattice node of a block in addition to its tiles: copies for its tiles, the hash, the reduction.
constexpr double kSecondsOfNode = 25e-9;
/// Cost of a tile above the blocks.
constexpr double kSecondsAbove = 0.01, kBytesAbove = 2000;
/// Memory that finish_pyramid() needs for a block.
constexpr std::uint64_t kReducedBytes = 330'000;
/// Memory of the program, without nodes.
constexpr std::uint64_t kProgramBytes = 90'000'000;

bool overlap(const PyramidPlan& plan, const DegreeBox& box, const DegreeBox& covered) {
  if (box.south >= covered.north || box.north <= covered.south) return false;
  return std::ranges::any_of(
      plan.grid.turns(), [&](double turn) { return box.west + turn < covered.east && box.east + turn > covered.west; });
}

/// True if a tile may be built.
bool is_expected(const PyramidPlan& plan, TileId id) {
  const DegreeBox box = plan.grid.bounds_of(id);
  if (plan.sources.empty()) return overlap(plan, box, plan.covered);
  return std::ranges::any_of(plan.sources, [&](const PlannedSource& source) {
    return source.max_zoom >= id.z && overlap(plan, box, source.covered);
  });
}

/// Tiles of a level below a block, or the block itself, that may have heights.
std::vector<TileId> tiles_below(const PyramidPlan& plan, TileId block, int level) {
  const int deeper = level - block.z;
  const std::uint32_t side = std::uint32_t{1} << deeper;
  std::vector<TileId> tiles;
  for (std::uint32_t y = 0; y < side; ++y) {
    for (std::uint32_t x = 0; x < side; ++x) {
      const TileId id{level, (block.x << deeper) + x, (block.y << deeper) + y};
      if (is_expected(plan, id)) tiles.push_back(id);
    }
  }
  return tiles;
}

Result<bool> has_heights(const PyramidPlan& plan, TileId id, const NodeSource& nodes) {
  const NodeWindow window = plan.grid.window_of(id, plan.cells << (plan.max_zoom() - id.z));
  std::vector<float> heights(static_cast<std::size_t>(window.cols) * static_cast<std::size_t>(window.rows));
  SCARP_RETURN_IF_ERROR(nodes.read(window, heights));
  return std::any_of(heights.begin(), heights.end(), [](float height) { return !std::isnan(height); });
}

/// Measured cost of a level's sampled tiles.
struct LevelLook {
  double looked_at = 0, made = 0;
  double reading = 0, making = 0;  ///< seconds: for all tiles examined; for building tiles, without reading
  double bytes = 0;                ///< bytes of the tiles built

  double share() const { return looked_at > 0 ? made / looked_at : 0; }
  double seconds_of_reading() const { return reading / std::max(looked_at, 1.0); }
  double seconds_of_making() const { return making / std::max(made, 1.0); }
  double bytes_of_one() const { return bytes / std::max(made, 1.0); }
};

/// Measures `count` tiles, evenly spread over the blocks.
Result<LevelLook> look_at(const PyramidPlan& plan, const std::vector<TileId>& blocks, int level, int count,
                          const NodeSource& nodes, const TileEncoder& encode) {
  LevelLook look;
  for (int k = 0; k < count; ++k) {
    const auto twice = static_cast<std::size_t>(2 * k + 1);
    const std::size_t block = twice * blocks.size() / (2 * static_cast<std::size_t>(count));
    const std::vector<TileId> tiles = tiles_below(plan, blocks[block], level);
    // Steps of the golden ratio spread the positions in the blocks.
    const double place = std::fmod(0.6180339887498949 * (k + 1), 1);
    const TileId id = tiles[static_cast<std::size_t>(place * static_cast<double>(tiles.size()))];
    const double start = jobs::core_seconds();
    SCARP_TRY(const bool is_land, has_heights(plan, id, nodes));
    const double reading = jobs::core_seconds() - start;
    look.reading += reading;
    ++look.looked_at;
    if (!is_land) continue;
    SCARP_TRY(const auto& tile, make_tile(plan, id, nodes, encode));
    look.making += std::max(0.0, jobs::core_seconds() - start - 2 * reading);
    look.bytes += static_cast<double>(tile.bytes.size());
    ++look.made;
  }
  return look;
}

}  // namespace

Result<TileEstimate> estimate_tiles(const TileJob& job, const NodeSource& nodes, int samples) {
  const PyramidPlan& plan = job.plan;
  SCARP_TRY(const auto& encode, open_tile_encoder(job));
  TileEstimate estimate;
  std::vector<TileId> blocks;
  std::vector<double> counts(plan.levels.size(), 0);
  for (const TileId block : find_blocks(plan)) {
    if (tiles_below(plan, block, plan.max_zoom()).empty()) continue;
    blocks.push_back(block);
    for (int z = plan.block_level; z <= plan.max_zoom(); ++z)
      counts[static_cast<std::size_t>(z)] += static_cast<double>(tiles_below(plan, block, z).size());
  }
  estimate.blocks = blocks.size();
  const auto side = static_cast<std::uint64_t>(plan.cells) << (plan.max_zoom() - plan.block_level);
  const double nodes_of_block = static_cast<double>(side) * static_cast<double>(side);
  const double began = jobs::core_seconds();
  double tiles = 0, seconds = 0, bytes = 0;
  // Cost of a tile of the current level, and the fraction of tiles with heights.
  double making = 0, size = 0, share = 0, reading = 0;
  for (int z = plan.max_zoom(); z >= plan.block_level && !blocks.empty(); --z) {
    const double left = kMostSeconds - (jobs::core_seconds() - began), next = kTimeOfLarger * making;
    const double most = std::max(1.0, std::ceil(kMostShare * counts[static_cast<std::size_t>(z)]));
    const int wanted = static_cast<int>(std::clamp<double>(samples / (plan.max_zoom() - z + 1), 1, most));
    const int count = next * wanted < left ? wanted : static_cast<int>(left / next);
    if (count > 0) {
      SCARP_TRY(const auto& look, look_at(plan, blocks, z, count, nodes, encode));
      reading = look.seconds_of_reading() * counts[static_cast<std::size_t>(z)];
      share = look.share();
      if (look.made > 0) {
        making = look.seconds_of_making();
        size = look.bytes_of_one();
      }
    } else {
      making *= kTimeOfLarger;
      size *= kBytesOfLarger;
    }
    const double made = share * counts[static_cast<std::size_t>(z)];
    if (z == plan.max_zoom()) estimate.finest_tiles = static_cast<std::uint64_t>(made);
    tiles += made;
    seconds += made * making;
    bytes += made * size;
  }
  // Nodes are read once for all levels.
  seconds += reading + kSecondsOfNode * nodes_of_block * static_cast<double>(blocks.size());
  const double above = static_cast<double>(4 * plan.block_level) + plan.grid.roots();
  estimate.core_seconds = seconds + kSecondsAbove * above;
  estimate.bytes = static_cast<std::uint64_t>(bytes + kBytesAbove * above);
  estimate.tiles = static_cast<std::uint64_t>(tiles + above);
  estimate.parts = estimate.bytes + kReducedBytes * estimate.blocks;
  estimate.memory = kProgramBytes + 3 * sizeof(float) * side * side;
  return estimate;
}

}  // namespace scarp
