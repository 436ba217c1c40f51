// All tiles: block by block up to the block level, then level by level from reduced nodes.
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/reporter.h"
#include "scarp/tile.h"
#include "tiles/coarse_nodes.h"
#include "tiles/tile_maker.h"
#include "tiles/tile_mesh_parts.h"
#include "tiles/tile_nodes.h"

namespace scarp {
namespace {

/// Tiles of one level by row, then column.
using TileSet = std::set<std::pair<std::uint32_t, std::uint32_t>>;

class PyramidRun {
 public:
  PyramidRun(const PyramidPlan& plan, const NodeSource& source, TileSink& sink, const Run& run)
      : plan_(plan),
        source_(source),
        sink_(sink),
        run_(run),
        reporter_(run.progress),
        coarse_(plan.block_level, plan.background) {
    report_.levels.resize(plan.levels.size());
    report_.tiles.resize(plan.levels.size());
  }

  Result<PyramidReport> make() {
    choose_tiles();
    for (const auto& [y, x] : chosen_[static_cast<std::size_t>(plan_.block_level)]) {
      if (auto made = make_block({plan_.block_level, x, y}); !made) return tl::unexpected(made.error());
    }
    for (int z = plan_.block_level - 1; z >= 0; --z) {
      if (auto made = make_coarse_level(z); !made) return tl::unexpected(made.error());
    }
    for (auto& tiles : report_.tiles) std::sort(tiles.begin(), tiles.end());
    return std::move(report_);
  }

 private:
  bool is_covered(TileId id) const {
    // More on each side, so that heights on a border, or as near as normals reach, count on both of its sides.
    const double node =
        (normal_reach(steps_of(plan_, plan_.block_level)) + 1) * std::ldexp(180.0 / plan_.cells, -plan_.max_zoom());
    const DegreeBox box = bounds_of(id), &covered = plan_.covered;
    if (box.south > covered.north + node || box.north < covered.south - node) return false;
    for (const double turn : {-720.0, -360.0, 0.0, 360.0, 720.0}) {
      if (box.west + turn <= covered.east + node && box.east + turn >= covered.west - node) return true;
    }
    return false;
  }

  /// Up to the block level: tiles with heights, their parents, and siblings.
  void choose_tiles() {
    chosen_.resize(static_cast<std::size_t>(plan_.block_level) + 1);
    for (int z = 0; z <= plan_.block_level; ++z) {
      TileSet& level = chosen_[static_cast<std::size_t>(z)];
      if (z == 0) {
        level = {{0, 0}, {0, 1}};
        continue;
      }
      for (const auto& [y, x] : chosen_[static_cast<std::size_t>(z) - 1]) {
        const std::array<TileId, 4> children{
            {{z, 2 * x, 2 * y}, {z, 2 * x + 1, 2 * y}, {z, 2 * x, 2 * y + 1}, {z, 2 * x + 1, 2 * y + 1}}};
        if (std::none_of(children.begin(), children.end(), [&](TileId id) { return is_covered(id); })) continue;
        for (const TileId child : children) level.insert({child.y, child.x});
      }
    }
    for (const TileSet& level : chosen_) expected_ += static_cast<double>(level.size());
  }

  Result<void> make_block(TileId block) {
    const int depth = plan_.max_zoom() - plan_.block_level;
    std::optional<HeldNodes> nodes;
    if (is_covered(block)) {
      auto read = read_block(block);
      if (!read) return tl::unexpected(read.error());
      if (read->has_heights()) nodes = std::move(*read);
      report_.has_heights |= nodes.has_value();
    }
    if (!nodes) {
      const Result<TerrainTile> flat = make_flat_tile(plan_, block);
      if (!flat) return tl::unexpected(flat.error());
      return put(*flat);
    }
    std::vector<TileId> tiles;
    for (int deeper = 0; deeper <= depth; ++deeper) {
      const std::uint32_t side = std::uint32_t{1} << deeper;
      for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x)
          tiles.push_back({block.z + deeper, (block.x << deeper) + x, (block.y << deeper) + y});
      }
    }
    const double before = done_;
    if (auto made = make_tiles(
            tiles, [&](TileId id) { return make_if_any(id, *nodes, id.z == plan_.block_level); },
            [&](std::size_t k) { return before + static_cast<double>(k) / static_cast<double>(tiles.size()); });
        !made)
      return made;
    done_ = before + 1;
    if (plan_.block_level == 0) return {};
    const std::int32_t steps = steps_of(plan_, block.z);
    const auto whole = TileNodes::read(block, steps, 0, plan_.background, *nodes);
    if (!whole) return tl::unexpected(whole.error());
    coarse_.add(block.x, block.y,
                CoarseTile::reduce(steps, [&](std::int32_t col, std::int32_t row) { return whole->at(col, row); }));
    return {};
  }

  /// All nodes of a block and around it, read by all threads.
  Result<HeldNodes> read_block(TileId block) const {
    const std::int32_t steps = steps_of(plan_, block.z), halo = normal_reach(steps);
    const std::int64_t per_turn = std::int64_t{steps} << (block.z + 1);
    const std::int64_t row = (((std::int64_t{1} << block.z) - 1) - block.y) * steps;
    const std::int64_t first = std::max<std::int64_t>(row - halo, 0), last = std::min(row + steps + halo, per_turn / 2);
    return HeldNodes::read({per_turn, std::int64_t{block.x} * steps - halo, first, steps + 1 + 2 * halo,
                            static_cast<int>(last - first + 1)},
                           source_, run_.threads);
  }

  /// Nothing for a tile without heights, unless it is wanted all the same.
  Result<std::optional<TerrainTile>> make_if_any(TileId id, const NodeSource& source, bool is_wanted) const {
    const std::int32_t steps = steps_of(plan_, id.z);
    const auto nodes = TileNodes::read(id, steps, normal_reach(steps), plan_.background, source);
    if (!nodes) return tl::unexpected(nodes.error());
    if (!nodes->has_heights() && !is_wanted) return std::optional<TerrainTile>();
    auto tile = nodes->is_flat() ? make_flat_tile(plan_, id) : make_tile_of(plan_, id, *nodes);
    if (!tile) return tl::unexpected(tile.error());
    return std::optional(std::move(*tile));
  }

  Result<void> make_coarse_level(int z) {
    std::vector<TileId> tiles;
    for (const auto& [y, x] : chosen_[static_cast<std::size_t>(z)]) tiles.push_back({z, x, y});
    const double before = done_;
    auto made = make_tiles(
        tiles, [&](TileId id) { return make_coarse(id); },
        [&](std::size_t k) { return before + static_cast<double>(k); });
    if (!made) return made;
    done_ = before + static_cast<double>(tiles.size());
    CoarseLevel above(z, plan_.background);
    for (const TileId id : tiles) {
      const std::array<const CoarseTile*, 4> children{
          &coarse_.at(2 * id.x, 2 * id.y + 1), &coarse_.at(2 * id.x + 1, 2 * id.y + 1), &coarse_.at(2 * id.x, 2 * id.y),
          &coarse_.at(2 * id.x + 1, 2 * id.y)};
      CoarseTile joined = CoarseTile::join(children);
      if (joined.has_heights) above.add(id.x, id.y, std::move(joined));
    }
    coarse_ = std::move(above);
    return {};
  }

  Result<std::optional<TerrainTile>> make_coarse(TileId id) const {
    const std::int32_t steps = 2 * kCoarseCells;
    const auto nodes = TileNodes::read(id, steps, normal_reach(steps), plan_.background, coarse_);
    if (!nodes) return tl::unexpected(nodes.error());
    auto tile = nodes->is_flat() ? make_flat_tile(plan_, id)
                                 : make_tile_of(plan_, id, *nodes, [&](const TerrainTile& made) -> Result<TileVerdict> {
                                     return TileVerdict{bound_error(made, coarse_), {}};
                                   });
    if (!tile) return tl::unexpected(tile.error());
    return std::optional(std::move(*tile));
  }

  template <class Make, class Done>
  Result<void> make_tiles(const std::vector<TileId>& tiles, const Make& make, const Done& done) {
    struct Made {
      std::optional<TerrainTile> tile;
      std::vector<std::uint8_t> bytes;
      std::optional<Error> error;
    };
    std::vector<Made> made(tiles.size());
    Result<void> result;
    parallel_in_order(
        tiles.size(), run_.threads,
        [&](std::size_t k, std::size_t) {
          auto tile = make(tiles[k]);
          if (!tile) {
            made[k].error = tile.error();
            return;
          }
          if (!*tile) return;
          auto bytes = sink_.encode(**tile);
          if (!bytes) {
            made[k].error = bytes.error();
            return;
          }
          made[k].tile = std::move(*tile);
          made[k].bytes = std::move(*bytes);
        },
        [&](std::size_t k) {
          const Made one = std::move(made[k]);
          if (one.error)
            result = tl::unexpected(*one.error);
          else if (reporter_.due() && !reporter_.report("tiles", std::min(1.0, done(k) / expected_), tiles_, 0))
            result = fail(ErrorKind::kCancelled, "cancelled");
          else if (one.tile)
            result = put(*one.tile, one.bytes);
          return result.has_value();
        });
    return result;
  }

  Result<void> put(const TerrainTile& tile) {
    auto bytes = sink_.encode(tile);
    if (!bytes) return tl::unexpected(bytes.error());
    done_ += 1;
    return put(tile, *bytes);
  }

  Result<void> put(const TerrainTile& tile, const std::vector<std::uint8_t>& bytes) {
    const auto z = static_cast<std::size_t>(tile.id.z);
    LevelSummary& level = report_.levels[z];
    ++level.tiles;
    ++tiles_;
    level.triangles += tile.triangles.size() / 3;
    level.bytes += bytes.size();
    level.node_error = std::max(level.node_error, tile.node_error);
    level.bound = std::max(level.bound, tile.bound());
    level.over += tile.node_error > plan_.levels[z].max_error;
    report_.tiles[z].push_back(std::uint64_t{tile.id.y} << 32 | tile.id.x);
    return sink_.put(tile.id, bytes);
  }

  const PyramidPlan& plan_;
  const NodeSource& source_;
  TileSink& sink_;
  const Run& run_;
  Reporter reporter_;
  CoarseLevel coarse_;  ///< of the level below the one that is made next
  std::vector<TileSet> chosen_;
  double done_ = 0, expected_ = 0;  ///< blocks and coarse tiles
  std::uint64_t tiles_ = 0;
  PyramidReport report_;
};

}  // namespace

Result<PyramidReport> make_pyramid(const PyramidPlan& plan, const NodeSource& source, TileSink& sink, const Run& run) {
  return PyramidRun(plan, source, sink, run).make();
}

}  // namespace scarp
