// Nodes are read once, in blocks. For each block all overlapping tiles are judged, from the roots to the finest.
#include "check/nodes_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "base/parallel.h"
#include "base/reporter.h"
#include "check/node_judge.h"
#include "check/sample_judge.h"

namespace scarp::check {
namespace {

/// Node intervals along a side of a block, which then needs 67 MB.
constexpr std::int64_t kMostSteps = 4096;
constexpr int kRowsTogether = 256;
/// Allowed excess of a measured error over its bound by rounding: relative, and in metres.
constexpr double kRounding = 1e-9, kDust = 1e-6;

std::uint64_t key_of_tile(TileId id) { return std::uint64_t{id.y} << 32 | id.x; }

class NodesCheck {
 public:
  NodesCheck(const TileSetReader& set, const io::SetClaims& claims, const TileCheckOptions& options,
             const TileGrid& grid, const World& world, TileCheck& check, std::vector<TileFault>& faults)
      : set_(set),
        claims_(claims),
        options_(options),
        check_(check),
        faults_(faults),
        grid_(grid),
        world_(world),
        reporter_(options.run.progress) {}

  Result<void> run() {
    finest_ = static_cast<int>(set_.tiles().size()) - 1;
    cells_ = options_.nodes.cells > 0 ? options_.nodes.cells : claims_.cells.value_or(128);
    if (grid_.is_flat()) cells_ = static_cast<int>(grid_.local.side >> finest_);
    background_ = options_.nodes.background.value_or(claims_.background.value_or(0));
    if (cells_ < 1 || (std::int64_t{cells_} << finest_) > (std::int64_t{1} << 31))
      return fail(ErrorKind::kUsage, fmt::format("{} cells a tile of level {} make no lattice", cells_, finest_));
    while (depth_ < finest_ && (std::int64_t{cells_} << (depth_ + 1)) <= kMostSteps) ++depth_;
    for (CheckedLevel& level : check_.levels) {
      level.node_error = level.distance = 0;
      if (options_.nodes.source->has_samples()) level.source_error = 0;
    }
    place_blocks();
    for (std::uint32_t y = first_row_; y <= last_row_; ++y) {
      for (std::int64_t k = 0; k < columns_; ++k) {
        const TileId block{finest_ - depth_, column(k), y};
        SCARP_RETURN_IF_ERROR(judge_block(block));
        ++blocks_;
        const double share =
            static_cast<double>(blocks_) / (static_cast<double>(columns_) * (last_row_ - first_row_ + 1));
        if (reporter_.due() && !reporter_.report("nodes", share, 0, 0)) return fail(ErrorKind::kCancelled, "cancelled");
      }
    }
    judge_outside();
    describe();
    return {};
  }

 private:
  std::int64_t steps_of(int z) const { return std::int64_t{cells_} << (finest_ - z); }

  /// Finds the blocks that the source may cover, as columns and rows.
  void place_blocks() {
    const int z = finest_ - depth_;
    const DegreeBox& covered = options_.nodes.covered;
    const DegreeBox box = grid_.bounds_of({z, 0, 0});
    const double width = box.east - box.west;
    const double margin = 2 * grid_.largest_step(grid_.per_turn(finest_, cells_));
    // The last row whose southern edge is not north of a latitude.
    const auto row_of = [&](double latitude) {
      std::uint32_t row = 0, end = grid_.rows(z);
      while (end - row > 1) {
        const std::uint32_t middle = row + (end - row) / 2;
        (grid_.bounds_of({z, 0, middle}).south <= latitude ? row : end) = middle;
      }
      return row;
    };
    first_row_ = row_of(covered.south - margin);
    last_row_ = row_of(covered.north + margin);
    const auto all = std::int64_t{grid_.columns(z)};
    const auto first = static_cast<std::int64_t>(std::floor((covered.west - margin - box.west) / width));
    const auto last = static_cast<std::int64_t>(std::floor((covered.east + margin - box.west) / width));
    if (grid_.is_flat()) {
      first_col_ = std::max<std::int64_t>(first, 0);
      columns_ = std::min(last, all - 1) - first_col_ + 1;
      return;
    }
    first_col_ = ((first % all) + all) % all;
    columns_ = std::min(last - first + 1, all);
    if (columns_ == all) first_col_ = 0;
  }

  /// The k-th column of blocks, across the antimeridian.
  std::uint32_t column(std::int64_t k) const {
    return static_cast<std::uint32_t>((first_col_ + k) % grid_.columns(finest_ - depth_));
  }
  bool is_inside(std::uint32_t x, std::uint32_t y) const {
    const std::int64_t all = grid_.columns(finest_ - depth_);
    return (std::int64_t{x} - first_col_ + all) % all < columns_ && y >= first_row_ && y <= last_row_;
  }

  /// Tiles that overlap a block: its ancestors, itself, and its descendants.
  std::vector<TileId> tiles_of(TileId block) const {
    std::vector<TileId> tiles;
    for (int z = 0; z <= finest_; ++z) {
      const auto& level = set_.tiles()[static_cast<std::size_t>(z)];
      const int deeper = std::max(0, z - block.z), higher = std::max(0, block.z - z);
      const std::uint32_t side = std::uint32_t{1} << deeper;
      for (std::uint32_t j = 0; j < side; ++j) {
        const std::uint32_t west = (block.x >> higher) << deeper, y = ((block.y >> higher) << deeper) + j;
        const std::uint64_t end = key_of_tile({z, west + side - 1, y});
        for (auto at = std::lower_bound(level.begin(), level.end(), key_of_tile({z, west, y}));
             at != level.end() && *at <= end; ++at)
          tiles.push_back({z, static_cast<std::uint32_t>(*at), y});
      }
    }
    return tiles;
  }

  Result<ClientTile> read(TileId id) const {
    SCARP_TRY(const auto& bytes, set_.read_tile(id));
    return decode_client_tile(set_.format(), bytes, id, grid_, world_, nullptr);
  }

  NodeJudge judge_of(const ClientTile& tile) const {
    const std::optional<double>& bound = check_.levels[static_cast<std::size_t>(tile.id.z)].promised_bound;
    return {tile, steps_of(tile.id.z), background_, bound.value_or(std::numeric_limits<double>::infinity()), grid_};
  }

  Result<void> judge_block(TileId block) {
    NodeBlock nodes = NodeBlock::begin(grid_.window_of(block, static_cast<std::int32_t>(steps_of(block.z))), world_);
    const auto cols = static_cast<std::size_t>(nodes.window.cols);
    nodes.heights.resize(cols * static_cast<std::size_t>(nodes.window.rows));
    std::vector<Result<void>> read_bands(
        static_cast<std::size_t>((nodes.window.rows + kRowsTogether - 1) / kRowsTogether));
    parallel_for(read_bands.size(), options_.run.threads, [&](std::size_t k) {
      NodeWindow band = nodes.window;
      const int first = static_cast<int>(k) * kRowsTogether;
      band.row += first;
      band.rows = std::min(kRowsTogether, nodes.window.rows - first);
      read_bands[k] = options_.nodes.source->read(
          band, std::span(nodes.heights)
                    .subspan(cols * static_cast<std::size_t>(first), cols * static_cast<std::size_t>(band.rows)));
    });
    for (const Result<void>& one : read_bands) {
      SCARP_RETURN_IF_ERROR(one);
    }
    const std::vector<TileId> tiles = tiles_of(block);
    std::vector<NodeVerdict> verdicts(tiles.size());
    std::vector<Result<void>> visits(tiles.size());
    const bool has_heights =
        std::any_of(nodes.heights.begin(), nodes.heights.end(), [](float height) { return !std::isnan(height); });
    parallel_for(tiles.size(), options_.run.threads, [&](std::size_t k) {
      const auto tile = read(tiles[k]);
      if (!tile) return;
      verdicts[k] = judge_of(*tile).judge(nodes);
      if (has_heights) visits[k] = judge_samples(*tile, block, nodes, verdicts[k]);
    });
    for (std::size_t k = 0; k < tiles.size(); ++k) {
      SCARP_RETURN_IF_ERROR(visits[k]);
      take(tiles[k], verdicts[k]);
    }
    return {};
  }

  Result<void> judge_samples(const ClientTile& tile, TileId block, const NodeBlock& nodes, NodeVerdict& verdict) const {
    if (!options_.nodes.source->has_samples()) return {};
    const DegreeBox box = grid_.bounds_of(tile.id);
    const TileId part = tile.id.z > block.z ? tile.id : block;
    const NodeWindow window = grid_.window_of(part, static_cast<std::int32_t>(steps_of(part.z)));
    const SampleJudge judge(tile);
    const DegreeBox shared = grid_.bounds_of(part);
    const double per_u = kWholeTile / (box.east - box.west), per_v = kWholeTile / (box.north - box.south);
    const double per_col = (window.cols - 1) / (shared.east - shared.west);
    return options_.nodes.source->visit_samples(shared, [&](const SampleRow& row) {
      for (std::size_t k = 0; k < row.heights.size(); ++k) {
        if (std::isnan(row.heights[k])) continue;
        const double longitude = row.longitude + static_cast<double>(k) * row.step_longitude;
        const double latitude = row.latitude + static_cast<double>(k) * row.step_latitude;
        if (!(longitude >= shared.west && longitude <= shared.east && latitude >= shared.south &&
              latitude <= shared.north))
          continue;
        const double error =
            judge.error_at((longitude - box.west) * per_u, (latitude - box.south) * per_v, double{row.heights[k]});
        if (error <= verdict.source_error) continue;
        const auto node = [](double place, int count) {
          return std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor(place)), 0, count - 2);
        };
        const std::int64_t col = window.col - nodes.window.col + node((longitude - shared.west) * per_col, window.cols);
        const std::int64_t line = window.row - nodes.window.row + row_above(window, latitude);
        if (nodes.has_heights_around(col, line)) verdict.source_error = error;
      }
    });
  }

  /// The row of nodes at or above a latitude that has a row below.
  static std::int64_t row_above(const NodeWindow& window, double latitude) {
    std::int64_t row = 0, end = window.rows - 1;
    while (end - row > 1) {
      const std::int64_t middle = row + (end - row) / 2;
      (window.latitude(window.row + middle) >= latitude ? row : end) = middle;
    }
    return row;
  }

  void judge_outside() {
    const int z = finest_ - depth_;
    const std::int64_t steps = steps_of(z), rows = grid_.rows(z);
    const NodeRectangle inside{first_col_ * steps, (first_col_ + columns_) * steps, (rows - 1 - last_row_) * steps,
                               (rows - first_row_) * steps};
    for (int level = 0; level <= finest_; ++level) {
      const auto& tiles = set_.tiles()[static_cast<std::size_t>(level)];
      std::vector<TileId> outside;
      for (const std::uint64_t key : tiles) {
        const TileId id{level, static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32)};
        if (level < z || !is_inside(id.x >> (level - z), id.y >> (level - z))) outside.push_back(id);
      }
      std::vector<NodeVerdict> verdicts(outside.size());
      parallel_for(outside.size(), options_.run.threads, [&](std::size_t k) {
        const auto tile = read(outside[k]);
        if (tile) verdicts[k] = judge_of(*tile).judge_outside(inside, world_);
      });
      for (std::size_t k = 0; k < outside.size(); ++k) take(outside[k], verdicts[k]);
    }
  }

  void take(TileId id, const NodeVerdict& verdict) {
    const auto z = static_cast<std::size_t>(id.z);
    CheckedLevel& level = check_.levels[z];
    level.node_error = std::max(*level.node_error, verdict.node_error);
    level.distance = std::max(*level.distance, verdict.distance);
    check_.nodes += verdict.nodes;
    if (level.source_error) level.source_error = std::max(*level.source_error, verdict.source_error);
    const auto breaks = [](double found, const std::optional<double>& promised) {
      return promised && found > *promised * (1 + kRounding) + kDust;
    };
    // Positions in GLB files are rounded in space, except on a plane, so the bound applies to the distance.
    const bool is_error = (set_.format() == TileFormat::kQuantizedMesh || grid_.is_flat()) &&
                          (breaks(verdict.node_error, level.promised_node_error) ||
                           breaks(verdict.source_error, level.promised_source_error));
    if (is_error || breaks(verdict.distance, level.promised_bound)) broken_[{id.z, id.y, id.x}].add(verdict);
  }

  void describe() {
    for (const auto& [key, verdict] : broken_) {
      const auto& [z, y, x] = key;
      const CheckedLevel& level = check_.levels[static_cast<std::size_t>(z)];
      const std::string name = tile_name(set_.format(), {z, x, y});
      const bool is_sample = level.promised_source_error &&
                             verdict.source_error > *level.promised_source_error + kDust &&
                             verdict.node_error <= level.promised_node_error.value_or(0) + kDust;
      if (is_sample) {
        faults_.push_back(
            {TileFaultKind::kBound,
             fmt::format("{} is {:.6g} m above or below a sample of the source, and {:.6g} m are promised", name,
                         verdict.source_error, *level.promised_source_error)});
        continue;
      }
      const bool is_distance = level.promised_bound && verdict.distance > *level.promised_bound;
      faults_.push_back({TileFaultKind::kBound,
                         is_distance ? fmt::format("{} is {:.6g} m from a node, and {:.6g} m are promised", name,
                                                   verdict.distance, *level.promised_bound)
                                     : fmt::format("{} is {:.6g} m above or below a node, and {:.6g} m are promised",
                                                   name, verdict.node_error, level.promised_node_error.value_or(0))});
    }
  }

  const TileSetReader& set_;
  const io::SetClaims& claims_;
  const TileCheckOptions& options_;
  TileCheck& check_;
  std::vector<TileFault>& faults_;
  TileGrid grid_;
  World world_;
  Reporter reporter_;
  int finest_ = 0, depth_ = 0, cells_ = 128;  ///< blocks are the tiles of level finest_ − depth_
  double background_ = 0;
  std::int64_t first_col_ = 0, columns_ = 1;  ///< first column and number of blocks; they may wrap past the last column
  std::uint32_t first_row_ = 0, last_row_ = 0;
  std::uint64_t blocks_ = 0;
  std::map<std::tuple<int, std::uint32_t, std::uint32_t>, NodeVerdict> broken_;
};

}  // namespace

Result<void> check_nodes(const TileSetReader& set, const io::SetClaims& claims, const TileCheckOptions& options,
                         const TileGrid& grid, const World& world, TileCheck& check, std::vector<TileFault>& faults) {
  return NodesCheck(set, claims, options, grid, world, check, faults).run();
}

}  // namespace scarp::check
