#include "scarp/live_tiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <list>
#include <map>
#include <tuple>
#include <utility>

#include "base/parallel.h"

namespace scarp {
namespace {

/// What a tile takes beside its bytes while it is kept.
constexpr std::uint64_t kEntryBytes = 200;

/// Tiles, of which those that nobody asked for the longest go first.
class TileCache {
 public:
  using Tile = std::shared_ptr<const LiveTile>;

  void set_limit(std::uint64_t bytes) { limit_ = bytes; }
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
    while (held_ > limit_ && !tiles_.empty()) {
      held_ -= size_of(*tiles_.back().second);
      places_.erase(key_of(tiles_.back().first));
      tiles_.pop_back();
    }
  }

 private:
  using Key = std::tuple<int, std::uint32_t, std::uint32_t>;
  static Key key_of(TileId id) { return {id.z, id.x, id.y}; }
  static std::uint64_t size_of(const LiveTile& tile) { return tile.bytes.size() + kEntryBytes; }

  std::uint64_t limit_ = 0, held_ = 0;
  std::list<std::pair<TileId, Tile>> tiles_;
  std::map<Key, std::list<std::pair<TileId, Tile>>::iterator> places_;
};

}  // namespace

struct LiveTileSet::Impl {
  TileJob job;
  const NodeSource* nodes = nullptr;
  TileEncoder encode;
  std::vector<std::vector<std::uint64_t>> tiles;
  std::vector<std::uint8_t> layer;
  Shared<TileCache> cache;
};

LiveTileSet::LiveTileSet(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

LiveTileSet::~LiveTileSet() = default;

Result<std::unique_ptr<LiveTileSet>> LiveTileSet::open(const TileJob& job, const NodeSource& nodes, std::uint64_t cache,
                                                       const Run& run, std::uint64_t look_nodes) {
  if (job.format != TileFormat::kQuantizedMesh)
    return fail(ErrorKind::kUsage, "3D Tiles say in advance what each tile holds: make the set with scarp tile first");
  auto impl = std::make_unique<Impl>();
  impl->job = job;
  impl->nodes = &nodes;
  const PyramidPlan& plan = impl->job.plan;
  impl->encode = make_tile_encoder(job.format, plan);
  const DegreeBox& covered = plan.covered;
  const double per_degree = plan.cells / 180.0 * static_cast<double>(std::uint64_t{1} << plan.max_zoom());
  const double count = (covered.east - covered.west) * (covered.north - covered.south) * per_degree * per_degree;
  auto tiles = find_tiles(plan, count <= static_cast<double>(look_nodes) ? &nodes : nullptr, run);
  if (!tiles) return tl::unexpected(tiles.error());
  impl->tiles = std::move(*tiles);
  PyramidReport report;
  report.tiles = impl->tiles;
  LayerFacts facts = job.facts;
  facts.version = fmt::format("{:016x}", key_of(job));
  impl->layer = encode_layer_json(plan, report, facts);
  impl->cache.with([&](TileCache& kept) { kept.set_limit(cache); });
  return std::unique_ptr<LiveTileSet>(new LiveTileSet(std::move(impl)));
}

const std::vector<std::vector<std::uint64_t>>& LiveTileSet::tiles() const { return impl_->tiles; }

std::vector<std::string> LiveTileSet::files() const { return {"layer.json"}; }

Result<std::vector<std::uint8_t>> LiveTileSet::read_tile(TileId id) const {
  const auto tile = make(id);
  if (!tile) return tl::unexpected(tile.error());
  return (*tile)->bytes;
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
  if (auto kept = impl_->cache.with([&](TileCache& cache) { return cache.find(id); })) return kept;
  const PyramidPlan& plan = impl_->job.plan;
  auto made = make_kept_tile(plan, id, *impl_->nodes, impl_->encode);
  if (!made) return tl::unexpected(made.error());
  auto tile = std::make_shared<LiveTile>();
  tile->bytes = std::move(made->bytes);
  if (id.z >= plan.block_level) tile->bound = made->tile.bound();
  impl_->cache.with([&](TileCache& cache) { cache.add(id, tile); });
  return tile;
}

}  // namespace scarp
