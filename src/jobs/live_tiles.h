// Tiles built on request.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scarp/result.h"
#include "scarp/run.h"
#include "scarp/tile.h"
#include "scarp/tile_job.h"
#include "scarp/tile_set.h"

#pragma GCC visibility push(default)

namespace scarp::jobs {

struct LiveTile {
  std::vector<std::uint8_t> bytes;
  /// TerrainTile::bound(). Empty for tiles above the block level until prepare() has built them, since not all of their
  /// nodes were examined.
  std::optional<double> bound;
};

/// The quantized-mesh set of a job. Tiles are built when they are read, with the same bytes as in the finished set.
/// Several threads may read at once.
class LiveTileSet final : public TileSetReader {
 public:
  /// Finds the existing tiles. In a job of at most `look_nodes` nodes, all nodes are examined, and the tiles are those
  /// of the finished set. In a larger job, a tile exists wherever the raster may cover it, and tiles without heights
  /// are flat. `cache`: bytes for cached tiles. Borrows `nodes`. Progress: pass "look". Fails as find_tiles() does, and
  /// with kUsage for another format.
  static Result<std::unique_ptr<LiveTileSet>> open(const TileJob& job, const NodeSource& nodes, std::uint64_t cache,
                                                   const Run& run = {},
                                                   std::uint64_t look_nodes = std::uint64_t{1} << 28);
  LiveTileSet(const LiveTileSet&) = delete;
  LiveTileSet& operator=(const LiveTileSet&) = delete;
  ~LiveTileSet() override;

  TileFormat format() const override { return TileFormat::kQuantizedMesh; }
  const std::vector<std::vector<std::uint64_t>>& tiles() const override;
  /// Only "layer.json", with a version that depends on the job and its rasters.
  std::vector<std::string> files() const override;
  Result<std::vector<std::uint8_t>> read_tile(TileId id) const override;
  Result<std::vector<std::uint8_t>> read_file(const std::string& name) const override;

  /// Like read_tile(), with the tile's bound. Fails with kInput if the set has no such tile, and as make_tile() does.
  /// Memory: up to 300 MB per call for a tile of the block level, less for tiles below.
  Result<std::shared_ptr<const LiveTile>> make(TileId id) const;

  /// Builds the slowest tiles (all but the finest three levels) as make_pyramid() does, and caches them with their
  /// bounds for make(). Other threads may call make() meanwhile. Ends when these tiles fill half of the cache. Returns
  /// true if all were cached. REQUIRES: called only once. `is_over`: polled from any thread; once it returns true, the
  /// call ends with kCancelled. Memory in addition to the cache: 400 MB. Fails as make_pyramid() does.
  Result<bool> prepare(int threads, const std::function<bool()>& is_over);

 private:
  struct Impl;
  explicit LiveTileSet(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace scarp::jobs

#pragma GCC visibility pop
