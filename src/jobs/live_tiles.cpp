#include "jobs/live_tiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <list>
#include <map>
#include <tuple>
#include <utility>

#include "base/parallel.h"
#include "scarp/tile.h"
#include "scarp/tile_job.h"

namespace scarp::jobs {
namespace {

/// Memory of a cached tile in addition to its bytes.
constexpr std::uint64_t kEntryBytes = 200;
/// Number of the finest levels whose tiles are built fast enough on request.
constexpr int kFastLevels = 3;
/// Four concurrent tiles of the level below the blocks use as much memory as one block.
constexpr int kPreparingThreads = 4;

using Key = std::tuple<int, std::uint32_t, std::uint32_t>;
Key key_of(TileId id) { return {id.z, id.x, id.y}; }
std::uint64_t size_of(const LiveTile& tile) { return tile.bytes.size() + kEntryBytes; }

/// A cache of tiles that drops the least recently used ones.
class TileCache {
 public:
  using Tile = std::shared_ptr<const LiveTile>;

  void set_limit(std::uint64_t bytes) {
    limit_ = bytes;
    trim();
  }
  Tile find(TileId id) {
    const auto found = places_.find(key_of(id));
    if (found == places_.end()) return nullptr;
    tiles_.splice(tiles_.begin(), tiles_, found->second);
    return tiles_.front().second;
  }
  void add(TileId id, Tile tile) {
    if (places_.count(key_of(id)) > 0) return;
    held_ += size_of(*tile);
    tiles_.push_front({id, std::move(tile)});
    places_[key_of(id)] = tiles_.begin();
    trim();
  }

 private:
  void trim() {
    while (held_ > limit_ && !tiles_.empty()) {
      held_ -= size_of(*tiles_.back().second);
      places_.erase(key_of(tiles_.back().first));
      tiles_.pop_back();
    }
  }

  std::uint64_t limit_ = 0, held_ = 0;
  std::list<std::pair<TileId, Tile>> tiles_;
  std::map<Key, std::list<std::pair<TileId, Tile>>::iterator> places_;
};

/// Stores tiles with their bounds, up to a limit.
class PreparedTiles final : public TileSink {
 public:
  explicit PreparedTiles(const TileEncoder& encode) : encode_(encode) {}

  void set_limit(std::uint64_t bytes) { room_ = bytes; }
  /// Reserves bytes within the limit.
  Result<void> take_room(std::uint64_t bytes) {
    is_full_ = is_full_ || bytes > room_;
    if (is_full_) return fail(ErrorKind::kCancelled, "no room for more tiles");
    room_ -= bytes;
    return {};
  }
  bool is_full() const { return is_full_; }

  Result<std::vector<std::uint8_t>> encode(const TerrainTile& tile) const override {
    // A tile with too many bytes is built and encoded again; the last bound counts.
    bounds_.with([&](auto& bounds) { bounds[key_of(tile.id)] = tile.bound(); });
    return encode_(tile);
  }
  Result<void> put(TileId id, std::span<const std::uint8_t> bytes) override {
    auto tile = std::make_shared<LiveTile>();
    tile->bytes.assign(bytes.begin(), bytes.end());
    bounds_.with([&](auto& bounds) { tile->bound = bounds.extract(key_of(id)).mapped(); });
    SCARP_RETURN_IF_ERROR(take_room(size_of(*tile)));
    tiles_.with([&](auto& tiles) { tiles[key_of(id)] = std::move(tile); });
    return {};
  }
  TileCache::Tile find(TileId id) {
    return tiles_.with([&](auto& tiles) {
      const auto found = tiles.find(key_of(id));
      return found == tiles.end() ? nullptr : found->second;
    });
  }

 private:
  const TileEncoder& encode_;
  mutable Shared<std::map<Key, double>> bounds_;
  Shared<std::map<Key, TileCache::Tile>> tiles_;
  std::uint64_t room_ = 0;
  bool is_full_ = false;
};

/// Allows cancelling the reading of nodes.
class EndableNodes final : public NodeSource {
 public:
  EndableNodes(const NodeSource& nodes, const std::function<bool()>& is_over) : nodes_(nodes), is_over_(is_over) {}

  Result<void> read(const NodeWindow& window, std::span<float> out) const override {
    if (is_over_()) return fail(ErrorKind::kCancelled, "cancelled");
    return nodes_.read(window, out);
  }
  bool has_samples() const override { return nodes_.has_samples(); }
  Result<void> visit_samples(const DegreeBox& box, const SampleVisitor& visit) const override {
    return nodes_.visit_samples(box, visit);
  }

 private:
  const NodeSource& nodes_;
  const std::function<bool()>& is_over_;
};

}  // namespace

struct LiveTileSet::Impl {
  TileJob job;
  const NodeSource* nodes = nullptr;
  TileEncoder encode;
  std::vector<std::vector<std::uint64_t>> tiles;
  std::vector<std::uint8_t> layer;
  std::uint64_t cache_bytes = 0;
  Shared<TileCache> cache;
  PreparedTiles prepared{encode};
};

LiveTileSet::LiveTileSet(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

LiveTileSet::~LiveTileSet() = default;

Result<std::unique_ptr<LiveTileSet>> LiveTileSet::open(const TileJob& job, const NodeSource& nodes, std::uint64_t cache,
                                                       const Run& run, std::uint64_t look_nodes) {
  if (job.format != TileFormat::kQuantizedMesh)
    return fail(
        ErrorKind::kUsage,
        "3D Tiles say in advance what each tile holds: make the set first (scarp tile RASTER OUTPUT --of 3dtiles)");
  auto impl = std::make_unique<Impl>();
  impl->job = job;
  impl->nodes = &nodes;
  const PyramidPlan& plan = impl->job.plan;
  impl->encode = make_tile_encoder(job.format, plan);
  const DegreeBox& covered = plan.covered;
  const double per_degree = plan.cells / 180.0 * static_cast<double>(std::uint64_t{1} << plan.max_zoom());
  const double count = (covered.east - covered.west) * (covered.north - covered.south) * per_degree * per_degree;
  SCARP_TRY(impl->tiles, find_tiles(plan, count <= static_cast<double>(look_nodes) ? &nodes : nullptr, run));
  PyramidReport report;
  report.tiles = impl->tiles;
  LayerFacts facts = job.facts;
  facts.version = fmt::format("{:016x}", key_of(job));
  impl->layer = encode_layer_json(plan, report, facts);
  impl->cache_bytes = cache;
  impl->cache.with([&](TileCache& kept) { kept.set_limit(cache); });
  return std::unique_ptr<LiveTileSet>(new LiveTileSet(std::move(impl)));
}

const std::vector<std::vector<std::uint64_t>>& LiveTileSet::tiles() const { return impl_->tiles; }

std::vector<std::string> LiveTileSet::files() const { return {"layer.json"}; }

Result<std::vector<std::uint8_t>> LiveTileSet::read_tile(TileId id) const {
  SCARP_TRY(const auto& tile, make(id));
  return tile->bytes;
}

Result<std::vector<std::uint8_t>> LiveTileSet::read_file(const std::string& name) const {
  if (name != "layer.json") return fail(ErrorKind::kInput, fmt::format("there is no file {}", name));
  return impl_->layer;
}

Result<std::shared_ptr<const LiveTile>> LiveTileSet::make(TileId id) const {
  const auto z = static_cast<std::size_t>(id.z);
  if (id.z < 0 || z >= impl_->tiles.size() ||
      !std::binary_search(impl_->tiles[z].begin(), impl_->tiles[z].end(), std::uint64_t{id.y} << 32 | id.x))
    return fail(ErrorKind::kInput, fmt::format("there is no tile {}", tile_name(format(), id)));
  if (auto prepared = impl_->prepared.find(id)) return prepared;
  if (auto kept = impl_->cache.with([&](TileCache& cache) { return cache.find(id); })) return kept;
  const PyramidPlan& plan = impl_->job.plan;
  SCARP_TRY(auto&& made, make_tile(plan, id, *impl_->nodes, impl_->encode));
  auto tile = std::make_shared<LiveTile>();
  tile->bytes = std::move(made.bytes);
  if (id.z >= plan.block_level) tile->bound = made.tile.bound();
  impl_->cache.with([&](TileCache& cache) { cache.add(id, tile); });
  return tile;
}

Result<bool> LiveTileSet::prepare(int threads, const std::function<bool()>& is_over) {
  const PyramidPlan& plan = impl_->job.plan;
  PreparedTiles& prepared = impl_->prepared;
  prepared.set_limit(impl_->cache_bytes / 2);
  impl_->cache.with([&](TileCache& kept) { kept.set_limit(impl_->cache_bytes - impl_->cache_bytes / 2); });
  Run run;
  run.threads = std::min(thread_count(threads), kPreparingThreads);
  run.progress = [&](const Progress&) { return !is_over(); };
  const EndableNodes nodes(*impl_->nodes, is_over);
  const auto make_all = [&]() -> Result<void> {
    std::vector<BlockReport> blocks;
    for (const TileId block : find_blocks(plan)) {
      SCARP_TRY(auto&& made, make_block(plan, block, nodes, prepared, run, plan.max_zoom() - kFastLevels));
      SCARP_RETURN_IF_ERROR(prepared.take_room(made.reduced.size()));
      blocks.push_back(std::move(made));
    }
    auto finished = finish_pyramid(plan, std::move(blocks), prepared, run);
    return finished ? Result<void>() : tl::unexpected(finished.error());
  };
  const Result<void> made = make_all();
  if (!made && !prepared.is_full()) return tl::unexpected(made.error());
  return !prepared.is_full();
}

}  // namespace scarp::jobs
