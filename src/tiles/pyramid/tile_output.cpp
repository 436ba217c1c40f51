#include "tiles/pyramid/tile_output.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "tiles/pyramid/larger.h"

namespace scarp::tiles {

TileOutput::TileOutput(const PyramidPlan& plan, TileSink& sink, const Run& run)
    : plan_(plan), sink_(sink), run_(run), reporter_(run.progress) {
  report_.levels.resize(plan.levels.size());
  report_.tiles.resize(plan.levels.size());
}

Result<void> TileOutput::make(const std::vector<TileId>& tiles,
                              const std::function<Result<std::optional<KeptTile>>(TileId, const TileEncoder&)>& make) {
  struct Made {
    std::optional<KeptTile> tile;
    std::optional<Error> error;
  };
  const TileEncoder encode = [&](const TerrainTile& tile) { return sink_.encode(tile); };
  std::vector<Made> made(tiles.size());
  Result<void> result;
  parallel_in_order(
      tiles.size(), run_.threads,
      [&](std::size_t k, std::size_t) {
        auto tile = make(tiles[k], encode);
        if (tile)
          made[k].tile = std::move(*tile);
        else
          made[k].error = tile.error();
      },
      [&](std::size_t k) {
        const Made one = std::move(made[k]);
        const double share = static_cast<double>(k) / static_cast<double>(tiles.size());
        if (one.error)
          result = tl::unexpected(*one.error);
        else if (reporter_.due() && !reporter_.report("tiles", share, tiles_, 0))
          result = fail(ErrorKind::kCancelled, "cancelled");
        else if (one.tile)
          result = put(*one.tile);
        return result.has_value();
      });
  return result;
}

Result<void> TileOutput::put(const KeptTile& kept) {
  const TerrainTile& tile = kept.tile;
  const auto z = static_cast<std::size_t>(tile.id.z);
  LevelSummary& level = report_.levels[z];
  ++level.tiles;
  ++tiles_;
  level.triangles += tile.triangles.size() / 3;
  level.bytes += kept.bytes.size();
  level.node_error = std::max(level.node_error, tile.node_error);
  level.bound = std::max(level.bound, tile.bound());
  level.source_error = larger(level.source_error, tile.source_error);
  level.over += tile.node_error > tile.max_error || (plan_.binds_samples && tile.source_error > tile.max_error);
  level.coarser += tile.max_error > plan_.levels[z].max_error;
  level.lines_left_out += tile.lines_left_out;
  level.oversized += plan_.max_tile_bytes > 0 && kept.bytes.size() > plan_.max_tile_bytes;
  report_.tiles[z].push_back(std::uint64_t{tile.id.y} << 32 | tile.id.x);
  return sink_.put(tile.id, kept.bytes);
}

PyramidReport TileOutput::take_report() {
  for (auto& tiles : report_.tiles) std::sort(tiles.begin(), tiles.end());
  return std::move(report_);
}

void add_report(PyramidReport& report, const PyramidReport& more) {
  auto& [has_heights, levels, tiles] = report;
  has_heights |= more.has_heights;
  levels.resize(std::max(levels.size(), more.levels.size()));
  tiles.resize(std::max(tiles.size(), more.tiles.size()));
  for (std::size_t z = 0; z < more.levels.size(); ++z) {
    LevelSummary& level = levels[z];
    const LevelSummary& other = more.levels[z];
    level.tiles += other.tiles;
    level.triangles += other.triangles;
    level.bytes += other.bytes;
    level.over += other.over;
    level.coarser += other.coarser;
    level.lines_left_out += other.lines_left_out;
    level.oversized += other.oversized;
    level.node_error = std::max(level.node_error, other.node_error);
    level.bound = std::max(level.bound, other.bound);
    level.source_error = larger(level.source_error, other.source_error);
    const auto before = static_cast<std::ptrdiff_t>(tiles[z].size());
    tiles[z].insert(tiles[z].end(), more.tiles[z].begin(), more.tiles[z].end());
    std::inplace_merge(tiles[z].begin(), tiles[z].begin() + before, tiles[z].end());
  }
}

}  // namespace scarp::tiles
